//! The matrix Y'WY of the harmonics in weighted directions, at a price that does not depend on their number.
//!
//! A product of two expansions of degree L is a polynomial h of degree 2L. Let w(n) be the expansion to
//! degree 2L of the weights as points on the sphere, with the coefficients
//!
//! ```text
//! w_j = sum_i w_i Y_j(n_i),    so that    sum_i w_i h(n_i) = integral of w h
//! ```
//!
//! for every such h. The integrand has degree 4L, and its integral is a sum over a grid of 2L + 1
//! Gauss-Legendre rings: there the matrix is Y'DY with a diagonal D, which has entries of either sign.
//! Error: that of the coefficients w_j.

use super::gauss_grid::GaussGrid;
use std::sync::Arc;

/// The matrix as an operator.
pub(crate) struct HarmonicGram {
    grid: Arc<GaussGrid>,
    diagonal: Vec<f64>,
}

impl HarmonicGram {
    /// The matrix of the harmonics up to `degree`, from the coefficients w_j of degree <= 2 `degree`.
    ///
    /// # Panics
    /// If there are fewer than (2 `degree` + 1)² of them.
    pub(crate) fn new(degree: usize, moments: &[f64]) -> Self {
        let wide = GaussGrid::of_degree(2 * degree, 4 * degree);
        let mut diagonal = vec![0.0; wide.len()];
        wide.synthesis(moments, &mut diagonal);
        for (entry, weight) in diagonal.iter_mut().zip(wide.weights()) {
            *entry *= weight;
        }
        Self {
            grid: GaussGrid::of_degree(degree, 4 * degree),
            diagonal,
        }
    }

    /// out = Y'WY x.
    ///
    /// # Panics
    /// If there are fewer than (degree + 1)² numbers.
    pub(crate) fn apply(&self, x: &[f64], out: &mut [f64]) {
        let mut values = vec![0.0; self.grid.len()];
        self.grid.synthesis(x, &mut values);
        for (value, weight) in values.iter_mut().zip(&self.diagonal) {
            *value *= weight;
        }
        self.grid.adjoint(&mut values, out);
    }
}
