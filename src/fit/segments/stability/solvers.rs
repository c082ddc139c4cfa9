//! The same segment fitted in double precision in four ways: two bases, two ways to solve.

use super::extended::Sample;
use crate::sphere::{Cap, CapBasis, Places, coefficient_count, harmonics};
use faer::linalg::solvers::{Solve, SolveLstsq};
use faer::{Mat, MatRef, Side};

/// What spans the harmonics of degree <= L on a segment.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Basis {
    /// The library's, made for the cap round the segment.
    Cap,
    /// The real orthonormal harmonics, as the dissertation has them.
    Harmonics,
}

/// How the least squares are solved.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Solver {
    /// B^T B a = B^T r, by the factorization of Cholesky.
    NormalEquations,
    /// B = Q R, by the reflections of Householder.
    Reflections,
}

/// The functions at the samples: one column per function.
pub(super) fn design(basis: Basis, degree: usize, cap: &Cap, samples: &[Sample]) -> Mat<f64> {
    let (rows, columns) = (samples.len(), coefficient_count(degree));
    match basis {
        Basis::Harmonics => {
            let values: Vec<_> = samples
                .iter()
                .map(|s| harmonics(degree, &s.direction))
                .collect();
            Mat::from_fn(rows, columns, |i, j| values[i][j])
        }
        Basis::Cap => {
            let directions: Vec<_> = samples
                .iter()
                .map(|s| [s.direction.x, s.direction.y, s.direction.z, 0.0])
                .collect();
            let mut places = Places::default();
            cap.locate(&directions, &mut places);
            let mut values = vec![0.0; rows * columns];
            CapBasis::new(degree).evaluate(&places, &mut values, rows);
            MatRef::from_column_major_slice(&values, rows, columns).to_owned()
        }
    }
}

/// The fitted radii at the samples; `None` where the factorization breaks down or the radii are not
/// finite.
pub(super) fn fitted_radii(
    solver: Solver,
    design: &Mat<f64>,
    samples: &[Sample],
) -> Option<Vec<f64>> {
    let radii = Mat::from_fn(samples.len(), 1, |i, _| samples[i].radius());
    let coefficients = match solver {
        Solver::Reflections => design.qr().solve_lstsq(radii),
        Solver::NormalEquations => (design.transpose() * design)
            .llt(Side::Lower)
            .ok()?
            .solve(design.transpose() * radii),
    };
    let fitted = design * coefficients;
    fitted
        .is_all_finite()
        .then(|| fitted.col(0).iter().copied().collect())
}

/// Largest over least singular value of a design, its columns scaled to unit length.
pub(super) fn condition(design: &Mat<f64>) -> f64 {
    let scaled = Mat::from_fn(design.nrows(), design.ncols(), |i, j| {
        design[(i, j)] / design.col(j).norm_l2()
    });
    let values = scaled.singular_values().expect("finite columns");
    values[0] / values[values.len() - 1]
}
