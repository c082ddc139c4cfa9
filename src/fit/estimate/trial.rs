//! Clouds of tests.

use super::{Estimate, estimate};
use crate::fit::context::Context;
use crate::fit::prepare::Sample;
use crate::shapes::Sampling;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Samples of a radius, with normal noise.
pub(super) fn samples(
    directions: &[Vector3<f64>],
    radius: impl Fn(&Vector3<f64>) -> f64,
    noise: f64,
) -> Vec<Sample> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut at = |n: &Vector3<f64>| {
        let error: f64 = StandardNormal.sample(&mut random);
        [n.x, n.y, n.z, radius(n) + noise * error]
    };
    directions.iter().map(&mut at).collect()
}

pub(super) fn estimated(samples: &[Sample], axes: Vector3<f64>) -> Estimate {
    estimate(samples, axes, true, &Context::default()).unwrap()
}

pub(super) fn fibonacci(points: usize) -> Vec<Vector3<f64>> {
    Sampling::Fibonacci.directions(points, 0).unwrap()
}
