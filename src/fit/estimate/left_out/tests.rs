use super::*;
use crate::fit::estimate::trial::estimated;
use crate::shapes::Sampling;

/// The moves of a functional against those of estimates without a point, under the same spectrum.
#[test]
fn moves_are_those_of_estimates_without_a_point() {
    let samples: Vec<_> = Sampling::Fibonacci
        .directions(400, 0)
        .unwrap()
        .iter()
        .map(|n| {
            let ridge = 0.1 * (-40.0 * n.x * n.x).exp();
            [n.x, n.y, n.z, 1.0 + 0.2 * n.z + ridge * (1.0 + n.y)]
        })
        .collect();
    let estimate = estimated(&samples, Vector3::repeat(1.0));
    let posterior = estimate.posterior();
    let residuals = posterior.residuals(&estimate.coefficients);
    let mut functional = vec![0.0; estimate.coefficients.len()];
    (functional[0], functional[3], functional[6]) = (1.0, 0.5, 0.25);
    let known = estimate
        .given(&posterior)
        .covariances(&[functional.clone()]);
    let left_out = LeftOut::new(&estimate, &posterior, &residuals, true);
    let moves = left_out.moves(&known[0]);

    let covariance = left_out.covariance(&vec![known[0].clone(); INTEGRALS]);
    let (alone, together) = (dot(&moves, &moves), moves.iter().sum::<f64>());
    let expected = alone + together * together;
    assert!((covariance[(0, 1)] / expected - 1.0).abs() < 1e-12);

    let n = Vector3::new(0.6, 0.0, 0.8);
    let directions = estimate.cloud.directions.iter();
    let mut near: Vec<(f64, f64)> = directions
        .zip(&left_out.errors)
        .map(|(other, error)| ((other - n).norm(), error * error))
        .collect();
    near.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mean = near[..VICINITY]
        .iter()
        .map(|(_, square)| square)
        .sum::<f64>()
        / VICINITY as f64;
    assert!((left_out.near(&n) / mean - 1.0).abs() < 1e-12);

    let mut off = vec![0.0; residuals.len()];
    assert!(!LeftOut::new(&estimate, &posterior, &off, false).stand_out);
    off[7] = 1.0;
    let of_noise = LeftOut::new(&estimate, &posterior, &off, false);
    assert!(of_noise.stand_out);

    let heights = estimate.cloud.points().into_iter().map(|point| point.x);
    let mut heights: Vec<f64> = heights.collect();
    heights.sort_by(|one, other| other.total_cmp(one));
    let farthest = heights[0] + (heights[0] - heights[2]);
    let beyond = left_out.beyond(&Vector3::x(), farthest - 0.25);
    assert!((beyond - 0.25).abs() < 1e-12, "{beyond}");
    assert_eq!(left_out.beyond(&Vector3::x(), farthest + 0.25), 0.0);
    assert_eq!(of_noise.beyond(&Vector3::x(), farthest - 0.25), 0.0);

    let whole = dot(&functional, &estimate.coefficients);
    let scale = moves.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    for at in [7, 111, 200, 333] {
        let cloud = estimate.cloud.without(&[at]);
        let without = Posterior::new(&cloud, estimate.degree, true);
        let (mean, _) = without.given(&estimate.spectrum).mean(None, 0.0);
        let moved = whole - dot(&functional, &mean);
        assert!(
            (moved - moves[at]).abs() < 0.1 * scale,
            "{at}: {moved} {}",
            moves[at]
        );
    }
}
