//! Expansions in harmonics at many scattered directions, fast.
//!
//! A direct sum costs N (L+1)^2 products. Here the expansion goes to an equiangular grid on the
//! sphere, doubled to a torus, and is interpolated from there: a fast Fourier transform with
//! non-uniform places.
//!
//! 1. [`polar`]: order by order from coefficients to rings, about 2 L^3 products;
//! 2. [`grid`]: along each ring by a fast Fourier transform; continued beyond the poles;
//! 3. [`places`]: at each direction from WIDTH x WIDTH points of the grid.
//!
//! The waves are divided beforehand by what the [`kernel`] of step 3 lets through. Error, from the kernel's
//! finite width: below 5e-9 of the norm of the coefficients for a WIDTH of 10, below 1e-13 for one of 16. The
//! adjoint takes the same steps in reverse, transposed, and is exact as such to rounding.
//!
//! An [`interpolant`] is evaluated in directions that are asked for once. One after the other the three steps and their
//! adjoints make the matrix Y'WY of weighted directions; [`gram`] applies it faster.

mod azimuth;
mod gauss_grid;
mod gram;
mod grid;
mod interpolant;
mod kept;
mod kernel;
mod oversampled;
mod places;
mod polar;

pub(crate) use gram::{HarmonicGram, LowerTriangle};
use grid::Grid;
pub(crate) use interpolant::Interpolant;
use nalgebra::Vector3;
use places::Places;
use rayon::prelude::*;
use std::sync::Arc;

/// Directions from which on threads share the work.
const MANY: usize = 100_000;
/// Chunks of many directions. Sums are taken chunk by chunk: their number must not depend on the
/// number of threads.
const CHUNKS: usize = 16;

/// The matrix Y of all harmonics of degree <= L in N fixed directions, as an operator.
///
/// Harmonics and their order are those of [`super::harmonics()`]. Results do not depend on the number of
/// threads. Kernels are WIDTH points of the grid wide.
pub(crate) struct Scattered<const WIDTH: usize> {
    grid: Arc<Grid>,
    /// Directions of a chunk, except that the last may have fewer.
    chunk: usize,
    chunks: Vec<Places<WIDTH>>,
}

/// The operator to 5e-9 of the norm of the coefficients.
pub(crate) type ScatteredHarmonics = Scattered<10>;

/// The operator to 1e-13 of the norm of the coefficients.
pub(crate) type AccurateHarmonics = Scattered<16>;

impl<const WIDTH: usize> Scattered<WIDTH> {
    /// The operator of a degree and unit vectors.
    pub(crate) fn new(degree: usize, directions: &[Vector3<f64>]) -> Self {
        let grid = Grid::of_degree(degree, WIDTH);
        let chunk = match directions.len() {
            count if count < MANY => count.max(1),
            count => count.div_ceil(CHUNKS),
        };
        let chunks = directions
            .par_chunks(chunk)
            .map(|directions| Places::new(&grid, directions))
            .collect();
        Self {
            grid,
            chunk,
            chunks,
        }
    }

    /// values\[i\] = the sum over j of coefficients\[j\] Y_j(n_i).
    ///
    /// # Panics
    /// If there are fewer than (L+1)² coefficients or N values.
    pub(crate) fn synthesis(&self, coefficients: &[f64], values: &mut [f64]) {
        let points = self.grid.synthesis(coefficients);
        match &self.chunks[..] {
            [all] => all.interpolate(&points, values),
            chunks => chunks
                .par_iter()
                .zip(values.par_chunks_mut(self.chunk))
                .for_each(|(places, values)| places.interpolate(&points, values)),
        }
    }

    /// coefficients\[j\] = the sum over i of values\[i\] Y_j(n_i): the exact transpose.
    ///
    /// # Panics
    /// If there are fewer than (L+1)² coefficients or N values.
    pub(crate) fn adjoint(&self, values: &[f64], coefficients: &mut [f64]) {
        let spread = |places: &Places<WIDTH>, values: &[f64]| {
            let mut points = vec![0.0; self.grid.len()];
            places.spread(values, &mut points);
            points
        };
        let mut points = match &self.chunks[..] {
            [all] => spread(all, values),
            chunks => {
                let grids: Vec<_> = chunks
                    .par_iter()
                    .zip(values.par_chunks(self.chunk))
                    .map(|(places, values)| spread(places, values))
                    .collect();
                sum_in_order(grids, self.grid.len())
            }
        };
        self.grid.adjoint(&mut points, coefficients);
    }
}

/// Sums of `len` entries each, one grid after the other.
fn sum_in_order(grids: Vec<Vec<f64>>, len: usize) -> Vec<f64> {
    let mut sums = vec![0.0; len];
    for grid in grids {
        for (sum, entry) in sums.iter_mut().zip(grid) {
            *sum += entry;
        }
    }
    sums
}

#[cfg(test)]
mod tests;
