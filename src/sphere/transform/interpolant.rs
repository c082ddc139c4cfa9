//! An expansion to be evaluated in directions that are asked for once.

use super::grid::Grid;
use super::places::{corner, weighted_sum};
use crate::vectorize::vectorize;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::sync::Arc;

/// Points of the grid that a value is interpolated from, in each direction.
const WIDTH: usize = 10;

/// Directions that a thread evaluates at once.
const CHUNK: usize = 4096;

/// An expansion on its grid, and values of it anywhere, to 5e-9 of the norm of its coefficients.
pub(crate) struct Interpolant {
    grid: Arc<Grid>,
    points: Vec<f64>,
}

impl Interpolant {
    /// Of a degree L and its (L+1)² coefficients.
    ///
    /// # Panics
    /// If there are fewer coefficients.
    pub(crate) fn new(degree: usize, coefficients: &[f64]) -> Self {
        let grid = Grid::of_degree(degree, WIDTH);
        let points = grid.synthesis(coefficients);
        Self { grid, points }
    }

    /// The values in the directions of unit vectors.
    pub(crate) fn values(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        let mut values = vec![0.0; directions.len()];
        directions
            .par_chunks(CHUNK)
            .zip(values.par_chunks_mut(CHUNK))
            .for_each(|(directions, values)| self.evaluate(directions, values));
        values
    }

    fn evaluate(&self, directions: &[Vector3<f64>], values: &mut [f64]) {
        let stride = self.grid.stride();
        let places: Vec<[f64; 2]> = directions.iter().map(|n| self.grid.place(n)).collect();
        vectorize(
            #[inline(always)]
            || {
                for (&place, value) in places.iter().zip(&mut *values) {
                    let [row, column] = corner(place);
                    let weights = place.map(
                        #[inline(always)]
                        |t| self.grid.kernel().weights::<WIDTH>(t),
                    );
                    let points = &self.points[row * stride + column..];
                    *value = weighted_sum(points, stride, &weights);
                }
            },
        );
    }
}
