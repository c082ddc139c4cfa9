//! One orthogonal factorization per segment that serves every degree.
//!
//! The columns of the design matrix are ordered by degree, so the leading (d+1)^2 columns of
//! B = Q R are the fit of degree d: its coefficients solve the leading triangle of R, and its
//! residual is the tail of Q^T r. Rows come in blocks (samples of a segment, or the reduced rows of
//! whole cells): each block is factored together with the triangle of those before it, so the cost
//! is linear and the memory constant in the number of rows. Householder reflections throughout;
//! never the normal equations.

use super::householder::{WIDE, padded, triangularise};
use crate::fit::prepare::Sample;
use crate::sphere::{Cap, CapBasis, Places, coefficient_count};
use crate::vectorize::vectorize;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{MatMut, MatRef, Par};
use std::ops::Range;

/// Rows factored at once: with 17 columns they fit in the nearest cache.
const BLOCK_ROWS: usize = 192;

/// A column whose new direction is shorter than this, relative to the column, counts as dependent
/// on those before it. The cap basis itself stays above 1e-4 on a well sampled segment, rounding
/// makes 1e-15; degenerate samplings (points on a few rings) fall in between and are decided by the
/// leverage of the segment's corners.
const RANK_TOLERANCE: f64 = 1e-9;

/// Samples beyond the coefficients that a variance needs.
const LEAST_SPARE_SAMPLES: usize = 8;

/// A growing factorization [B | r] = Q R; column-major, `rows` of a fixed stride in use.
pub(crate) struct Factorization {
    columns: usize,
    matrix: Vec<f64>,
    used: usize,
    stride: usize,
    reflector: Vec<f64>,
    places: Places,
}

impl Factorization {
    /// Room for expansions up to `degree`.
    pub(crate) fn new(degree: usize) -> Self {
        let columns = coefficient_count(degree) + 1;
        // Of a wide matrix, enough rows that the triangle carried along is a small part.
        let stride = padded(columns + BLOCK_ROWS.max(4 * columns));
        Self {
            columns,
            matrix: vec![0.0; stride * columns],
            used: 0,
            stride,
            reflector: Vec::new(),
            places: Places::default(),
        }
    }

    /// Forgets all rows.
    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }

    /// Rows that can be appended at once.
    pub(crate) fn most_rows(&self) -> usize {
        self.stride - self.columns
    }

    /// Space for `rows` more rows, at most [`Self::most_rows`]: a column-major matrix of the returned
    /// stride whose last column is the radius. Factors what is there first if it has to.
    pub(crate) fn append(&mut self, rows: usize) -> (&mut [f64], usize) {
        if self.stride - self.used < rows {
            self.compress();
        }
        let start = self.used;
        self.used += rows;
        (&mut self.matrix[start..], self.stride)
    }

    /// Adds samples of the radius, with the functions of `basis` on `cap` as columns.
    pub(crate) fn add_samples(&mut self, basis: &CapBasis, cap: &Cap, samples: &[Sample]) {
        let mut places = std::mem::take(&mut self.places);
        self.add_blocks(samples, |block, design, stride| {
            cap.locate(&samples[block], &mut places);
            basis.evaluate(&places, design, stride);
        });
        self.places = places;
    }

    /// Adds samples at which the basis has been evaluated: one column of `values` per function.
    pub(crate) fn add_evaluated(&mut self, values: &[f64], samples: &[Sample]) {
        self.add_blocks(samples, |block, design, stride| {
            for (column, from) in values.chunks(samples.len()).enumerate() {
                design[column * stride..][..block.len()].copy_from_slice(&from[block.clone()]);
            }
        });
    }

    /// Adds samples as many at a time as there is room for; `evaluate` writes the functions at the
    /// samples of a block into the columns of a matrix of the given stride.
    fn add_blocks(
        &mut self,
        samples: &[Sample],
        mut evaluate: impl FnMut(Range<usize>, &mut [f64], usize),
    ) {
        let functions = self.columns - 1;
        let mut done = 0;
        while done < samples.len() {
            if self.used == self.stride {
                self.compress();
            }
            let room = self.stride - self.used;
            let block = done..samples.len().min(done + room);
            let (matrix, stride) = self.append(block.len());
            let (design, radius) = matrix.split_at_mut(functions * stride);
            evaluate(block.clone(), design, stride);
            for (out, sample) in radius.iter_mut().zip(&samples[block.clone()]) {
                *out = sample[3];
            }
            done = block.end;
        }
    }

    /// Replaces the rows by their triangle.
    fn compress(&mut self) {
        if self.used == 0 {
            return;
        }
        triangularise(
            &mut self.matrix,
            self.used,
            self.columns,
            self.stride,
            &mut self.reflector,
        );
        self.used = self.used.min(self.columns);
    }

    /// The triangle R of [B | r], after the last rows have been factored in.
    pub(crate) fn triangle(&mut self) -> Triangle<'_> {
        self.compress();
        Triangle {
            columns: self.columns,
            rows: self.used,
            stride: self.stride,
            matrix: &self.matrix,
        }
    }
}

/// The upper triangle R of a factored [B | r].
#[derive(Clone, Copy)]
pub(crate) struct Triangle<'a> {
    columns: usize,
    rows: usize,
    stride: usize,
    matrix: &'a [f64],
}

impl Triangle<'_> {
    /// Entry of R; 0 below the rows that the data gave.
    pub(crate) fn at(&self, row: usize, column: usize) -> f64 {
        if row < self.rows {
            self.matrix[column * self.stride + row]
        } else {
            0.0
        }
    }

    /// Rows of R: the number of columns, or of samples where those are fewer.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// The part of Q^T r that belongs to function `row`.
    pub(crate) fn projection(&self, row: usize) -> f64 {
        self.at(row, self.columns - 1)
    }

    /// Variance of the `samples` factored round the fit of the given degree, if enough of them are
    /// left beyond the coefficients to tell.
    pub(crate) fn residual_variance(&self, degree: usize, samples: usize) -> Option<f64> {
        let spare = samples.checked_sub(coefficient_count(degree))?;
        let squared: f64 = (coefficient_count(degree)..self.rows)
            .map(|row| self.projection(row).powi(2))
            .sum();
        (spare >= LEAST_SPARE_SAMPLES).then(|| squared / spare as f64)
    }

    /// The largest degree whose columns are independent on the samples, if any.
    pub(crate) fn full_rank_degree(&self) -> Option<usize> {
        let independent = (0..self.columns - 1)
            .take_while(|&j| {
                let column: f64 = (0..=j).map(|i| self.at(i, j).powi(2)).sum();
                self.at(j, j).powi(2) > RANK_TOLERANCE.powi(2) * column
            })
            .count();
        independent.isqrt().checked_sub(1)
    }

    /// Coefficients of the fit of the given degree, which must be of full rank.
    pub(crate) fn solve(&self, degree: usize) -> Vec<f64> {
        let count = coefficient_count(degree);
        let mut x: Vec<f64> = (0..count).map(|row| self.projection(row)).collect();
        for j in (0..count).rev() {
            x[j] /= self.at(j, j);
            let pivot = x[j];
            let column = &self.matrix[j * self.stride..][..j];
            for (x, r) in x[..j].iter_mut().zip(column) {
                *x -= r * pivot;
            }
        }
        x
    }

    /// Replaces the basis values b of many samples (columns of `b`, `rows` long) by z = R^-T b, for
    /// the first `count` functions: the squared sum of the first (d+1)^2 entries is the leverage of
    /// a sample in the fit of degree d.
    pub(crate) fn whiten(&self, b: &mut [f64], rows: usize, count: usize) {
        if count > WIDE {
            return self.whiten_by_library(b, rows, count);
        }
        vectorize(
            #[inline(always)]
            || {
                for j in 0..count {
                    let (known, rest) = b.split_at_mut(j * rows);
                    let column = &mut rest[..rows];
                    let z = |i: usize| &known[i * rows..][..rows];
                    let mut i = 0;
                    // Four at a time: the column is loaded and stored a quarter as often.
                    while i + 4 <= j {
                        let factors: [f64; 4] = std::array::from_fn(|step| self.at(i + step, j));
                        let [z0, z1, z2, z3] = [z(i), z(i + 1), z(i + 2), z(i + 3)];
                        for row in 0..rows {
                            column[row] -= (factors[0] * z0[row] + factors[1] * z1[row])
                                + (factors[2] * z2[row] + factors[3] * z3[row]);
                        }
                        i += 4;
                    }
                    for i in i..j {
                        let factor = self.at(i, j);
                        for (b, z) in column.iter_mut().zip(z(i)) {
                            *b -= factor * z;
                        }
                    }
                    let per_pivot = 1.0 / self.at(j, j);
                    for b in column {
                        *b *= per_pivot;
                    }
                }
            },
        );
    }

    fn whiten_by_library(&self, b: &mut [f64], rows: usize, count: usize) {
        let b = MatMut::from_column_major_slice_mut(&mut b[..rows * count], rows, count);
        let triangle =
            MatRef::from_column_major_slice_with_stride(self.matrix, count, count, self.stride);
        solve_lower_triangular_in_place(triangle.transpose(), b.transpose_mut(), Par::Seq);
    }
}
