use super::*;

use rand::RngExt;

/// A coffee bean: half ellipsoids 2.8 and 1.2 high, with a groove along the flat side.
fn coffee_bean(n: &Vector3<f64>) -> f64 {
    let height = if n.z > 0.0 { 2.8 } else { 1.2 };
    let depth = 0.25 * (-(n.y / 0.1).powi(2)).exp() * (-n.z).max(0.0).powi(2);
    ellipsoid(Vector3::new(4.5, 3.2, height))(n) * (1.0 - depth)
}

/// Between points that do not tell the groove the surface ripples, on the round side too.
#[test]
fn the_thickness_of_a_grooved_bean_is_within_its_error() {
    let heights = fibonacci(40_000).into_iter().map(|n| coffee_bean(&n) * n.z);
    let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), height| {
        (low.min(height), high.max(height))
    });
    let axes = Vector3::new(4.5, 3.2, 2.0);
    let mut farthest = 0.0_f64;
    for seed in 0..6 {
        // Spread over the surface, about.
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut directions = Sampling::Random.directions(8000, seed).unwrap();
        directions.retain(|n| random.random_bool((coffee_bean(n) / 4.5).powi(2)));
        let estimate = estimated(&samples(&directions, coffee_bean, 0.0), axes);
        let known = best(&estimate);
        let off = known.figures.dimensions.z - (high - low);
        let error = known.dimension_variances.z.sqrt();
        farthest = farthest.max(off.abs() / error);
    }
    assert!(farthest < 3.0, "{farthest}");
}
