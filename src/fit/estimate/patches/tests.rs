use super::*;
use crate::shapes::Sampling;
use crate::vectorize::dot;
use std::f64::consts::TAU;

/// An ellipsoid of 300 000 points, rough by a wave.
fn samples() -> Vec<Sample> {
    let directions = Sampling::Fibonacci.directions(300_000, 0).unwrap();
    let axes = Vector3::new(2.0, 1.5, 1.0);
    let radius =
        |n: &Vector3<f64>| (1.0 + 0.001 * (40.0 * n.x).sin()) / n.component_div(&axes).norm();
    directions
        .iter()
        .map(|n| [n.x, n.y, n.z, radius(n)])
        .collect()
}

/// Points left out of a rough dense cap with a smooth spot, in the middle of which a point stands so far off.
fn left_out(roughness: f64, off: f64) -> usize {
    let directions = Sampling::Fibonacci.directions(300_000, 0).unwrap();
    let cap: Vec<_> = directions.into_iter().filter(|n| n.z > 0.95).collect();
    let middle = cap.len() / 2;
    let sample = |(i, n): (usize, &Vector3<f64>)| {
        let is_smooth = (n - cap[middle]).norm() < 0.05;
        let rough = if is_smooth { 0.0 } else { roughness };
        let radius = 1.0 + rough * (12.9898 * i as f64).sin();
        let own = if i == middle { off } else { 0.0 };
        [n.x, n.y, n.z, radius + own]
    };
    let samples: Vec<Sample> = cap.iter().enumerate().map(sample).collect();
    Patches::new(&samples, &Vector3::repeat(1.0), PER_EDGE).left_out
}

#[test]
fn points_are_left_out_that_are_off_by_a_share_of_the_radius_and_by_more_than_most() {
    assert_eq!(left_out(0.0, 0.005), 0);
    assert_eq!(left_out(0.0, 0.02), 1);
    assert_eq!(left_out(0.01, 0.03), 0);
    assert_eq!(left_out(0.01, 0.2), 1);
}

/// Of points that lie evenly in the directions in which a grain is round to the half, patches hold alike many; none is left
/// with a tip for itself.
#[test]
fn patches_of_a_long_grain_are_alike_at_its_tips_and_its_sides() {
    let axes = Vector3::new(9.0, 1.0, 1.0);
    let even = Sampling::Fibonacci.directions(300_000, 0).unwrap();
    let sample = |n: &Vector3<f64>| {
        let n = n.component_mul(&axes.map(f64::sqrt)).normalize();
        [n.x, n.y, n.z, 1.0 / n.component_div(&axes).norm()]
    };
    let samples: Vec<Sample> = even.iter().map(sample).collect();
    let largest = |axes: &Vector3<f64>| {
        let counts = Patches::new(&samples, axes, PER_EDGE).counts;
        counts.into_iter().fold(0.0, f64::max)
    };
    let mean = 300_000.0 / 24_576.0;
    assert!(largest(&axes) < 2.0 * mean);
    assert!(largest(&Vector3::repeat(1.0)) > 6.0 * mean);
}

/// A function of place of the second degree has the same mean over a patch's places as over its points.
#[test]
fn places_stand_for_points_to_the_second_degree() {
    let samples = samples();
    let patches = Patches::new(&samples, &Vector3::repeat(1.0), PER_EDGE);
    let of_places = |function: fn(&Sample) -> f64| {
        let values: Vec<f64> = patches.places().iter().map(function).collect();
        dot(&patches.means_of(&values), &patches.counts)
    };
    let second = |&[x, y, z, r]: &Sample| r * r * (x * x - 0.3 * y * z) + r * (y - 2.0 * x) + 0.1;
    let exact: f64 = samples.iter().map(second).sum();
    let found = of_places(second);
    assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    // Of the tenth degree over patches of 1.4 degrees.
    let tenth = |&[x, _, z, r]: &Sample| r * (x * x - z * z).powi(5);
    let exact: f64 = samples.iter().map(|sample| tenth(sample).abs()).sum();
    let off = of_places(tenth) - samples.iter().map(tenth).sum::<f64>();
    assert!((off / exact).abs() < 1e-6, "{off} {exact}");
    assert!(patches.counts.iter().any(|&count| count > PLACES as f64));
    assert_eq!(patches.left_out, 0);
}

#[test]
fn points_in_rows_are_gathered_and_even_ones_are_not() {
    let ball = Vector3::repeat(1.0);
    let of = |directions: Vec<Vector3<f64>>| -> Vec<Sample> {
        directions.iter().map(|n| [n.x, n.y, n.z, 1.0]).collect()
    };
    let rows = (0..24).flat_map(|row| {
        let (sin, cos) = (TAU * f64::from(row) / 48.0).sin_cos();
        (0..500).map(move |at| {
            let (y, x) = (TAU * f64::from(at) / 500.0).sin_cos();
            Vector3::new(x * cos, x * sin, y)
        })
    });
    let per_edge = patches_per_edge(&of(rows.collect()), &ball).unwrap();
    assert!((20..=64).contains(&per_edge), "{per_edge}");
    for sampling in [Sampling::Fibonacci, Sampling::Random] {
        let few = of(sampling.directions(6000, 1).unwrap());
        assert_eq!(patches_per_edge(&few, &ball), None);
    }
    let many = of(Sampling::Random.directions(WHOLE_CLOUD + 1, 1).unwrap());
    assert_eq!(patches_per_edge(&many, &ball), Some(PER_EDGE));
}
