//! What noise along the surface does to it.
//!
//! Noise that moves points to and fro along their rays only scatters them about the surface. Noise of equal size s in all
//! directions, in units of the radius, also moves them along it, and a radius through them is the mean over such places. Of
//! degree l it keeps exp(-l (l + 1) s^2 / 2), so that texture is blurred and the area too small; and a ball swells by s^2, for
//! whichever way a point is moved beside it, it is farther out.
//!
//! Residuals tell which it is. At a place whose normal is inclined by an angle a to the ray, noise of equal size in all
//! directions moves the radius by s / cos a, noise along the rays by s everywhere. So does noise along the normals, which
//! blurs nothing: what is found is the most that may be off. Of particles of NIST of 100 000 points with 1 % of noise of equal
//! size in all directions the areas are .15 % too small (median), 5 standard errors (RMS) without this and 1 with it; with
//! noise along the rays errors stay as they are.

use super::outcome::Estimate;
use std::f64::consts::PI;

/// Points whose residuals are compared, at most.
const MOST_COMPARED: usize = 4000;

/// Where the share of such noise is known no better, as of a ball, all of it may be: squares of normal residuals scatter by the
/// root of 2 of their mean.
const UNKNOWN: f64 = 0.5;

/// Shares of figures that do not count.
const NOTHING: f64 = 2e-6;

/// What may be off because of noise along the surface.
pub(super) struct Blur {
    /// Mean square of the slopes that are missing, in the stretched space.
    pub(super) slopes: f64,
    /// Share of the radius that the body has swollen by.
    pub(super) swelling: f64,
}

impl Blur {
    /// Of an estimate with these residuals.
    pub(super) fn new(estimate: &Estimate, residuals: &[f64]) -> Self {
        let slopes = missing(estimate);
        let swelling = estimate.noise_of_points().powi(2);
        let share = match slopes.max(swelling) < NOTHING {
            true => 0.0,
            false => share_in_all_directions(estimate, residuals),
        };
        Self {
            slopes: share * slopes,
            swelling: share * swelling,
        }
    }
}

/// What is missing of the mean square of the slopes if all of the noise is of equal size in all directions.
fn missing(estimate: &Estimate) -> f64 {
    let variance = estimate.noise_of_points().powi(2);
    let of_degree = |l: usize| {
        let bend = (l * (l + 1)) as f64;
        let own = &estimate.coefficients[l * l..(l + 1) * (l + 1)];
        let power: f64 = own.iter().map(|x| x * x).sum();
        bend * power * (bend * variance).exp_m1()
    };
    let left = |l: usize| 1.0 - estimate.unlearnt[l];
    let degrees = 1..=estimate.degree;
    degrees.map(|l| left(l) * of_degree(l)).sum::<f64>() / (4.0 * PI)
}

/// The share of the noise that is of equal size in all directions: the line through the squares of residuals against what the
/// inclination adds to those of such noise.
fn share_in_all_directions(estimate: &Estimate, residuals: &[f64]) -> f64 {
    let every = estimate.cloud.len().div_ceil(MOST_COMPARED);
    let cloud = estimate.cloud.every(every);
    let residuals = residuals.iter().step_by(every).zip(&cloud.weights);
    let jets = estimate.expansion(estimate.degree).jets(&cloud.directions);
    let places = cloud.directions.iter().zip(jets).zip(residuals);
    let pairs: Vec<[f64; 2]> = places
        .map(|((n, jet), (residual, weight))| {
            let slope = jet.gradient - n * n.dot(&jet.gradient);
            let normal = n * jet.value - slope;
            let plain_ray = n.component_div(&cloud.stretch);
            let plain_normal = normal.component_mul(&cloud.stretch);
            let cosine = plain_ray.dot(&plain_normal) / (plain_ray.norm() * plain_normal.norm());
            let count = weight / cloud.along_normal(n).powi(2);
            let square = count * residual.powi(2) * plain_ray.norm_squared();
            [cosine.powi(-2) - 1.0, square]
        })
        .collect();
    let count = pairs.len() as f64;
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / count;
    let (added, square) = (mean(&|[added, _]| *added), mean(&|[_, square]| *square));
    let spread = mean(&|[own, _]| (own - added).powi(2));
    let is_known = (2.0 / (count * spread)).sqrt() < UNKNOWN;
    if !is_known {
        return 1.0;
    }
    let slope = mean(&|[own, square]| (own - added) * square) / spread;
    let level = square - slope * added;
    match slope > 0.0 {
        true => (slope / level.max(slope)).min(1.0),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::spectrum::NOISE;
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use crate::fit::prepare::Sample;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const S: f64 = 0.01;

    /// A ball with waves.
    fn radius(n: &Vector3<f64>) -> f64 {
        1.0 + 0.05 * (8.0 * n.x + 1.0).sin() * (7.0 * n.y).cos() + 0.04 * (9.0 * n.z).sin()
    }

    fn blur(samples: &[Sample]) -> (Blur, Estimate) {
        let estimate = estimated(samples, Vector3::repeat(1.0));
        let residuals = estimate.posterior().residuals(&estimate.coefficients);
        (Blur::new(&estimate, &residuals), estimate)
    }

    #[test]
    fn noise_in_all_directions_is_told_from_noise_along_the_rays() {
        let directions = fibonacci(12_000);
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let in_space = |n: &Vector3<f64>| {
            let point = n * radius(n) + Vector3::from_fn(|_, _| S * normal());
            let n = point.normalize();
            [n.x, n.y, n.z, point.norm()]
        };
        let in_space: Vec<Sample> = directions.iter().map(in_space).collect();
        let (found, estimate) = blur(&in_space);
        assert!(found.swelling > 0.7 * S * S && found.swelling < 1.4 * S * S);
        assert_relative_eq!(
            found.slopes / missing(&estimate),
            found.swelling / estimate.noise_of_points().powi(2),
            max_relative = 1e-12
        );
        let (along_rays, _) = blur(&samples(&directions, radius, S));
        assert!(along_rays.swelling < 0.3 * found.swelling);
        assert!(along_rays.slopes < 0.3 * found.slopes);
        assert_eq!(blur(&samples(&directions, radius, 0.0)).0.slopes, 0.0);
        // Of a ball it is not known.
        let (ball, estimate) = blur(&samples(&directions, |_| 1.0, S));
        assert_relative_eq!(ball.swelling, estimate.noise_of_points().powi(2));
    }

    #[test]
    fn missing_slopes_have_their_closed_form() {
        let (_, mut estimate) = blur(&samples(&fibonacci(2000), |_| 1.0, S));
        estimate.coefficients.fill(0.0);
        estimate.unlearnt.fill(0.25);
        estimate.coefficients[5 * 6 + 2] = 0.3;
        estimate.spectrum.logarithms[NOISE] = 0.02_f64.ln();
        let growth = (30.0_f64 * 0.02 * 0.02).exp() - 1.0;
        let expected = 0.75 * 30.0 * 0.09 * growth / (4.0 * PI);
        assert_relative_eq!(missing(&estimate), expected, max_relative = 1e-9);
    }
}
