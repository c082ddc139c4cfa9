use super::*;
use crate::fit::estimate::tips::Tips;

/// A ball with a tangent cone about x, as an apple seed and an almond have one: of the very tip the estimate makes too little,
/// and what it kept of each degree tells how much.
#[test]
fn the_length_of_a_cone_in_noise_is_told_no_too_surely() {
    let tangent = (PI / 6.0, PI / 3.0);
    let radius = |n: &Vector3<f64>| {
        let angle = n.x.clamp(-1.0, 1.0).acos();
        match angle < tangent.1 {
            true => 1.0 / (tangent.0 + angle).sin(),
            false => 1.0,
        }
    };
    let mut off = Vec::new();
    for seed in 0..4 {
        let directions = Sampling::Random.directions(4000, seed).unwrap();
        let found = best(&estimated(
            &samples(&directions, radius, 0.004),
            Vector3::repeat(1.0),
        ));
        let error = found.errors(&found.figures).dimensions[0];
        assert!(error < 0.15, "{error}");
        off.push((found.figures.dimensions[0] - 3.0) / error);
    }
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!(mean > -2.0 && off.iter().all(|z| z.abs() < 3.5), "{off:?}");
}

/// Clean grains that run into a point sharper than the points are apart, which lie at random: few lie near it.
#[test]
fn the_length_of_a_pointed_grain_is_known_as_far_as_its_point_is_seen() {
    let axes = Vector3::new(4.0, 1.3, 1.0);
    let mut unseen = Vec::new();
    for seed in 0..12 {
        let at = |n: &Vector3<f64>| {
            let across = 0.65 - 0.35 * n.x;
            let p = Vector3::new(4.0 * n.x, 2.0 * across * n.y, 1.5 * across * n.z);
            let n = p.normalize();
            [n.x, n.y, n.z, p.norm()]
        };
        let directions = Sampling::Random.directions(3000, seed).unwrap();
        let points: Vec<_> = directions.iter().map(at).collect();
        let found = best(&estimated(&points, axes));
        let error = found.errors(&found.figures).dimensions[0];
        let length = found.figures.dimensions[0];
        let off = (length - 8.0).abs();
        assert!(off < 3.0 * error && error < 0.01, "{off} {error}");
        let places = points.iter().map(|[x, _, _, radius]| x * radius);
        let (low, high) = places.fold((0.0, 0.0), |(low, high), x| (x.min(low), x.max(high)));
        unseen.push((length - (high - low)) / error);
    }
    // Of two ends a tenth is in the error.
    assert!(unseen.iter().all(|ratio| *ratio < 15.0), "{unseen:?}");
}

/// A double cone of clean dense points: no degree follows its edge and its tips.
#[test]
fn the_area_and_the_length_of_a_double_cone_are_known_as_far_as_its_edges_are_followed() {
    let (up, down) = (1.5, 0.6);
    let radius = |n: &Vector3<f64>| {
        let height = if n.z > 0.0 { up } else { down };
        1.0 / (n.x.hypot(n.y) + n.z.abs() / height)
    };
    let directions = Sampling::Random.directions(40_000, 1).unwrap();
    let points = samples(&directions, radius, 0.0);
    let estimate = estimated(&points, Vector3::new(1.0, 1.0, 1.0));
    let told = best(&estimate).figures;
    let errors = estimate.errors(&told).unwrap();
    let area = PI * (1.0_f64.hypot(up) + 1.0_f64.hypot(down));
    for (told, truth, error) in [
        (told.area, area, errors.area),
        (told.dimensions[0], up + down, errors.dimensions[0]),
    ] {
        let missing = (truth - told) / error;
        assert!((0.0..3.0).contains(&missing), "{told} {truth} {error}");
        assert!(error < 0.03 * truth, "{told} {truth} {error}");
    }
}

/// Whether a smooth grain has a wide bump at its ends is left open by noise: the error of its length is at least that.
#[test]
fn the_error_of_a_smooth_length_holds_what_noise_leaves_open() {
    let axes = Vector3::new(1.3, 1.0, 0.9);
    let points = samples(&fibonacci(1500), ellipsoid(axes), 0.005);
    let estimate = estimated(&points, axes);
    let found = best(&estimate);
    let posterior = estimate.posterior();
    let tips = Tips::new(&estimate, &posterior);
    let open = [Vector3::x(), -Vector3::x()].map(|end| tips.likeliest_and_widest(&end)[1].variance);
    let least = axes.x * open.iter().sum::<f64>().sqrt();
    let error = found.errors(&found.figures).dimensions[0];
    assert!(error > 0.9 * least, "{error} {least}");
}
