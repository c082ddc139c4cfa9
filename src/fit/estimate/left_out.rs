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
//! lacks its edges. Both are added to the posterior variance. For h stands its mean over the points, or over those
//! of one polar angle.
//!
//! Measured: 95 % intervals hold the volume of 86 and the area of all of 87 barley kernels, with standard errors of .09 and
//! .9 % (medians), and 100 and 91 to 100 % of those of stones and kernels scanned at random on their faces.

use super::functionals::dot;
use super::leverage::spares;
use super::outcome::Estimate;
use super::posterior::Posterior;
use crate::fit::figures::{INTEGRALS, MassList};
use crate::fit::neighbours::Neighbours;
use nalgebra::{SMatrix, Vector3};

/// Points near an end that tell how far the surface may be off there.
const VICINITY: usize = 10;

/// Points left out one by one.
pub(super) struct LeftOut<'a> {
    posterior: &'a Posterior<'a>,
    neighbours: Neighbours,
    /// By how much the others miss each, in units of the mean radius.
    errors: Vec<f64>,
    /// Square of the noise, likewise.
    noise: f64,
}

impl<'a> LeftOut<'a> {
    pub(super) fn new(estimate: &Estimate, posterior: &'a Posterior<'a>) -> Self {
        let residuals = posterior.residuals(&estimate.coefficients).into_iter();
        Self {
            posterior,
            neighbours: Neighbours::new(&posterior.cloud.directions),
            errors: residuals
                .zip(spares(estimate))
                .map(|(e, spare)| e / spare)
                .collect(),
            noise: estimate.spectrum.noise().powi(2),
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
        let near = self.neighbours.nearest(n, VICINITY);
        let squares = near.iter().map(|&i| self.errors[i] * self.errors[i]);
        squares.sum::<f64>() / near.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests;
