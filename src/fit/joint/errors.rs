//! What a joint fit says of its samples: residuals, and errors of predictions.
//!
//! Predicted from the fit of all samples but itself, a sample is missed by e / (1 - h), with e its
//! residual and h = w a' Z a its leverage: a its row of the design matrix, w its weight and Z the
//! inverse of the matrix of the problem, of which only blocks of cells that overlap are needed.

use super::inverse::BlockInverse;
use super::normal::Prior;
use super::system::{Coefficients, System};
use crate::fit::level::LARGEST_MISS;
use crate::fit::samples::Sample;
use crate::fit::search::Rejection;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

/// What a fit says of its samples.
pub(crate) struct Errors {
    /// Radius less fitted radius.
    pub(crate) residuals: Vec<f64>,
    /// 1 - leverage: residual over error of a prediction from all other samples.
    pub(crate) spare: Vec<f64>,
}

impl Errors {
    /// Leave-one-out errors.
    pub(crate) fn held_out(&self) -> impl Iterator<Item = f64> {
        let pairs = self.residuals.iter().zip(&self.spare);
        pairs.map(|(residual, spare)| residual / spare.max(LEAST_SPARE))
    }

    /// Whether, and by how much, a prediction misses its sample by too much.
    pub(crate) fn rejection(&self, samples: &[Sample]) -> Option<Rejection> {
        let relative = self
            .held_out()
            .zip(samples)
            .map(|(error, s)| (error / s[3]).abs());
        let worst = relative.fold(0.0, f64::max);
        (worst > LARGEST_MISS).then_some(Rejection::Misses { worst })
    }

    /// Root mean square of the leave-one-out errors.
    pub(crate) fn heldout_rms(&self) -> f64 {
        (self.held_out().map(|e| e * e).sum::<f64>() / self.residuals.len() as f64).sqrt()
    }
}

/// Floor of 1 - leverage: rounding can take it to 0.
const LEAST_SPARE: f64 = 1e-6;

impl System<'_> {
    /// Residuals of all samples.
    pub(crate) fn residuals(&self, coefficients: &Coefficients) -> Vec<f64> {
        let parts = self.blocks(|group, from, to, workspace| {
            self.design(group, from, to, workspace);
            (
                from,
                self.residual(group, coefficients, workspace, to - from),
            )
        });
        let mut residuals = vec![0.0; self.samples.len()];
        for (number, (from, part)) in parts {
            let members = &self.groups[number].members[from..];
            for (&member, residual) in members.iter().zip(part) {
                residuals[member as usize] = residual;
            }
        }
        residuals
    }

    /// Residuals and leave-one-out errors of all samples.
    pub(crate) fn errors(&self, coefficients: &Coefficients, inverse: &BlockInverse) -> Errors {
        let parts = self.blocks(|group, from, to, workspace| {
            let rows = to - from;
            let columns = self.design(group, from, to, workspace);
            let residuals = self.residual(group, coefficients, workspace, rows);
            let variance = inverse.dense(&group.cells);
            let design = &workspace.design[..columns * rows];
            let a = MatRef::from_column_major_slice(design, rows, columns);
            let mut product = Mat::<f64>::zeros(rows, columns);
            matmul(
                product.as_mut(),
                Accum::Replace,
                a,
                variance.as_ref(),
                1.0,
                Par::Seq,
            );
            let mut leverage = vec![0.0; rows];
            for j in 0..columns {
                let z = product.col_as_slice(j);
                for ((leverage, z), a) in leverage.iter_mut().zip(z).zip(&design[j * rows..]) {
                    *leverage += z * a;
                }
            }
            (from, residuals, leverage)
        });
        let count = self.samples.len();
        let mut errors = Errors {
            residuals: vec![0.0; count],
            spare: vec![0.0; count],
        };
        for (number, (from, residuals, leverage)) in parts {
            let members = &self.groups[number].members[from..];
            for ((&member, residual), leverage) in members.iter().zip(residuals).zip(leverage) {
                let member = member as usize;
                errors.residuals[member] = residual;
                errors.spare[member] = 1.0 - leverage * self.weights[member];
            }
        }
        errors
    }

    /// How many coefficients the samples, and not the prior, determine: the trace of the matrix that
    /// takes the samples to the fitted radii.
    pub(crate) fn determined(&self, prior: &Prior, inverse: &BlockInverse) -> f64 {
        self.sizes()
            .iter()
            .enumerate()
            .map(|(cell, &size)| {
                let block = inverse.diagonal(cell);
                (0..size)
                    .map(|j| 1.0 - prior.weight(cell, j) * block[(j, j)])
                    .sum::<f64>()
            })
            .sum()
    }
}
