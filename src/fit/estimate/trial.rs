//! Clouds of tests.

use super::{Estimate, estimate};
use crate::fit::context::Context;
use crate::fit::prepare::{Origin, Sample};
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
    estimate(samples, axes, Origin::Points, &Context::default()).unwrap()
}

pub(super) fn fibonacci(points: usize) -> Vec<Vector3<f64>> {
    Sampling::Fibonacci.directions(points, 0).unwrap()
}

/// Samples of a lens about the z axis, of a rim with radius 5 and half as thick as told, with normal noise in all directions.
pub(super) fn lens(half: f64) -> Vec<Sample> {
    let radius = (25.0 + half * half) / (2.0 * half);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let at = |n: Vector3<f64>| {
        let aside = (radius - half) * n.z.abs();
        let r = (aside * aside + half * (2.0 * radius - half)).sqrt() - aside;
        let noise = Vector3::from_fn(|_, _| StandardNormal.sample(&mut random));
        let p: Vector3<f64> = n * r + noise * 0.03;
        let n = p.normalize();
        [n.x, n.y, n.z, p.norm()]
    };
    fibonacci(3000).into_iter().map(at).collect()
}

/// A tablet of radius 1 and half thickness .45 with round edges of radius .25: where the ray leaves it, by halving.
pub(super) fn tablet(n: &Vector3<f64>) -> f64 {
    let is_inside = |r: f64| {
        let (out, up) = (n.x.hypot(n.y) * r - 0.75, n.z.abs() * r - 0.2);
        out.max(0.0).hypot(up.max(0.0)) < 0.25
    };
    let mut between = [0.0, 2.0];
    for _ in 0..40 {
        let middle = 0.5 * (between[0] + between[1]);
        between[usize::from(!is_inside(middle))] = middle;
    }
    between[0]
}
