//! The matrix of a small problem, factored.
//!
//! Matrices lie in memory that comes zeroed from the system, of which the half above the diagonal is never touched.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltParams, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{MatMut, MatRef, Par, Spec};

/// The Cholesky factor of I + V^1/2 Y'WY V^1/2 / s^2.
#[derive(Debug)]
pub(crate) struct Factor {
    /// Rows, and columns.
    count: usize,
    /// Column by column.
    entries: Vec<f64>,
}

impl Factor {
    /// From the lower triangle of Y'WY, column by column, the variances and s^2. `None` if the matrix is not positive.
    pub(super) fn new(gram: &[f64], variances: &[f64], noise: f64) -> Option<Self> {
        let root: Vec<f64> = variances.iter().map(|v| v.sqrt()).collect();
        let count = root.len();
        let mut entries = vec![0.0; count * count];
        let columns = entries
            .chunks_exact_mut(count)
            .zip(gram.chunks_exact(count));
        for (j, (to, from)) in columns.enumerate() {
            let scale = root[j] / noise;
            let below = to[j..].iter_mut().zip(from[j..].iter().zip(&root[j..]));
            for (to, (from, root)) in below {
                *to = from * root * scale;
            }
            to[j] += 1.0;
        }
        let params = Spec::<LltParams, f64>::default();
        let scratch = cholesky_in_place_scratch::<f64>(count, Par::Seq, params);
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        let nothing_added = LltRegularization::default();
        let matrix = MatMut::from_column_major_slice_mut(&mut entries, count, count);
        cholesky_in_place(matrix, nothing_added, Par::Seq, stack, params).ok()?;
        Some(Self { count, entries })
    }

    /// The factor L.
    pub(super) fn lower(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.entries, self.count, self.count)
    }

    /// The diagonal of the inverse.
    pub(super) fn inverse_diagonal(&self) -> Vec<f64> {
        let mut inverse = vec![0.0; self.count * self.count];
        let matrix = MatMut::from_column_major_slice_mut(&mut inverse, self.count, self.count);
        invert_lower_triangular(matrix, self.lower(), Par::Seq);
        let columns = inverse.chunks_exact(self.count).enumerate();
        let squares = columns.map(|(j, column)| column[j..].iter().map(|x| x * x).sum());
        squares.collect()
    }

    /// The logarithm of the root of the determinant.
    pub(super) fn log_root_determinant(&self) -> f64 {
        let diagonal = self.entries.iter().step_by(self.count + 1);
        diagonal.map(|entry| entry.ln()).sum()
    }

    /// Solves L L' x = right, in place, of each column.
    pub(super) fn solve(&self, mut columns: MatMut<'_, f64>) {
        let lower = self.lower();
        solve_lower_triangular_in_place(lower, columns.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(lower.transpose(), columns, Par::Seq);
    }
}
