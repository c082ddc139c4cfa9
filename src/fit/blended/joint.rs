//! The joint fit of all cells: weighted least squares on the blended radius itself.
//!
//! With shares s_i, expansions f_i and quadrature weights q at the samples, it makes
//!
//! ```text
//! sum of q (sum of s_i f_i - r)^2  +  own * sum of q s_i^(1/4) (f_i - r)^2
//! ```
//!
//! least. The second sum keeps each expansion near the target where it counts at all: without it
//! neighbours cancel each other's errors, which normals and curvature show. The root is taken because a share bends most where
//! it is small: there a difference between neighbours counts little in the radius, but fully in the curvature. Its matrix is
//! block diagonal.
//!
//! The normal equations are formed in the cap bases, factored by blocks, and refined with residuals
//! taken from the samples: their condition is the square of the design's (1e5 at worst), and a step of
//! refinement gains the digits that this loses.

use super::nodes::Samples;
use super::patch::Patch;
use crate::fit::linear::{BlockFactor, BlockMatrix};
use crate::sphere::{CapBasis, Cover, coefficient_count};
use crate::vectorize::{dot, vectorize};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatMut, MatRef, Par};
use rayon::prelude::*;

/// Most steps of iterative refinement: the first leaves 1e-6 of what the equations lost, the second nothing.
const REFINEMENTS: usize = 2;

/// After a step that changes the coefficients by less than this share of them, the next one would by less than its square.
const SMALL_STEP: f64 = 1e-5;

/// Patches per thread whose products are held at once: those of all would take hundreds of megabytes, and few stay in the
/// processor's own memory.
const PATCHES_AT_ONCE: usize = 16;

/// The least-squares problem of a cover with a degree per cell.
pub(super) struct Joint {
    degrees: Vec<usize>,
    starts: Vec<usize>,
    patches: Vec<Patch>,
    own: f64,
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
                Patch::new(cover, quarter, samples[home], degrees, bases)
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
            let ends = self.starts.windows(2);
            let mut columns: Vec<Mat<f64>> = ends
                .map(|ends| {
                    let own = &pass.gradient[ends[0]..ends[1]];
                    Mat::from_fn(own.len(), 1, |i, _| own[i])
                })
                .collect();
            factor.solve(&mut columns);
            let steps = columns.iter().flat_map(|column| column.col_as_slice(0));
            let (mut change, mut size) = (0.0, 0.0);
            for (own, step) in coefficients.iter_mut().zip(steps) {
                *own += step;
                change += step * step;
                size += *own * *own;
            }
            pass = self.pass(&coefficients);
            if change < SMALL_STEP * SMALL_STEP * size {
                break;
            }
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
        let sizes = self.degrees.iter().map(|&d| coefficient_count(d)).collect();
        let mut matrix = BlockMatrix::new(sizes);
        let at_once = PATCHES_AT_ONCE * rayon::current_num_threads();
        for patches in self.patches.chunks(at_once) {
            let products = patches.par_iter().with_min_len(8);
            let products: Vec<Mat<f64>> = products.map(|patch| self.product(patch)).collect();
            for (patch, product) in patches.iter().zip(&products) {
                let mut row = 0;
                for &i in &patch.cells {
                    let rows = row..row + self.count(i);
                    let mut column = 0;
                    for &j in patch.cells.iter().take_while(|&&j| j <= i) {
                        let block = matrix.block(i, j);
                        for k in 0..block.ncols() {
                            let own = &product.col_as_slice(column)[rows.clone()];
                            let sums = block.col_as_slice_mut(k).iter_mut().zip(own);
                            sums.for_each(|(sum, own)| *sum += own);
                            column += 1;
                        }
                    }
                    row = rows.end;
                }
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
        let mut product = Mat::<f64>::zeros(columns, columns);
        let mut design = vec![0.0; patch.values.len()];
        self.scale(patch, &mut design, |weight, share| share * weight.sqrt());
        let all = MatRef::from_column_major_slice(&design, rows, columns);
        multiply(product.as_mut(), Accum::Replace, all);
        if self.own > 0.0 {
            self.scale(patch, &mut design, |weight, share| {
                (self.own * weight * counted(share)).sqrt()
            });
            let all = MatRef::from_column_major_slice(&design, rows, columns);
            let mut start = 0;
            for &cell in &patch.cells {
                let count = self.count(cell);
                let block = product.submatrix_mut(start, start, count, count);
                multiply(block, Accum::Add, all.subcols(start, count));
                start += count;
            }
        }
        product
    }

    /// The values of the bases times a factor by the weight of the sample and the share of the cell.
    fn scale(&self, patch: &Patch, design: &mut [f64], factor: impl Fn(f64, f64) -> f64) {
        let rows = patch.weights.len();
        let values = patch.values.chunks_exact(rows);
        let mut columns = design.chunks_exact_mut(rows).zip(values);
        for (&cell, shares) in patch.cells.iter().zip(patch.shares.chunks_exact(rows)) {
            let factors = patch.weights.iter().zip(shares);
            let factors: Vec<f64> = factors
                .map(|(&weight, &share)| factor(weight, share))
                .collect();
            vectorize(
                #[inline(always)]
                || {
                    for (scaled, values) in columns.by_ref().take(self.count(cell)) {
                        for ((scaled, value), factor) in scaled.iter_mut().zip(values).zip(&factors)
                        {
                            *scaled = value * factor;
                        }
                    }
                },
            );
        }
    }

    /// The negative gradient at some coefficients, and the squared error of the blend.
    fn pass(&self, coefficients: &[f64]) -> Pass {
        let parts: Vec<(Vec<f64>, f64)> = self
            .patches
            .par_iter()
            .with_min_len(32)
            .map(|patch| {
                vectorize(
                    #[inline(always)]
                    || self.patch_pass(patch, coefficients),
                )
            })
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

    #[inline(always)]
    fn patch_pass(&self, patch: &Patch, coefficients: &[f64]) -> (Vec<f64>, f64) {
        let rows = patch.weights.len();
        let mut lacking = vec![0.0; rows * patch.cells.len()];
        let mut blend = vec![0.0; rows];
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
                own[i] = patch.weights[i]
                    * (shares[i] * blend[i] + self.own * counted(shares[i]) * own[i]);
            }
            for column in values.by_ref().take(self.count(cell)) {
                gradient.push(dot(column, own));
            }
        }
        (gradient, error)
    }
}

/// How much the own error of an expansion counts where it has a share.
#[inline(always)]
pub(super) fn counted(share: f64) -> f64 {
    share.sqrt().sqrt()
}

/// What one pass over all samples gives.
struct Pass {
    gradient: Vec<f64>,
    squared: f64,
}

/// The lower part of the product of a matrix' transpose with it.
fn multiply(to: MatMut<'_, f64>, sum: Accum, a: MatRef<'_, f64>) {
    triangular::matmul(
        to,
        BlockStructure::TriangularLower,
        sum,
        a.transpose(),
        BlockStructure::Rectangular,
        a,
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
}
