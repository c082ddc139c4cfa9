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
//!
//! Along a ring the product of the azimuthal parts of orders m and m' has the orders m + m' and |m - m'| only, so
//! that an entry of the matrix is a sum over rings: with these L^4 / 2 (2L + 1) products instead of L^4 N / 2 the matrix
//! of 1500 points and degree 36 is formed six times as fast.

use super::gauss_grid::GaussGrid;
use crate::sphere::{coefficient_count, harmonic_index};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use std::sync::Arc;

/// The matrix as an operator.
pub(crate) struct HarmonicGram {
    degree: usize,
    grid: Arc<GaussGrid>,
    diagonal: Vec<f64>,
}

impl HarmonicGram {
    /// The matrix of the harmonics up to `degree`, from the coefficients w_j of degree <= 2 `degree`.
    ///
    /// # Panics
    /// If there are fewer than (2 `degree` + 1)² of them.
    pub(crate) fn new(degree: usize, moments: &[f64]) -> Self {
        let wide = GaussGrid::wide(degree);
        let mut diagonal = vec![0.0; wide.len()];
        wide.synthesis(moments, &mut diagonal);
        for (entry, weight) in diagonal.iter_mut().zip(wide.weights()) {
            *entry *= weight;
        }
        Self {
            degree,
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

    /// Y'WY itself, column by column; above the diagonal it is left zero.
    pub(crate) fn lower_triangle(&self) -> Vec<f64> {
        let count = coefficient_count(self.degree);
        let mut matrix = vec![0.0; count * count];
        let wide = GaussGrid::wide(self.degree);
        let folded = wide.folded_terms(&self.diagonal);
        let polar = self.grid.polar();
        let rows = polar.column_length();
        let (mut right, mut places) = (Vec::new(), Vec::new());
        let mut product: Vec<f64> = Vec::new();
        for m in 0..=self.degree {
            for &trig in Trig::of_order(m) {
                for parity in 0..2.min(self.degree + 1 - m) {
                    right.clear();
                    places.clear();
                    for other in m..=self.degree {
                        for &other_trig in Trig::of_order(other) {
                            let weights = [0, 1].map(|fold| {
                                azimuthal(&folded[fold], (m, trig), (other, other_trig))
                            });
                            let columns = polar.columns(other).chunks_exact(rows);
                            for (l, column) in (other..).zip(columns) {
                                let fold = &weights[(l - other + parity) % 2];
                                right.extend(column.iter().zip(fold).map(|(p, w)| p * w));
                                places.push(other_trig.index(l, other));
                            }
                        }
                    }
                    let left = &polar.columns(m)[parity * rows..];
                    let degrees: Vec<usize> = (m + parity..=self.degree).step_by(2).collect();
                    let stride = 2 * rows;
                    let left = MatRef::from_column_major_slice_with_stride(
                        left,
                        rows,
                        degrees.len(),
                        stride,
                    );
                    product.resize(degrees.len() * places.len(), 0.0);
                    matmul(
                        MatMut::from_column_major_slice_mut(
                            &mut product,
                            degrees.len(),
                            places.len(),
                        ),
                        Accum::Replace,
                        left.transpose(),
                        MatRef::from_column_major_slice(&right, rows, places.len()),
                        1.0,
                        Par::Seq,
                    );
                    for (entries, &other) in product.chunks_exact(degrees.len()).zip(&places) {
                        for (&entry, &l) in entries.iter().zip(&degrees) {
                            let own = trig.index(l, m);
                            matrix[own.min(other) * count + own.max(other)] = entry;
                        }
                    }
                }
            }
        }
        matrix
    }
}

/// The azimuthal part of a harmonic.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Trig {
    Cosine,
    Sine,
}

impl Trig {
    /// The parts of order m: that of order 0 has no sine.
    fn of_order(m: usize) -> &'static [Self] {
        match m {
            0 => &[Self::Cosine],
            _ => &[Self::Cosine, Self::Sine],
        }
    }

    /// The index of the harmonic of degree l and order m with this part.
    fn index(self, l: usize, m: usize) -> usize {
        match self {
            Self::Cosine => harmonic_index(l, m as isize),
            Self::Sine => harmonic_index(l, -(m as isize)),
        }
    }
}

/// The azimuthal sums of a product of two parts with a function on rings, whose terms are given by order; half of the
/// terms of the sum and the difference of the orders:
///
/// ```text
/// 2 cos a cos b = cos(a - b) + cos(a + b)    2 sin a sin b = cos(a - b) - cos(a + b)    2 sin a cos b = sin(a + b) + sin(a - b)
/// ```
fn azimuthal(
    terms: &[[Vec<f64>; 2]],
    (m, trig): (usize, Trig),
    (other, other_trig): (usize, Trig),
) -> Vec<f64> {
    let (part, [by_difference, by_sum]) = match (trig, other_trig) {
        (Trig::Cosine, Trig::Cosine) => (0, [0.5, 0.5]),
        (Trig::Sine, Trig::Sine) => (0, [0.5, -0.5]),
        (Trig::Cosine, Trig::Sine) => (1, [0.5, 0.5]),
        (Trig::Sine, Trig::Cosine) => (1, [-0.5, 0.5]),
    };
    let [differences, sums] = [other - m, other + m].map(|order| &terms[order][part]);
    let pairs = differences.iter().zip(sums);
    pairs
        .map(|(difference, sum)| by_difference * difference + by_sum * sum)
        .collect()
}
