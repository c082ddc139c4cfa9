//! The equations of a joint fit and their solution.
//!
//! The matrix A^T W A is formed in the cap bases, which are well conditioned (its condition number
//! stays below 1e6 on sampled cells), completed by the prior, and factored; one step of iterative
//! refinement, with residuals taken from the samples, makes the solution as accurate as that of an
//! orthogonal factorization.

use super::sparse::{BlockFactor, BlockMatrix};
use super::system::{Coefficients, System};
use crate::sphere::coefficient_count;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatRef, Par};

/// Prior of the coefficients: what they should be near to, and how strongly.
pub(crate) struct Prior {
    pub(crate) mean: Coefficients,
    /// Weight per degree, in samples.
    pub(crate) weights: Vec<f64>,
    /// By what the weight in a cell is larger, because it holds few samples per coefficient.
    pub(crate) factors: Vec<f64>,
}

impl Prior {
    /// The weight of coefficient `j` of a cell.
    pub(crate) fn weight(&self, cell: usize, j: usize) -> f64 {
        self.weights[j.isqrt()] * self.factors[cell]
    }
}

/// The matrix A^T W A and the vector A^T W r of a problem in well-conditioned bases.
#[derive(Clone)]
pub(crate) struct Normal {
    matrix: BlockMatrix,
    right: Coefficients,
}

impl Normal {
    /// The equations of lower degrees: those of the leading coefficients of each cell.
    pub(super) fn lowered(&self, degrees: &[usize]) -> Self {
        let sizes: Vec<usize> = degrees.iter().map(|&d| coefficient_count(d)).collect();
        let mut matrix = BlockMatrix::new(sizes.clone());
        for (&(i, j), block) in &self.matrix.blocks {
            let (rows, columns) = (sizes[usize::from(i)], sizes[usize::from(j)]);
            *matrix.block(i, j) = block.submatrix(0, 0, rows, columns).to_owned();
        }
        let right = self.right.iter().zip(&sizes);
        Self {
            matrix,
            right: right.map(|(own, &size)| own[..size].to_vec()).collect(),
        }
    }

    /// Solves the problem with a prior; the factor of its matrix comes with the solution.
    pub(crate) fn solve(self, prior: &Prior) -> (Coefficients, BlockFactor) {
        let Self {
            mut matrix,
            mut right,
        } = self;
        for (cell, right) in right.iter_mut().enumerate() {
            let block = matrix.block(cell as u16, cell as u16);
            for (j, right) in right.iter_mut().enumerate() {
                let weight = prior.weight(cell, j);
                block[(j, j)] += weight;
                *right += weight * prior.mean[cell][j];
            }
        }
        let factor = matrix
            .factor()
            .expect("the prior makes the matrix positive definite far above rounding");
        let coefficients = solve(&factor, &right);
        (coefficients, factor)
    }
}

impl System<'_> {
    /// The matrix A^T W A and the vector A^T W r.
    pub(crate) fn normal(&self) -> Normal {
        let parts = self.blocks(|group, from, to, workspace| {
            let rows = to - from;
            let columns = self.design(group, from, to, workspace);
            let weight = |row: usize| self.weights[group.members[from + row] as usize];
            let design = &mut workspace.design[..columns * rows];
            let radius: Vec<f64> = (0..rows)
                .map(|row| workspace.rows[row][3] * weight(row).sqrt())
                .collect();
            let roots: Vec<f64> = (0..rows).map(|row| weight(row).sqrt()).collect();
            for column in design.chunks_exact_mut(rows) {
                for (value, root) in column.iter_mut().zip(&roots) {
                    *value *= root;
                }
            }
            let a = MatRef::from_column_major_slice(design, rows, columns);
            let mut product = Mat::<f64>::zeros(columns, columns);
            triangular::matmul(
                product.as_mut(),
                BlockStructure::TriangularLower,
                Accum::Replace,
                a.transpose(),
                BlockStructure::Rectangular,
                a,
                BlockStructure::Rectangular,
                1.0,
                Par::Seq,
            );
            let right = transposed_product(design, rows, &radius);
            (product, right)
        });
        let sizes = self.sizes();
        let mut matrix = BlockMatrix::new(sizes.clone());
        let mut right: Coefficients = sizes.iter().map(|&size| vec![0.0; size]).collect();
        for (number, (product, part)) in parts {
            let cells = &self.groups[number].cells;
            let mut row = 0;
            for &i in cells {
                let height = sizes[usize::from(i)];
                let mut column = 0;
                for &j in cells.iter().take_while(|&&j| j <= i) {
                    let width = sizes[usize::from(j)];
                    *matrix.block(i, j) += product.submatrix(row, column, height, width);
                    column += width;
                }
                add(&mut right[usize::from(i)], &part[row..row + height]);
                row += height;
            }
        }
        Normal { matrix, right }
    }

    /// The gradient A^T W (r - A c) of the fit.
    fn gradient(&self, coefficients: &Coefficients) -> Coefficients {
        let parts = self.blocks(|group, from, to, workspace| {
            let rows = to - from;
            let columns = self.design(group, from, to, workspace);
            let mut residual = self.residual(group, coefficients, workspace, rows);
            for (row, residual) in residual.iter_mut().enumerate() {
                *residual *= self.weights[group.members[from + row] as usize];
            }
            transposed_product(&workspace.design[..columns * rows], rows, &residual)
        });
        let mut gradient: Coefficients = self.sizes().iter().map(|&size| vec![0.0; size]).collect();
        for (number, part) in parts {
            let mut row = 0;
            for &cell in &self.groups[number].cells {
                let own = &mut gradient[usize::from(cell)];
                let size = own.len();
                add(own, &part[row..row + size]);
                row += size;
            }
        }
        gradient
    }

    /// As [`Normal::solve`], with a step of iterative refinement whose residuals come from the samples
    /// themselves: as accurate as an orthogonal factorization.
    pub(crate) fn solve_refined(
        &self,
        normal: Normal,
        prior: &Prior,
    ) -> (Coefficients, BlockFactor) {
        let (mut coefficients, factor) = normal.solve(prior);
        for _ in 0..REFINEMENTS {
            let mut gradient = self.gradient(&coefficients);
            for (cell, gradient) in gradient.iter_mut().enumerate() {
                for (j, gradient) in gradient.iter_mut().enumerate() {
                    *gradient +=
                        prior.weight(cell, j) * (prior.mean[cell][j] - coefficients[cell][j]);
                }
            }
            for (own, step) in coefficients.iter_mut().zip(solve(&factor, &gradient)) {
                add(own, &step);
            }
        }
        (coefficients, factor)
    }
}

/// Steps of iterative refinement with residuals taken from the samples themselves.
const REFINEMENTS: usize = 1;

fn solve(factor: &BlockFactor, right: &Coefficients) -> Coefficients {
    let mut columns: Vec<Mat<f64>> = right
        .iter()
        .map(|part| Mat::from_fn(part.len(), 1, |i, _| part[i]))
        .collect();
    factor.solve(&mut columns);
    columns
        .iter()
        .map(|column| column.col_as_slice(0).to_vec())
        .collect()
}

fn transposed_product(design: &[f64], rows: usize, vector: &[f64]) -> Vec<f64> {
    design
        .chunks_exact(rows)
        .map(|column| column.iter().zip(vector).map(|(a, b)| a * b).sum())
        .collect()
}

fn add(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += from;
    }
}
