//! The joint fit of all cells: weighted least squares on the blended radius itself.
//!
//! With shares s_i, expansions f_i and quadrature weights q at the samples, it makes
//!
//! ```text
//! sum of q (sum of s_i f_i - r)^2  +  own * sum of q s_i (f_i - r)^2
//! ```
//!
//! least. The second sum keeps each expansion near the target where it counts at all: without it
//! neighbours cancel each other's errors, which normals and curvature show. Its matrix is block diagonal.
//!
//! The normal equations are formed in the cap bases, factored by blocks, and refined with residuals
//! taken from the samples: their condition is the square of the design's (1e5 at worst), and a step of
//! refinement gains the digits that this loses.

use super::nodes::Samples;
use crate::fit::linear::{BlockFactor, BlockMatrix};
use crate::sphere::{CapBasis, Cover, Places, coefficient_count};
use crate::vectorize::vectorize;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatRef, Par};
use rayon::prelude::*;

/// Steps of iterative refinement: the first leaves 1e-6 of what the equations lost, the second nothing.
const REFINEMENTS: usize = 2;

/// The least-squares problem of a cover with a degree per cell.
pub(super) struct Joint {
    degrees: Vec<usize>,
    starts: Vec<usize>,
    patches: Vec<Patch>,
    own: f64,
}

/// The samples of a quarter of a cell: they touch the same few cells.
struct Patch {
    /// The cells they touch.
    cells: Vec<u16>,
    weights: Vec<f64>,
    radii: Vec<f64>,
    /// Share of each cell in the surface at each sample: one column per cell.
    shares: Vec<f64>,
    /// Values of the bases at the samples: columns by cell and degree.
    values: Vec<f64>,
}

/// What a fit leaves.
pub(super) struct Solved {
    pub(super) coefficients: Vec<Vec<f64>>,
    /// Integral of the weighted squared error of the blend.
    pub(super) squared: f64,
}

impl Joint {
    pub(super) fn new(
        cover: &Cover,
        degrees: &[usize],
        bases: &[CapBasis],
        samples: &[&Samples],
        own: f64,
    ) -> Self {
        let mut starts = vec![0];
        for &degree in degrees {
            starts.push(starts[starts.len() - 1] + coefficient_count(degree));
        }
        let patches = (0..4 * samples.len())
            .into_par_iter()
            .with_min_len(32)
            .map(|number| {
                let (home, quarter) = (number / 4, number % 4);
                let mut patch = Patch::new(cover, quarter, samples[home]);
                patch.evaluate(cover, degrees, bases);
                patch
            })
            .collect();
        Self {
            degrees: degrees.to_vec(),
            starts,
            patches,
            own,
        }
    }

    /// The coefficients, by normal equations and refinement.
    /// `None` if the samples are not finite or their weights not above zero.
    pub(super) fn solve(&self) -> Option<Solved> {
        let total = self.starts[self.degrees.len()];
        let mut coefficients = vec![0.0; total];
        let factor = self.factor()?;
        let mut pass = self.pass(&coefficients);
        for _ in 0..=REFINEMENTS {
            let mut columns: Vec<Mat<f64>> = self
                .starts
                .windows(2)
                .map(|ends| {
                    let own = &pass.gradient[ends[0]..ends[1]];
                    Mat::from_fn(own.len(), 1, |i, _| own[i])
                })
                .collect();
            factor.solve(&mut columns);
            for (start, column) in self.starts.iter().zip(&columns) {
                for (own, step) in coefficients[*start..]
                    .iter_mut()
                    .zip(column.col_as_slice(0))
                {
                    *own += step;
                }
            }
            pass = self.pass(&coefficients);
        }
        pass.squared.is_finite().then_some(())?;
        Some(Solved {
            coefficients: self
                .starts
                .windows(2)
                .map(|ends| coefficients[ends[0]..ends[1]].to_vec())
                .collect(),
            squared: pass.squared,
        })
    }

    fn count(&self, cell: u16) -> usize {
        coefficient_count(self.degrees[usize::from(cell)])
    }

    fn factor(&self) -> Option<BlockFactor> {
        let products: Vec<Mat<f64>> = self
            .patches
            .par_iter()
            .with_min_len(16)
            .map(|patch| self.product(patch))
            .collect();
        let sizes = self.degrees.iter().map(|&d| coefficient_count(d)).collect();
        let mut matrix = BlockMatrix::new(sizes);
        for (patch, product) in self.patches.iter().zip(&products) {
            let mut row = 0;
            for &i in &patch.cells {
                let height = self.count(i);
                let mut column = 0;
                for &j in patch.cells.iter().take_while(|&&j| j <= i) {
                    let width = self.count(j);
                    *matrix.block(i, j) += product.submatrix(row, column, height, width);
                    column += width;
                }
                row += height;
            }
        }
        // Rounding of the products: what lies below it is refined, or has no effect.
        for cell in 0..self.degrees.len() as u16 {
            let block = matrix.block(cell, cell);
            for j in 0..block.nrows() {
                block[(j, j)] *= 1.0 + 1e-13;
            }
        }
        matrix.factor()
    }

    /// The matrix of a patch's samples, lower part.
    fn product(&self, patch: &Patch) -> Mat<f64> {
        let rows = patch.weights.len();
        let columns = patch.values.len() / rows;
        let mut design = patch.values.clone();
        let mut own = Mat::<f64>::zeros(columns, columns);
        let mut start = 0;
        for (at, &cell) in patch.cells.iter().enumerate() {
            let count = self.count(cell);
            let shares = &patch.shares[at * rows..(at + 1) * rows];
            let block = &mut design[start * rows..(start + count) * rows];
            if self.own > 0.0 {
                scale(block, rows, |i| {
                    (self.own * patch.weights[i] * shares[i]).sqrt()
                });
                let a = MatRef::from_column_major_slice(&*block, rows, count);
                multiply(own.as_mut().submatrix_mut(start, start, count, count), a);
                block.copy_from_slice(&patch.values[start * rows..(start + count) * rows]);
            }
            scale(block, rows, |i| shares[i] * patch.weights[i].sqrt());
            start += count;
        }
        let mut product = Mat::<f64>::zeros(columns, columns);
        let a = MatRef::from_column_major_slice(&design, rows, columns);
        multiply(product.as_mut(), a);
        if self.own > 0.0 {
            product += own;
        }
        product
    }

    /// The negative gradient at some coefficients, and the squared error of the blend.
    fn pass(&self, coefficients: &[f64]) -> Pass {
        let parts: Vec<(Vec<f64>, f64)> = self
            .patches
            .par_iter()
            .with_min_len(32)
            .map(|patch| self.patch_pass(patch, coefficients))
            .collect();
        let mut pass = Pass {
            gradient: vec![0.0; coefficients.len()],
            squared: 0.0,
        };
        for (patch, (gradient, error)) in self.patches.iter().zip(parts) {
            pass.squared += error;
            let mut rest = gradient.as_slice();
            for &cell in &patch.cells {
                let (own, others) = rest.split_at(self.count(cell));
                let start = self.starts[usize::from(cell)];
                for (sum, value) in pass.gradient[start..].iter_mut().zip(own) {
                    *sum += value;
                }
                rest = others;
            }
        }
        pass
    }

    fn patch_pass(&self, patch: &Patch, coefficients: &[f64]) -> (Vec<f64>, f64) {
        let rows = patch.weights.len();
        let mut lacking = vec![0.0; rows * patch.cells.len()];
        let mut blend = patch.radii.clone();
        let mut values = patch.values.chunks_exact(rows);
        for (at, &cell) in patch.cells.iter().enumerate() {
            let own = &mut lacking[at * rows..(at + 1) * rows];
            own.copy_from_slice(&patch.radii);
            let start = self.starts[usize::from(cell)];
            let expansion = &coefficients[start..start + self.count(cell)];
            for (c, column) in expansion.iter().zip(&mut values) {
                for (own, value) in own.iter_mut().zip(column) {
                    *own -= c * value;
                }
            }
        }
        // r - sum of s f = sum of s (r - f), for shares add up to 1.
        blend.fill(0.0);
        for (own, shares) in lacking
            .chunks_exact(rows)
            .zip(patch.shares.chunks_exact(rows))
        {
            for i in 0..rows {
                blend[i] += shares[i] * own[i];
            }
        }
        let error = (0..rows)
            .map(|i| patch.weights[i] * blend[i] * blend[i])
            .sum();
        let mut gradient = Vec::with_capacity(patch.values.len() / rows);
        let mut values = patch.values.chunks_exact(rows);
        for (at, &cell) in patch.cells.iter().enumerate() {
            let own = &mut lacking[at * rows..(at + 1) * rows];
            let shares = &patch.shares[at * rows..(at + 1) * rows];
            for i in 0..rows {
                own[i] = patch.weights[i] * shares[i] * (blend[i] + self.own * own[i]);
            }
            for column in values.by_ref().take(self.count(cell)) {
                gradient.push(column.iter().zip(&*own).map(|(a, b)| a * b).sum());
            }
        }
        (gradient, error)
    }
}

/// What one pass over all samples gives.
struct Pass {
    gradient: Vec<f64>,
    squared: f64,
}

impl Patch {
    fn new(cover: &Cover, quarter: usize, samples: &Samples) -> Self {
        let (side, half) = (samples.side, samples.side / 2);
        let [first_row, first_column] = [quarter / 2 * half, quarter % 2 * half];
        let numbers: Vec<usize> = (0..half * half)
            .map(|i| (first_row + i / half) * side + first_column + i % half)
            .collect();
        let rows = numbers.len();
        let (mut cells, mut shares): (Vec<u16>, Vec<f64>) = (Vec::new(), Vec::new());
        let mut touched = Vec::new();
        for (row, &number) in numbers.iter().enumerate() {
            cover.shares(&samples.directions[number], &mut touched);
            for &(cell, share) in &touched {
                let at = cells
                    .iter()
                    .position(|&own| own == cell)
                    .unwrap_or_else(|| {
                        cells.push(cell);
                        shares.resize(cells.len() * rows, 0.0);
                        cells.len() - 1
                    });
                shares[at * rows + row] = share;
            }
        }
        let mut order: Vec<usize> = (0..cells.len()).collect();
        order.sort_unstable_by_key(|&at| cells[at]);
        Self {
            cells: order.iter().map(|&at| cells[at]).collect(),
            weights: numbers.iter().map(|&i| samples.weights[i]).collect(),
            radii: numbers.iter().map(|&i| samples.radii[i]).collect(),
            shares: order
                .iter()
                .flat_map(|&at| &shares[at * rows..(at + 1) * rows])
                .copied()
                .collect(),
            values: numbers
                .iter()
                .flat_map(|&i| samples.directions[i].iter().copied())
                .collect(),
        }
    }

    /// Evaluates the bases at the samples (whose directions stand in the place of the values).
    fn evaluate(&mut self, cover: &Cover, degrees: &[usize], bases: &[CapBasis]) {
        let rows = self.weights.len();
        let directions: Vec<[f64; 4]> = self
            .values
            .chunks_exact(3)
            .map(|n| [n[0], n[1], n[2], 0.0])
            .collect();
        let degree = |&cell: &u16| degrees[usize::from(cell)];
        let columns: usize = self
            .cells
            .iter()
            .map(|c| coefficient_count(degree(c)))
            .sum();
        self.values.resize(columns * rows, 0.0);
        let (mut places, mut start) = (Places::default(), 0);
        for cell in &self.cells {
            cover
                .cap(usize::from(*cell))
                .locate(&directions, &mut places);
            bases[degree(cell)].evaluate(&places, &mut self.values[start * rows..], rows);
            start += coefficient_count(degree(cell));
        }
    }
}

fn scale(block: &mut [f64], rows: usize, factor: impl Fn(usize) -> f64) {
    let factors: Vec<f64> = (0..rows).map(factor).collect();
    vectorize(
        #[inline(always)]
        || {
            for column in block.chunks_exact_mut(rows) {
                for (value, factor) in column.iter_mut().zip(&factors) {
                    *value *= factor;
                }
            }
        },
    );
}

/// The lower part of the product of a matrix' transpose with it.
fn multiply(to: faer::MatMut<'_, f64>, a: MatRef<'_, f64>) {
    triangular::matmul(
        to,
        BlockStructure::TriangularLower,
        Accum::Replace,
        a.transpose(),
        BlockStructure::Rectangular,
        a,
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
}
