//! Weighted least squares of three coordinates at once.
//!
//! What is made least is the sum over samples of e.T e, with e the target less the surface's point and T a symmetric
//! matrix: large along the normal of the scan, small across it. T ties the coordinates together, so that a cell has
//! three unknowns per function. The normal equations are formed in the cap bases, and solved twice: the second time
//! for what is left at the samples, which gains the digits that the first has lost.

use super::functions::{Functions, Rows};
use crate::fit::linear::{BlockFactor, BlockMatrix};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
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

/// Rows and what is asked of each of their members.
pub(super) struct Equations<'a> {
    pub(super) rows: &'a [Rows],
    /// By number of the member.
    pub(super) terms: &'a [Term],
}

/// The factored matrix of the equations; `None` if nothing determines the coefficients.
fn factored(functions: &Functions, equations: &[Equations<'_>]) -> Option<BlockFactor> {
    let per_cell = functions.per_cell();
    let sizes = vec![3 * per_cell; functions.cell_count()];
    let mut matrix = BlockMatrix::new(sizes);
    for part in equations {
        let products: Vec<[Option<Mat<f64>>; 6]> = part
            .rows
            .par_iter()
            .map(|rows| products(rows, part.terms))
            .collect();
        for (rows, products) in part.rows.iter().zip(&products) {
            scatter(&mut matrix, rows, products, per_cell);
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
pub(super) fn solve(
    functions: &Functions,
    equations: &[Equations<'_>],
) -> Option<(Vec<Vec<f64>>, BlockFactor)> {
    let factor = factored(functions, equations)?;
    let mut coefficients = vec![vec![0.0; 3 * functions.per_cell()]; functions.cell_count()];
    for _ in 0..PASSES {
        let mut steps = no_sums(functions, 1);
        for part in equations {
            let left = |rows: &Rows| left(rows, part.terms, &coefficients);
            let left: Vec<Vec<Vector3<f64>>> = part.rows.par_iter().map(left).collect();
            for (rows, left) in part.rows.iter().zip(left) {
                add_adjoint(&mut steps, 0, rows, &left);
            }
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

/// Zeros for each coefficient, cell by cell, in so many columns.
pub(super) fn no_sums(functions: &Functions, columns: usize) -> Vec<Mat<f64>> {
    vec![Mat::zeros(3 * functions.per_cell(), columns); functions.cell_count()]
}

/// The pairs of coordinates, each once.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// B^T diag(T_ij) B for all pairs of coordinates i, j; `None` where T_ij is zero.
fn products(rows: &Rows, terms: &[Term]) -> [Option<Mat<f64>>; 6] {
    let height = rows.members.len();
    let width = rows.values.len() / height;
    let design = MatRef::from_column_major_slice(&rows.values, height, width);
    let mut found: [Option<Mat<f64>>; 6] = [const { None }; 6];
    for (number, (i, j)) in PAIRS.into_iter().enumerate() {
        let weight = |member: &u32| terms[*member as usize].weight[(i, j)];
        let weights: Vec<f64> = rows.members.iter().map(weight).collect();
        if weights.iter().all(|weight| *weight == 0.0) {
            continue;
        }
        let is_isotropic = i == j
            && number > 0
            && rows.members.iter().all(|member| {
                let weight = &terms[*member as usize].weight;
                weight[(i, i)] == weight[(0, 0)]
            });
        if is_isotropic {
            found[number] = found[0].clone();
            continue;
        }
        let mut scaled = rows.values.clone();
        for column in scaled.chunks_exact_mut(height) {
            column
                .iter_mut()
                .zip(&weights)
                .for_each(|(value, weight)| *value *= weight);
        }
        let scaled = MatRef::from_column_major_slice(&scaled, height, width);
        let mut product = Mat::zeros(width, width);
        matmul(
            product.as_mut(),
            Accum::Replace,
            design.transpose(),
            scaled,
            1.0,
            Par::Seq,
        );
        found[number] = Some(product);
    }
    found
}

/// Adds the products to the blocks of their cells.
fn scatter(
    matrix: &mut BlockMatrix,
    rows: &Rows,
    products: &[Option<Mat<f64>>; 6],
    per_cell: usize,
) {
    for (at, &one) in rows.cells.iter().enumerate() {
        for (other_at, &other) in rows.cells[..=at].iter().enumerate() {
            let block = matrix.block(one, other);
            for ((i, j), product) in PAIRS.into_iter().zip(products) {
                let Some(product) = product else { continue };
                let part =
                    product.submatrix(at * per_cell, other_at * per_cell, per_cell, per_cell);
                for g in 0..per_cell {
                    for f in 0..per_cell {
                        let value = part[(f, g)];
                        block[(3 * f + i, 3 * g + j)] += value;
                        if i != j {
                            block[(3 * f + j, 3 * g + i)] += value;
                        }
                    }
                }
            }
        }
    }
}

/// T (target - B c) of each of some rows.
fn left(rows: &Rows, terms: &[Term], coefficients: &[Vec<f64>]) -> Vec<Vector3<f64>> {
    let triples = |cell: u16| coefficients[usize::from(cell)].as_chunks().0;
    let fitted = values(rows, triples).into_iter().zip(&rows.members);
    fitted
        .map(|(fitted, member)| {
            let Term { target, weight } = &terms[*member as usize];
            weight * (target - fitted)
        })
        .collect()
}

/// B c, of each of some rows, with the coefficients of each cell.
pub(super) fn values<'a>(
    rows: &Rows,
    triples: impl Fn(u16) -> &'a [[f64; 3]],
) -> Vec<Vector3<f64>> {
    let mut found = vec![Vector3::zeros(); rows.members.len()];
    let triples = rows.cells.iter().flat_map(|&cell| triples(cell));
    for (column, triple) in rows.values.chunks_exact(found.len()).zip(triples) {
        let triple = Vector3::from(*triple);
        for (found, value) in found.iter_mut().zip(column) {
            *found += triple * *value;
        }
    }
    found
}

/// Adds B^T v to a column of sums, v having an entry for each of some rows.
pub(super) fn add_adjoint(sums: &mut [Mat<f64>], column: usize, rows: &Rows, v: &[Vector3<f64>]) {
    let per_cell = rows.values.len() / (v.len() * rows.cells.len());
    let functions = rows.values.chunks_exact(v.len()).enumerate();
    for (at, values) in functions {
        let sum: Vector3<f64> = values.iter().zip(v).map(|(value, v)| v * *value).sum();
        let (cell, function) = (usize::from(rows.cells[at / per_cell]), at % per_cell);
        let own = &mut sums[cell].col_as_slice_mut(column)[3 * function..][..3];
        own.iter_mut().zip(&sum).for_each(|(own, sum)| *own += sum);
    }
}
