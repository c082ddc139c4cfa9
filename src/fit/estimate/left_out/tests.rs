use super::*;
use crate::fit::context::Context;
use crate::fit::estimate::estimate;
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
    let estimate = estimate(&samples, Vector3::repeat(1.0), &Context::default()).unwrap();
    let posterior = estimate.posterior();
    let residuals = posterior.residuals(&estimate.coefficients);
    let mut functional = vec![0.0; estimate.coefficients.len()];
    (functional[0], functional[3], functional[6]) = (1.0, 0.5, 0.25);
    let known = estimate
        .given(&posterior)
        .covariances(&[functional.clone()]);
    let moves = LeftOut::new(&estimate, &posterior, &residuals).moves(&known[0]);
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
