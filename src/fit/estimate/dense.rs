//! The matrix of a small problem, factored.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltParams, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, MatMut, MatRef, Par, Spec};

/// The Cholesky factor of I + V^1/2 Y'WY V^1/2 / s^2.
#[derive(Debug)]
pub(crate) struct Factor(Mat<f64>);

impl Factor {
    /// From the lower triangle of Y'WY, the variances and s^2. `None` if the matrix is not positive.
    pub(super) fn new(gram: &Mat<f64>, variances: &[f64], noise: f64) -> Option<Self> {
        let root: Vec<f64> = variances.iter().map(|v| v.sqrt()).collect();
        let count = root.len();
        let mut matrix = Mat::zeros(count, count);
        for j in 0..count {
            let (from, to) = (gram.col_as_slice(j), matrix.col_as_slice_mut(j));
            let scale = root[j] / noise;
            for i in j..count {
                to[i] = from[i] * root[i] * scale;
            }
            to[j] += 1.0;
        }
        let params = Spec::<LltParams, f64>::default();
        let scratch = cholesky_in_place_scratch::<f64>(count, Par::Seq, params);
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        let nothing_added = LltRegularization::default();
        cholesky_in_place(matrix.as_mut(), nothing_added, Par::Seq, stack, params).ok()?;
        Some(Self(matrix))
    }

    /// The factor L.
    pub(super) fn lower(&self) -> MatRef<'_, f64> {
        self.0.as_ref()
    }

    /// The logarithm of the root of the determinant.
    pub(super) fn log_root_determinant(&self) -> f64 {
        (0..self.0.nrows()).map(|j| self.0[(j, j)].ln()).sum()
    }

    /// Solves L L' x = right, in place, of each column.
    pub(super) fn solve(&self, mut columns: MatMut<'_, f64>) {
        let lower = self.0.as_ref();
        solve_lower_triangular_in_place(lower, columns.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(lower.transpose(), columns, Par::Seq);
    }
}
