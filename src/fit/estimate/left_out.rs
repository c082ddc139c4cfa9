//! Errors where what is left of the points is no noise: what leaving out each point in turn does.
//!
//! The posterior takes the misfit as noise of one size. Of kernels and stones it is detail between the points, large along
//! creases and edges. A point that is left out is missed by e / (1 - h), with its residual e and its leverage h, and
//! without it a functional g of the coefficients is another by
//!
//! ```text
//! d = w y'C g e / (s^2 (1 - h))
//! ```
//!
//! The sum of the squares of d over the points is the variance of the functional whatever the sizes of the misfits (the
//! jackknife: Quenouille, Tukey), and the sum of d tells what they do together where they are of one sign: so the area
//! lacks its edges. Both are added to the posterior variance, also where a single point is missed by more than noise can
//! tell: in a thin part of a cloud it may be all that tells of a beak.
//!
//! Measured: 95 % intervals hold volume and area of all of 87 barley kernels of 1538 points, with standard errors of .25 and
//! 1.7 % (medians), and 100 and 94 to 100 % of those of stones and kernels scanned at random on their faces.

use super::outcome::Estimate;
use super::posterior::Posterior;
use super::unresolved::FLOOR;
use crate::fit::outcome::figures::{INTEGRALS, MassList};
use crate::fit::points::neighbours::Neighbours;
use crate::vectorize::dot;
use nalgebra::{SMatrix, Vector3};
use std::cell::OnceCell;

/// Points near an end that tell how far the surface may be off there.
const VICINITY: usize = 10;

/// Points left out one by one.
pub(super) struct LeftOut<'a> {
    posterior: &'a Posterior<'a>,
    neighbours: OnceCell<Neighbours>,
    /// By how much the others miss each, in units of the mean radius.
    errors: Vec<f64>,
    /// Square of the noise, likewise.
    noise: f64,
    /// Whether one of them is missed by more than noise can tell.
    pub(super) stand_out: bool,
    /// Whether what is left of them is no noise.
    is_rough: bool,
}

/// The largest of n normal numbers is in nineteen of twenty cases below sqrt(2 log 4n) standard deviations.
const PER_POINT: f64 = 4.0;

impl<'a> LeftOut<'a> {
    /// `residuals`: of the points, in units of the mean radius.
    pub(super) fn new(
        estimate: &Estimate,
        posterior: &'a Posterior<'a>,
        residuals: &[f64],
        is_rough: bool,
    ) -> Self {
        let noise = estimate.spectrum.noise().powi(2);
        let spares = estimate.spares();
        let most = 2.0 * (PER_POINT * residuals.len() as f64).ln();
        let weighted = spares.iter().zip(&posterior.cloud.weights);
        let stand_out = residuals.iter().zip(weighted).any(|(e, (spare, weight))| {
            let expected = noise / (weight * spare) + FLOOR * FLOOR;
            (e / spare).powi(2) > most * expected
        });
        let errors = residuals.iter().zip(spares.iter());
        Self {
            posterior,
            neighbours: OnceCell::new(),
            errors: errors.map(|(e, spare)| e / spare).collect(),
            noise,
            stand_out,
            is_rough,
        }
    }

    /// What is to be added to the covariance of functionals whose covariances with all coefficients are given.
    pub(super) fn covariance(
        &self,
        functionals: &[Vec<f64>],
    ) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        let moves: Vec<Vec<f64>> = functionals.iter().map(|g| self.moves(g)).collect();
        let together = MassList::from_fn(|i, _| moves[i].iter().sum());
        let alone = SMatrix::from_fn(|i, j| dot(&moves[i], &moves[j]));
        alone + together * together.transpose()
    }

    /// By how much each point moves a functional whose covariances with all coefficients are given.
    fn moves(&self, functional: &[f64]) -> Vec<f64> {
        let mut moves = self.posterior.radii(functional);
        let points = self.posterior.cloud.weights.iter().zip(&self.errors);
        for (known, (weight, error)) in moves.iter_mut().zip(points) {
            *known *= weight * error / self.noise;
        }
        moves
    }

    /// Mean square of the errors nearest to a direction.
    pub(super) fn near(&self, n: &Vector3<f64>) -> f64 {
        let directions = &self.posterior.cloud.directions;
        let neighbours = self.neighbours.get_or_init(|| Neighbours::new(directions));
        let near = neighbours.nearest(n, VICINITY);
        let squares = near.iter().map(|&i| self.errors[i] * self.errors[i]);
        squares.sum::<f64>() / near.len().max(1) as f64
    }

    /// By how much the body may reach farther along a unit vector than `height`, where what is left is no noise: an edge,
    /// of which the points hold more than the surface, and the body about as much more than the farthest point as
    /// this is farther than the third (of a cone 1.2 times as much in the mean, of a round end half). In units of the mean
    /// radius, in the stretched space.
    pub(super) fn beyond(&self, towards: &Vector3<f64>, height: f64) -> f64 {
        if !self.is_rough {
            return 0.0;
        }
        let cloud = self.posterior.cloud;
        let mut highest = [f64::NEG_INFINITY; 3];
        for (n, radius) in cloud.directions.iter().zip(&cloud.radii) {
            let own = radius * n.dot(towards);
            let place = highest.partition_point(|other| *other >= own);
            if place < highest.len() {
                highest[place..].rotate_right(1);
                highest[place] = own;
            }
        }
        let [first, _, third] = highest;
        let beyond = 2.0 * first - third - height;
        if beyond.is_finite() {
            beyond.max(0.0)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests;
