//! Densely sampled cells, reduced once to a few rows that serve every level of a search.
//!
//! The least-squares fit of a segment needs, of a cell's thousands of samples, only the triangle R
//! of their factorization in the cell's own cap basis. A basis of a larger segment B' restricted to
//! the cell is a linear map of the cell's basis B (both span the same harmonics), so with a few
//! directions N spread over the cell, B'|cell = B pinv(B(N)) B'(N), and the rows that the cell adds
//! to the segment are C B'(N) with C = R pinv(B(N)), an exact identity. C is kept per cell; a level
//! of the search then costs the same whether a cell holds a hundred samples or a hundred thousand.

use crate::fit::linear::Factorization;
use crate::fit::prepare::{CellGrid, Sample, Samples};
use crate::sphere::{AngleRectangle, Cap, CapBasis, Places, coefficient_count};
use faer::linalg::solvers::SolveLstsq;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use rayon::prelude::*;

/// A cell is reduced when its samples outnumber its reduced rows by this factor.
const WORTH_REDUCING: usize = 3;

/// A cell in place of its samples.
pub(crate) struct ReducedCell {
    /// The directions N.
    directions: Vec<Sample>,
    /// C, one row per row of the triangle, one column per direction.
    mixing: Mat<f64>,
    /// The radius column of the triangle.
    radius: Vec<f64>,
}

/// Reduces every cell that holds enough samples; `None` where the samples themselves are fewer, and
/// an empty list where no cell is worth it.
pub(crate) fn reduce_cells(
    samples: &Samples,
    grid: &CellGrid,
    basis: &CapBasis,
) -> Vec<Option<ReducedCell>> {
    let columns = coefficient_count(basis.degree()) + 1;
    let per_angle = grid.per_angle();
    let cells = 0..per_angle * per_angle;
    let worth_it = |cell| samples.run(cell..cell + 1).len() >= WORTH_REDUCING * columns;
    if !cells.clone().any(worth_it) {
        return Vec::new();
    }
    cells
        .into_par_iter()
        .map_init(
            || Factorization::new(basis.degree()),
            |factorization, cell| {
                let rows = samples.run(cell..cell + 1);
                worth_it(cell)
                    .then(|| ReducedCell::new(rows, &grid.rectangle(cell), basis, factorization))
            },
        )
        .collect()
}

impl ReducedCell {
    fn new(
        rows: &[Sample],
        rectangle: &AngleRectangle,
        basis: &CapBasis,
        factorization: &mut Factorization,
    ) -> Self {
        let cap = rectangle.cap();
        let directions = spread(rectangle, basis.degree() + 3);
        let count = coefficient_count(basis.degree());

        factorization.clear();
        factorization.add_samples(basis, &cap, rows);
        let triangle = factorization.triangle();
        let r = Mat::from_fn(triangle.rows(), count, |i, j| triangle.at(i, j));
        let radius = (0..triangle.rows())
            .map(|i| triangle.projection(i))
            .collect();

        let nodes = directions.len();
        let mut values = vec![0.0; nodes * count];
        let mut places = Places::default();
        cap.locate(&directions, &mut places);
        basis.evaluate(&places, &mut values, nodes);
        let pseudo_inverse = MatRef::from_column_major_slice(&values, nodes, count)
            .qr()
            .solve_lstsq(Mat::<f64>::identity(nodes, nodes));
        Self {
            directions,
            mixing: r * pseudo_inverse,
            radius,
        }
    }

    /// Adds the rows of this cell to the factorization of a segment with the given cap, whose degree
    /// may be lower.
    pub(crate) fn add_to(
        &self,
        factorization: &mut Factorization,
        basis: &CapBasis,
        cap: &Cap,
        values: &mut Vec<f64>,
        places: &mut Places,
    ) {
        let (rows, nodes) = (self.radius.len(), self.directions.len());
        let count = coefficient_count(basis.degree());
        values.resize(nodes * count, 0.0);
        cap.locate(&self.directions, places);
        basis.evaluate(places, values, nodes);
        let most = factorization.most_rows();
        for first in (0..rows).step_by(most) {
            let block = most.min(rows - first);
            let (out, stride) = factorization.append(block);
            let (design, radius) = out.split_at_mut(count * stride);
            radius[..block].copy_from_slice(&self.radius[first..first + block]);
            faer::linalg::matmul::matmul(
                MatMut::from_column_major_slice_with_stride_mut(design, block, count, stride),
                Accum::Replace,
                self.mixing.subrows(first, block),
                MatRef::from_column_major_slice(values, nodes, count),
                1.0,
                Par::Seq,
            );
        }
    }
}

/// `n` x `n` directions spread over a rectangle, denser towards its borders (Chebyshev points), so
/// that every function of degree below n - 2 is told apart.
fn spread(rectangle: &AngleRectangle, n: usize) -> Vec<Sample> {
    let place =
        |i: usize| 0.5 - 0.5 * (std::f64::consts::PI * (2 * i + 1) as f64 / (2 * n) as f64).cos();
    (0..n * n)
        .map(|i| rectangle.direction(place(i / n), place(i % n)))
        .map(|d| [d.x, d.y, d.z, 0.0])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Frame;
    use crate::shapes::{Body, Sampling};
    use nalgebra::{Matrix3, Point3};

    #[test]
    fn a_reduced_cell_serves_expansions_of_lower_degree() {
        let surface = Body::Bean.surface();
        let directions = Sampling::Fibonacci.directions(40_000, 0).expect("points");
        let points: Vec<_> = directions
            .iter()
            .map(|n| Point3::from(n * surface.radius(n)))
            .collect();
        let frame = Frame {
            centre: Point3::origin(),
            axes: Matrix3::identity(),
        };
        let grid = CellGrid::new([4]);
        let samples = Samples::new(&points, &frame, &grid);
        let reduced = reduce_cells(&samples, &grid, &CapBasis::new(14));
        let basis = CapBasis::new(2);
        let (mut table, mut places) = (Vec::new(), Places::default());
        for (cell, reduced) in reduced.iter().enumerate() {
            let cap = grid.rectangle(cell).cap();
            let mut of_samples = Factorization::new(2);
            of_samples.add_samples(&basis, &cap, samples.run(cell..cell + 1));
            let mut of_cell = Factorization::new(2);
            let reduced = reduced.as_ref().expect("enough samples");
            reduced.add_to(&mut of_cell, &basis, &cap, &mut table, &mut places);
            let want = of_samples.triangle().solve(2);
            for (have, want) in of_cell.triangle().solve(2).iter().zip(want) {
                // Degree 14 is nearly dependent on the wedges at the poles.
                assert!((have - want).abs() < 1e-5, "{have} {want}");
            }
        }
    }
}
