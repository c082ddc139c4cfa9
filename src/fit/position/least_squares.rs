//! Weighted least squares of three coordinates at once.
//!
//! What is made least is the sum over samples of e.T e, with e the target less the surface's point and T a symmetric
//! matrix: large along the normal of the scan, small across it. T ties the coordinates together, so that a cell has
//! three unknowns per function: x of all functions, then y, then z. The normal equations are formed in the cap bases, and
//! solved twice: the second time for what is left at the samples, which gains the digits that the first has lost.

use super::functions::{Functions, Rows};
use crate::fit::linear::{BlockFactor, BlockMatrix};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Scale};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Solutions of the equations, each for what the ones before have left.
const PASSES: usize = 2;

/// What the diagonal is raised by, relative: below it lies rounding.
const RIDGE: f64 = 1e-11;

/// What a row of a design matrix is asked to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Term {
    pub(super) target: Vector3<f64>,
    pub(super) weight: Matrix3<f64>,
}

/// What keeps functions smooth: rows whose squares add up to the roughness of a coordinate, and their products.
pub(super) struct Roughness {
    rows: Vec<Rows>,
    products: BlockMatrix,
}

impl Roughness {
    pub(super) fn new(functions: &Functions) -> Self {
        let rows = functions.roughness();
        let mut products = BlockMatrix::new(vec![functions.per_cell(); functions.cell_count()]);
        for rows in &rows {
            add_products(&mut products, [0, 0], rows, &rows.values);
        }
        Self { rows, products }
    }
}

/// Rows, what is asked of each of their members, and how much the roughness weighs beside it.
pub(super) struct Equations<'a> {
    pub(super) rows: &'a [Rows],
    /// By number of the member.
    pub(super) terms: &'a [Term],
    pub(super) roughness: (&'a Roughness, f64),
}

impl Equations<'_> {
    /// The factored matrix; `None` if nothing determines the coefficients.
    fn factored(&self, functions: &Functions) -> Option<BlockFactor> {
        let size = functions.per_cell();
        let mut matrix = BlockMatrix::new(vec![3 * size; functions.cell_count()]);
        for rows in self.rows {
            for [i, j] in PAIRS {
                let weight = |member: u32| self.terms[member as usize].weight[(i, j)];
                add_products(&mut matrix, [i, j], rows, &rows.times(weight));
            }
        }
        let (roughness, weight) = self.roughness;
        for (&(one, other), product) in &roughness.products.blocks {
            let block = matrix.block(one, other);
            for start in [0, size, 2 * size] {
                let mut part = block.submatrix_mut(start, start, size, size);
                part += Scale(weight) * product;
            }
        }
        for block in matrix.blocks.values_mut() {
            for [i, j] in PAIRS.into_iter().filter(|[i, j]| i != j) {
                let product = block.submatrix(i * size, j * size, size, size).to_owned();
                block
                    .submatrix_mut(j * size, i * size, size, size)
                    .copy_from(product);
            }
        }
        let trace: f64 = (0..functions.cell_count() as u16)
            .map(|cell| matrix.block(cell, cell).diagonal().column_vector().sum())
            .sum();
        let ridge = RIDGE * trace / (3 * functions.count()) as f64;
        for cell in 0..functions.cell_count() as u16 {
            let block = matrix.block(cell, cell);
            for at in 0..block.nrows() {
                block[(at, at)] += ridge;
            }
        }
        matrix.factor()
    }

    /// The coefficients of least squares, per cell, and the factored matrix; `None` if nothing determines them.
    pub(super) fn solve(&self, functions: &Functions) -> Option<(Vec<Vec<f64>>, BlockFactor)> {
        let factor = self.factored(functions)?;
        let mut coefficients = vec![vec![0.0; 3 * functions.per_cell()]; functions.cell_count()];
        for _ in 0..PASSES {
            let mut steps = no_sums(functions, 1);
            let of_cell = |cell: u16| coefficients[usize::from(cell)].as_slice();
            let left = |rows: &Rows| {
                let fitted = values(rows, of_cell).into_iter().zip(&rows.members);
                let left = fitted.map(|(fitted, member)| {
                    let Term { target, weight } = &self.terms[*member as usize];
                    weight * (target - fitted)
                });
                left.collect()
            };
            let left: Vec<Vec<Vector3<f64>>> = self.rows.par_iter().map(left).collect();
            for (rows, left) in self.rows.iter().zip(left) {
                add_adjoint(&mut steps, 0, rows, &left);
            }
            let (roughness, weight) = self.roughness;
            for rows in &roughness.rows {
                let rough = values(rows, of_cell).into_iter();
                let left: Vec<_> = rough.map(|value| value * -weight).collect();
                add_adjoint(&mut steps, 0, rows, &left);
            }
            factor.solve(&mut steps);
            for (own, step) in coefficients.iter_mut().zip(&steps) {
                own.iter_mut()
                    .zip(step.col_as_slice(0))
                    .for_each(|(c, step)| *c += step);
            }
        }
        let is_finite = coefficients.iter().flatten().all(|c| c.is_finite());
        is_finite.then_some((coefficients, factor))
    }
}

/// Zeros for each coefficient, cell by cell, in so many columns.
pub(super) fn no_sums(functions: &Functions, columns: usize) -> Vec<Mat<f64>> {
    vec![Mat::zeros(3 * functions.per_cell(), columns); functions.cell_count()]
}

/// The pairs of coordinates, each once.
const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

/// Adds B^T W B, with W B `weighted`, to the parts for two coordinates of the blocks of all pairs of cells.
fn add_products(matrix: &mut BlockMatrix, [i, j]: [usize; 2], rows: &Rows, weighted: &[f64]) {
    let (height, size) = (rows.members.len(), rows.per_cell());
    let [of_cell, weighted] = [rows.values.as_slice(), weighted].map(|values| {
        let cells = values.chunks_exact(height * size);
        let columns = cells.map(|own| MatRef::from_column_major_slice(own, height, size));
        columns.collect::<Vec<MatRef<'_, f64>>>()
    });
    for (at, &one) in rows.cells.iter().enumerate() {
        for (other_at, &other) in rows.cells[..=at].iter().enumerate() {
            let block = matrix.block(one, other);
            matmul(
                block.submatrix_mut(i * size, j * size, size, size),
                Accum::Add,
                of_cell[at].transpose(),
                weighted[other_at],
                1.0,
                Par::Seq,
            );
        }
    }
}

/// B c, of each of some rows, with the coefficients of each cell.
pub(super) fn values<'a>(rows: &Rows, of_cell: impl Fn(u16) -> &'a [f64]) -> Vec<Vector3<f64>> {
    let mut found = vec![Vector3::zeros(); rows.members.len()];
    let size = rows.per_cell();
    for (at, column) in rows.values.chunks_exact(found.len()).enumerate() {
        let (own, function) = (of_cell(rows.cells[at / size]), at % size);
        let triple = Vector3::from_fn(|i, _| own[i * size + function]);
        for (found, value) in found.iter_mut().zip(column) {
            *found += triple * *value;
        }
    }
    found
}

/// Adds B^T v to a column of sums, v having an entry for each of some rows.
pub(super) fn add_adjoint(sums: &mut [Mat<f64>], column: usize, rows: &Rows, v: &[Vector3<f64>]) {
    let size = rows.per_cell();
    for (at, values) in rows.values.chunks_exact(v.len()).enumerate() {
        let sum: Vector3<f64> = values.iter().zip(v).map(|(value, v)| v * *value).sum();
        let (cell, function) = (usize::from(rows.cells[at / size]), at % size);
        let own = sums[cell].col_as_slice_mut(column);
        (0..3).for_each(|i| own[i * size + function] += sum[i]);
    }
}
