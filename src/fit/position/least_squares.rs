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
use std::collections::BTreeMap;

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
    products: Products,
}

impl Roughness {
    pub(super) fn new(functions: &Functions) -> Self {
        let rows = functions.roughness();
        let mut products = Products::default();
        for rows in &rows {
            products.add(rows, |_| [1.0]);
        }
        Self { rows, products }
    }
}

/// Rows, and what is asked of each of their members. Their products are formed once, for any weight of the roughness.
pub(super) struct Equations<'a> {
    functions: &'a Functions,
    rows: &'a [Rows],
    /// By number of the member.
    terms: Vec<Term>,
    products: Products,
}

impl<'a> Equations<'a> {
    pub(super) fn new(functions: &'a Functions, rows: &'a [Rows], terms: Vec<Term>) -> Self {
        let mut products = Products::default();
        for rows in rows {
            products.add(rows, |member| {
                PAIRS.map(|at| terms[member as usize].weight[at])
            });
        }
        Self {
            functions,
            rows,
            terms,
            products,
        }
    }

    /// The factored matrix, with the roughness at a weight; `None` if nothing determines the coefficients.
    fn factored(&self, roughness: &Roughness, weight: f64) -> Option<BlockFactor> {
        let size = self.functions.per_cell();
        let cells = self.functions.cell_count() as u16;
        let mut matrix = BlockMatrix::new(vec![3 * size; cells.into()]);
        for (&(one, other), products) in &self.products.0 {
            let block = matrix.block(one, other);
            for (at, (i, j)) in PAIRS.into_iter().enumerate() {
                let product = products.subcols(at * size, size);
                for (i, j) in [(i, j), (j, i)] {
                    let mut part = block.submatrix_mut(i * size, j * size, size, size);
                    part.copy_from(product);
                }
            }
        }
        for (&(one, other), product) in &roughness.products.0 {
            let block = matrix.block(one, other);
            for start in [0, size, 2 * size] {
                let mut part = block.submatrix_mut(start, start, size, size);
                part += Scale(weight) * product;
            }
        }
        let trace: f64 = (0..cells)
            .map(|cell| matrix.block(cell, cell).diagonal().column_vector().sum())
            .sum();
        let ridge = RIDGE * trace / (3 * self.functions.count()) as f64;
        for cell in 0..cells {
            let block = matrix.block(cell, cell);
            for at in 0..block.nrows() {
                block[(at, at)] += ridge;
            }
        }
        matrix.factor()
    }

    /// The coefficients of least squares, per cell, with the roughness at a weight, and the factored matrix; `None` if
    /// nothing determines them.
    pub(super) fn solve(
        &self,
        roughness: &Roughness,
        weight: f64,
    ) -> Option<(Vec<Vec<f64>>, BlockFactor)> {
        let functions = self.functions;
        let factor = self.factored(roughness, weight)?;
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
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Sums of B^T W B over rows, for all pairs of cells, the later one first: side by side those of several weights W.
#[derive(Default)]
struct Products(BTreeMap<(u16, u16), Mat<f64>>);

impl Products {
    /// Adds those of some rows, with the weights of each member.
    fn add<const N: usize>(&mut self, rows: &Rows, weights: impl Fn(u32) -> [f64; N]) {
        let (height, size) = (rows.members.len(), rows.per_cell());
        let weights: Vec<[f64; N]> = rows.members.iter().map(|&member| weights(member)).collect();
        let of_cells = || rows.values.chunks_exact(height * size);
        let mut weighted = Vec::with_capacity(N * height * size);
        for (at, (other, values)) in rows.cells.iter().zip(of_cells()).enumerate() {
            weighted.clear();
            for which in 0..N {
                for column in values.chunks_exact(height) {
                    let pairs = column.iter().zip(&weights);
                    weighted.extend(pairs.map(|(value, weights)| value * weights[which]));
                }
            }
            let right = MatRef::from_column_major_slice(&weighted, height, N * size);
            for (one, values) in rows.cells.iter().zip(of_cells()).skip(at) {
                let sums = self.0.entry((*one, *other));
                matmul(
                    sums.or_insert_with(|| Mat::zeros(size, N * size)),
                    Accum::Add,
                    MatRef::from_column_major_slice(values, height, size).transpose(),
                    right,
                    1.0,
                    Par::Seq,
                );
            }
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
