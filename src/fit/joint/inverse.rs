//! The entries of the inverse of a block matrix within the pattern of its factor.
//!
//! They follow from the factor, last column first, by Takahashi's recurrence (K. Takahashi, J. Fagan,
//! M. Chin, 1973), which costs as much as the factor.

use super::sparse::{BlockFactor, Column, copy};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::{Accum, Mat, MatRef, Par};

impl BlockFactor {
    /// The blocks of the inverse on the pattern of the factor, as lower blocks in the order of
    /// elimination.
    pub(crate) fn inverse(&self) -> BlockInverse {
        let mut columns: Vec<Column> = Vec::with_capacity(self.columns.len());
        // From the last column to the first; `columns` is kept reversed.
        let count = self.columns.len();
        for at in (0..count).rev() {
            let factor = &self.columns[at];
            let (size, height) = (factor.diagonal.nrows(), factor.below.nrows());
            let mut per_diagonal = Mat::zeros(size, size);
            invert_lower_triangular(per_diagonal.as_mut(), factor.diagonal.as_ref(), Par::Seq);
            // Y = B L^-1; then Z_below = -Z_rows Y, Z_diagonal = L^-T L^-1 - Y^T Z_below.
            let mut y = Mat::zeros(height, size);
            matmul(
                y.as_mut(),
                Accum::Replace,
                factor.below.as_ref(),
                per_diagonal.as_ref(),
                1.0,
                Par::Seq,
            );
            let known = gather(&factor.rows, &factor.starts, height, |position| {
                &columns[count - 1 - position]
            });
            let mut below = Mat::zeros(height, size);
            matmul(
                below.as_mut(),
                Accum::Replace,
                known.as_ref(),
                y.as_ref(),
                -1.0,
                Par::Seq,
            );
            let mut diagonal = Mat::zeros(size, size);
            matmul(
                diagonal.as_mut(),
                Accum::Replace,
                per_diagonal.transpose(),
                per_diagonal.as_ref(),
                1.0,
                Par::Seq,
            );
            matmul(
                diagonal.as_mut(),
                Accum::Add,
                y.transpose(),
                below.as_ref(),
                -1.0,
                Par::Seq,
            );
            columns.push(Column {
                index: factor.index,
                diagonal,
                rows: factor.rows.clone(),
                starts: factor.starts.clone(),
                below,
            });
        }
        columns.reverse();
        BlockInverse {
            sizes: self.sizes.clone(),
            position: self.position.clone(),
            columns,
        }
    }
}

/// The symmetric matrix of the known blocks at some positions, in any order.
fn gather<'a>(
    positions: &[usize],
    starts: &[usize],
    height: usize,
    column: impl Fn(usize) -> &'a Column,
) -> Mat<f64> {
    let mut all = Mat::zeros(height, height);
    for (&position, &at) in positions.iter().zip(starts) {
        let from = column(position);
        let size = from.diagonal.nrows();
        copy(
            all.as_mut().submatrix_mut(at, at, size, size),
            from.diagonal.as_ref(),
        );
        for (&lower, &lower_at) in positions.iter().zip(starts) {
            if lower <= position {
                continue;
            }
            let Some(start) = from.start_of(lower) else {
                continue;
            };
            let lower_size = column(lower).diagonal.nrows();
            let part = from.below.subrows(start, lower_size);
            copy(
                all.as_mut().submatrix_mut(lower_at, at, lower_size, size),
                part,
            );
            copy(
                all.as_mut().submatrix_mut(at, lower_at, size, lower_size),
                part.transpose(),
            );
        }
    }
    all
}

/// The inverse of a block matrix, on the pattern of its factor.
pub(crate) struct BlockInverse {
    sizes: Vec<usize>,
    position: Vec<usize>,
    columns: Vec<Column>,
}

impl BlockInverse {
    /// The diagonal block of a block row.
    pub(crate) fn diagonal(&self, index: usize) -> MatRef<'_, f64> {
        self.columns[self.position[index]].diagonal.as_ref()
    }

    /// The dense symmetric matrix of some block rows, each tied to all others.
    pub(crate) fn dense(&self, cells: &[u16]) -> Mat<f64> {
        let mut starts = Vec::with_capacity(cells.len());
        let mut height = 0;
        for &cell in cells {
            starts.push(height);
            height += self.sizes[usize::from(cell)];
        }
        let positions: Vec<usize> = cells
            .iter()
            .map(|&cell| self.position[usize::from(cell)])
            .collect();
        gather(&positions, &starts, height, |position| {
            &self.columns[position]
        })
    }
}
