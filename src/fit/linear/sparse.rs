//! Symmetric positive definite matrices made of dense blocks, few of which are not zero: Cholesky
//! factor and solution.
//!
//! A block row belongs to a cell, and a block is filled where two cells overlap. The factor has the
//! pattern of the elimination in an order of least degree.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltParams, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatMut, MatRef, Par, Spec};
use std::collections::{BTreeMap, BTreeSet};

/// A symmetric matrix by blocks: `blocks[(i, j)]`, i >= j, and the size of each block row.
#[derive(Clone)]
pub(crate) struct BlockMatrix {
    pub(crate) sizes: Vec<usize>,
    pub(crate) blocks: BTreeMap<(u16, u16), Mat<f64>>,
}

/// Its Cholesky factor: block columns in the order of elimination.
#[derive(Debug, Clone)]
pub(crate) struct BlockFactor {
    columns: Vec<Column>,
}

/// A block column: the diagonal block and, stacked, the blocks below it.
#[derive(Debug, Clone)]
struct Column {
    /// The block row that it belongs to.
    index: usize,
    diagonal: Mat<f64>,
    /// Positions of the blocks below, ascending, and where each begins in `below`.
    rows: Vec<usize>,
    starts: Vec<usize>,
    below: Mat<f64>,
}

impl Column {
    fn start_of(&self, position: usize) -> Option<usize> {
        let at = self.rows.binary_search(&position).ok()?;
        Some(self.starts[at])
    }
}

impl BlockMatrix {
    pub(crate) fn new(sizes: Vec<usize>) -> Self {
        Self {
            sizes,
            blocks: BTreeMap::new(),
        }
    }

    /// The block (i, j), i >= j, made of zeros if it is not there yet.
    pub(crate) fn block(&mut self, i: u16, j: u16) -> &mut Mat<f64> {
        let (rows, columns) = (self.sizes[usize::from(i)], self.sizes[usize::from(j)]);
        self.blocks
            .entry((i, j))
            .or_insert_with(|| Mat::zeros(rows, columns))
    }

    /// The order of elimination: always a row that is tied to the fewest others.
    fn order(&self) -> (Vec<usize>, Vec<Vec<usize>>) {
        let count = self.sizes.len();
        let mut tied: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        for &(i, j) in self.blocks.keys() {
            if i != j {
                tied[usize::from(i)].insert(j.into());
                tied[usize::from(j)].insert(i.into());
            }
        }
        let mut order = Vec::with_capacity(count);
        let mut patterns = Vec::with_capacity(count);
        let mut left: BTreeSet<usize> = (0..count).collect();
        while let Some(&next) = left.iter().min_by_key(|&&i| (tied[i].len(), i)) {
            left.remove(&next);
            let around: Vec<usize> = std::mem::take(&mut tied[next]).into_iter().collect();
            for &i in &around {
                tied[i].remove(&next);
                tied[i].extend(around.iter().copied().filter(|&j| j != i));
            }
            order.push(next);
            patterns.push(around);
        }
        (order, patterns)
    }

    /// The Cholesky factor; `None` if the matrix is not positive definite to rounding.
    pub(crate) fn factor(&self) -> Option<BlockFactor> {
        let (order, patterns) = self.order();
        let mut position = vec![0; order.len()];
        for (at, &index) in order.iter().enumerate() {
            position[index] = at;
        }
        let mut columns: Vec<Column> = order
            .iter()
            .zip(patterns)
            .map(|(&index, pattern)| self.column(index, pattern, &position))
            .collect();
        let largest = self.sizes.iter().copied().max().unwrap_or(0);
        let params = Spec::<LltParams, f64>::default();
        let mut memory =
            MemBuffer::new(cholesky_in_place_scratch::<f64>(largest, Par::Seq, params));
        for at in 0..columns.len() {
            let (done, rest) = columns.split_at_mut(at + 1);
            let column = &mut done[at];
            cholesky_in_place(
                column.diagonal.as_mut(),
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                params,
            )
            .ok()?;
            // B L^-T: the blocks below, transposed, are solved with L.
            solve_lower_triangular_in_place(
                column.diagonal.as_ref(),
                column.below.transpose_mut(),
                Par::Seq,
            );
            column.update(rest, at + 1);
        }
        Some(BlockFactor { columns })
    }

    fn column(&self, index: usize, pattern: Vec<usize>, position: &[usize]) -> Column {
        let mut rows: Vec<(usize, usize)> = pattern
            .into_iter()
            .map(|row| (position[row], row))
            .collect();
        rows.sort_unstable();
        let size = self.sizes[index];
        let mut starts = Vec::with_capacity(rows.len());
        let mut height = 0;
        for &(_, row) in &rows {
            starts.push(height);
            height += self.sizes[row];
        }
        let mut below = Mat::zeros(height, size);
        for (&(_, row), &start) in rows.iter().zip(&starts) {
            let part = below.subrows_mut(start, self.sizes[row]);
            let (high, low) = (row.max(index) as u16, row.min(index) as u16);
            if let Some(block) = self.blocks.get(&(high, low)) {
                let block = if row > index {
                    block.as_ref()
                } else {
                    block.transpose()
                };
                copy(part, block);
            }
        }
        let diagonal = self
            .blocks
            .get(&(index as u16, index as u16))
            .cloned()
            .unwrap_or_else(|| Mat::zeros(size, size));
        Column {
            index,
            diagonal,
            rows: rows.into_iter().map(|(position, _)| position).collect(),
            starts,
            below,
        }
    }
}

fn copy(mut to: MatMut<'_, f64>, from: MatRef<'_, f64>) {
    to.copy_from(from);
}

impl Column {
    /// Subtracts B B^T from the columns of the rows that B has; `rest` begins at position `first`.
    fn update(&self, rest: &mut [Column], first: usize) {
        let ends: Vec<usize> = (1..self.rows.len())
            .map(|row| self.starts[row])
            .chain([self.below.nrows()])
            .collect();
        for (k, &row) in self.rows.iter().enumerate() {
            let target = &mut rest[row - first];
            let own = self.below.subrows(self.starts[k], ends[k] - self.starts[k]);
            let subtract = |part: MatMut<'_, f64>, rows: MatRef<'_, f64>| {
                matmul(part, Accum::Add, rows, own.transpose(), -1.0, Par::Seq);
            };
            subtract(target.diagonal.as_mut(), own);
            // Rows that follow each other there too, at once.
            let mut next = k + 1;
            while next < self.rows.len() {
                let Some(start) = target.start_of(self.rows[next]) else {
                    next += 1;
                    continue;
                };
                let from = self.starts[next];
                let follows = |&l: &usize| {
                    target.start_of(self.rows[l]) == Some(start + self.starts[l] - from)
                };
                let last = (next..self.rows.len()).take_while(follows).last();
                let last = last.unwrap_or(next);
                let height = ends[last] - from;
                let rows = self.below.subrows(from, height);
                subtract(target.below.subrows_mut(start, height), rows);
                next = last + 1;
            }
        }
    }
}

impl BlockFactor {
    /// Solves for a right-hand side per block row.
    pub(crate) fn solve(&self, right: &mut [Mat<f64>]) {
        self.forward(right);
        self.backward(right);
    }

    fn forward(&self, right: &mut [Mat<f64>]) {
        for column in &self.columns {
            let own = &mut right[column.index];
            solve_lower_triangular_in_place(column.diagonal.as_ref(), own.as_mut(), Par::Seq);
            let products = &column.below * &*own;
            for (&row, &start) in column.rows.iter().zip(&column.starts) {
                let block = &mut right[self.columns[row].index];
                *block -= products.subrows(start, block.nrows());
            }
        }
    }

    /// Solves with the transposed factor.
    fn backward(&self, right: &mut [Mat<f64>]) {
        for column in self.columns.iter().rev() {
            let columns = right[column.index].ncols();
            let mut others = Mat::zeros(column.below.nrows(), columns);
            for (&row, &start) in column.rows.iter().zip(&column.starts) {
                let block = &right[self.columns[row].index];
                others.subrows_mut(start, block.nrows()).copy_from(block);
            }
            let own = &mut right[column.index];
            let part = column.below.transpose();
            matmul(own.as_mut(), Accum::Add, part, &others, -1.0, Par::Seq);
            solve_upper_triangular_in_place(column.diagonal.transpose(), own.as_mut(), Par::Seq);
        }
    }
}

#[cfg(test)]
mod tests;
