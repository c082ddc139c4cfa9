//! Interpolation from a grid at places that do not change, and its transpose.

use super::grid::Grid;
use crate::vectorize::vectorize;
use nalgebra::Vector3;

/// Places are visited in bands of as many rows of the grid, so that what they read stays in cache.
const BAND: usize = 8;

/// The places of some directions on a grid, in the order in which they are visited.
pub(super) struct Places<const WIDTH: usize> {
    /// Length of a row of the grid.
    stride: usize,
    places: Vec<Place>,
    /// Weights of the rows and of the columns of each place.
    weights: Vec<[[f64; WIDTH]; 2]>,
}

struct Place {
    /// Which direction it is.
    index: u32,
    /// Offset of the first of its WIDTH x WIDTH points of the grid.
    corner: u32,
}

impl<const WIDTH: usize> Places<WIDTH> {
    pub(super) fn new(grid: &Grid, directions: &[Vector3<f64>]) -> Self {
        let mut visits: Vec<_> = directions
            .iter()
            .enumerate()
            .map(|(index, n)| {
                let at = grid.place(n);
                let [row, column] = corner(at);
                ((row / BAND, column, row, index), at)
            })
            .collect();
        visits.sort_unstable_by_key(|(key, _)| *key);
        let stride = grid.stride();
        let mut weights = vec![[[0.0; WIDTH]; 2]; visits.len()];
        vectorize(
            #[inline(always)]
            || {
                for ((_, at), weights) in visits.iter().zip(&mut weights) {
                    *weights = at.map(
                        #[inline(always)]
                        |t| grid.kernel().weights(t),
                    );
                }
            },
        );
        Self {
            stride,
            places: visits
                .iter()
                .map(|((_, column, row, index), _)| Place {
                    index: *index as u32,
                    corner: (row * stride + column) as u32,
                })
                .collect(),
            weights,
        }
    }

    /// `values[i]` = the function on the grid in direction i.
    pub(super) fn interpolate(&self, points: &[f64], values: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                for (place, weights) in self.places.iter().zip(&self.weights) {
                    let points = &points[place.corner as usize..];
                    values[place.index as usize] = weighted_sum(points, self.stride, weights);
                }
            },
        );
    }

    /// The transpose of [`Self::interpolate`]: adds to `points`.
    pub(super) fn spread(&self, values: &[f64], points: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                for (place, [rows, columns]) in self.places.iter().zip(&self.weights) {
                    let value = values[place.index as usize];
                    let mut scaled = [0.0; WIDTH];
                    for b in 0..WIDTH {
                        scaled[b] = value * columns[b];
                    }
                    for (a, weight) in rows.iter().enumerate() {
                        let to = &mut points[place.corner as usize + a * self.stride..][..WIDTH];
                        for b in 0..WIDTH {
                            to[b] += weight * scaled[b];
                        }
                    }
                }
            },
        );
    }
}

/// Row and column of the first of the WIDTH x WIDTH points of the grid around a place.
pub(super) fn corner(place: [f64; 2]) -> [usize; 2] {
    place.map(|t| t.ceil() as usize)
}

/// The sum of WIDTH x WIDTH points of a grid, of which the first is the first of `points`, times the weights of their rows
/// and columns.
#[inline(always)]
pub(super) fn weighted_sum<const WIDTH: usize>(
    points: &[f64],
    stride: usize,
    [rows, columns]: &[[f64; WIDTH]; 2],
) -> f64 {
    let mut sums = [0.0; WIDTH];
    for (a, weight) in rows.iter().enumerate() {
        let from = &points[a * stride..][..WIDTH];
        for b in 0..WIDTH {
            sums[b] += weight * from[b];
        }
    }
    let mut products = [0.0; WIDTH];
    for b in 0..WIDTH {
        products[b] = sums[b] * columns[b];
    }
    products.iter().sum()
}
