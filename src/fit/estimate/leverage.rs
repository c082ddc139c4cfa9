//! Leverage of points: how much of each the estimate follows.
//!
//! Their mean is told by what the points leave of the prior variances. Where orders differ by a tilt, they depend on the
//! polar angle: as of an even cloud, as sum of (1 - q_lm) Y_lm^2. In an uneven cloud they depend on the density of the
//! points near by, N per solid angle: as of an even cloud of that density, as sum of (2l + 1) w v_l / (N v_l + s^2) / 4 pi.

use super::outcome::{Estimate, learnt};
use crate::fit::neighbours::Neighbours;
use crate::sphere::{HarmonicBasis, coefficient_count};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Floor of 1 - h, which is told by a mean over points.
const LEAST: f64 = 0.1;

/// 1 - h of every point.
pub(super) fn spares(estimate: &Estimate) -> Vec<f64> {
    let mut leverages = match estimate.cloud.is_uneven() {
        true => by_density(estimate),
        false => vec![1.0; estimate.cloud.len()],
    };
    if estimate.spectrum.tilt != 0.0 {
        let profile = Profile::new(estimate);
        let directions = estimate.cloud.directions.iter();
        for (leverage, n) in leverages.iter_mut().zip(directions) {
            *leverage *= profile.at(n);
        }
    }
    let scale = learnt(&estimate.unlearnt) / leverages.iter().sum::<f64>();
    let spares = leverages.iter().map(|leverage| 1.0 - scale * leverage);
    spares.map(|spare| spare.max(LEAST)).collect()
}

/// Points that tell the density about one of them, itself left out.
const VICINITY: usize = 16;

/// Leverages that follow the density of the points.
fn by_density(estimate: &Estimate) -> Vec<f64> {
    let cloud = &estimate.cloud;
    let neighbours = Neighbours::new(&cloud.directions);
    let noise = estimate.spectrum.noise().powi(2);
    let variances = estimate.spectrum.variances(estimate.degree);
    let points = cloud.directions.iter().zip(&cloud.weights);
    let leverages = points.map(|(n, own)| {
        let near = neighbours.nearest(n, VICINITY + 1);
        let weight: f64 = near.iter().skip(1).map(|&i| cloud.weights[i]).sum();
        let farthest = near
            .last()
            .map_or(0.0, |&i| (cloud.directions[i] - n).norm());
        // The solid angle of a cap is pi times the square of the chord from its middle to its rim.
        let density = weight / (PI * farthest * farthest);
        let of_degree = |(l, v): (usize, &f64)| (2 * l + 1) as f64 * v / (density * v + noise);
        own * variances.iter().enumerate().map(of_degree).sum::<f64>()
    });
    leverages.collect()
}

/// Leverage against polar angle, in any unit: both halves of the sphere are alike.
struct Profile(Vec<f64>);

impl Profile {
    fn new(estimate: &Estimate) -> Self {
        let degree = estimate.degree;
        let basis = HarmonicBasis::new(degree);
        let left = (0..=degree).flat_map(|l| estimate.spectrum.left(l, estimate.unlearnt[l]));
        let learnt: Vec<f64> = left.map(|q| 1.0 - q).collect();
        let mut values = vec![0.0; coefficient_count(degree)];
        // At azimuth 0 an order's cosine stands for both of its harmonics.
        let angles = (0..=2 * degree).map(|i| FRAC_PI_2 * i as f64 / (2 * degree) as f64);
        let leverages = angles.map(|polar| {
            basis.evaluate(&Vector3::new(polar.sin(), 0.0, polar.cos()), &mut values);
            let terms = values.iter().zip(&learnt);
            terms.map(|(y, learnt)| learnt * y * y).sum()
        });
        Self(leverages.collect())
    }

    /// Between the angles, linearly.
    fn at(&self, n: &Vector3<f64>) -> f64 {
        let place = n.z.abs().min(1.0).acos() / FRAC_PI_2 * (self.0.len() - 1) as f64;
        let below = (place as usize).min(self.0.len() - 2);
        let share = place - below as f64;
        self.0[below] * (1.0 - share) + self.0[below + 1] * share
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;

    /// By its definition: w y'C y / s^2 of the harmonics y at each point.
    fn exact(estimate: &Estimate) -> Vec<f64> {
        let posterior = estimate.posterior();
        let given = estimate.given(&posterior);
        let basis = HarmonicBasis::new(estimate.degree);
        let rows = estimate.cloud.directions.iter().map(|n| {
            let mut row = vec![0.0; coefficient_count(estimate.degree)];
            basis.evaluate(n, &mut row);
            row
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        let covariances = given.covariances(&rows);
        let noise = estimate.spectrum.noise().powi(2);
        let known = rows.iter().zip(&covariances).zip(&estimate.cloud.weights);
        known
            .map(|((row, known), weight)| {
                let variance: f64 = row.iter().zip(known).map(|(y, c)| y * c).sum();
                weight * variance / noise
            })
            .collect()
    }

    #[test]
    fn thin_parts_of_a_cloud_have_the_leverage_of_their_density() {
        let even = fibonacci(900).into_iter().enumerate();
        let kept = even.filter(|(i, n)| n.x > 0.0 || i % 6 == 0);
        let directions: Vec<_> = kept.map(|(_, n)| n).collect();
        let bumps = |n: &Vector3<f64>| {
            3.0 + 0.2 * (4.0 * n.x + 1.0).sin() * (5.0 * n.y).cos() + 0.1 * (7.0 * n.z).sin()
        };
        let cloud = samples(&directions, bumps, 0.05);
        let estimate = estimated(&cloud, Vector3::repeat(3.0));
        assert!(estimate.cloud.is_uneven() && estimate.factor.is_some());
        let exact = exact(&estimate);
        let told: Vec<f64> = spares(&estimate).iter().map(|spare| 1.0 - spare).collect();
        let mean = |leverages: &[f64], is_thin: bool| {
            let points = leverages.iter().zip(&estimate.cloud.directions);
            let (sum, count) = points
                .filter(|(_, n)| (n.x < -0.3) == is_thin && n.x.abs() > 0.3)
                .fold((0.0, 0.0), |(sum, count), (h, _)| (sum + h, count + 1.0));
            sum / count
        };
        for is_thin in [true, false] {
            let (exact, told) = (mean(&exact, is_thin), mean(&told, is_thin));
            assert!(
                (told / exact - 1.0).abs() < 0.1,
                "{is_thin}: {told} {exact}"
            );
        }
        assert!(mean(&exact, true) > 1.5 * mean(&exact, false));
    }
}
