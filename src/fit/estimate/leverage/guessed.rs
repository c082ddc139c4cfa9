//! Leverages of many points, by the mean of all of them.
//!
//! The mean is told by what the points leave of the prior variances. Where orders differ by a tilt, leverages depend on the
//! polar angle: as of an even cloud, as sum of (1 - q_lm) Y_lm^2. In an uneven cloud they depend on the density of the
//! points near by, N per solid angle: as of an even cloud of that density, as sum of (2l + 1) w v_l / (N v_l + s^2) / 4 pi.

use super::super::outcome::{Estimate, learnt};
use crate::fit::points::neighbours::Neighbours;
use crate::sphere::{HarmonicBasis, coefficient_count};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Floor of 1 - h, which is told by a mean over points.
const LEAST: f64 = 0.1;

/// 1 - h of every point.
pub(super) fn guessed(estimate: &Estimate) -> Vec<f64> {
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
