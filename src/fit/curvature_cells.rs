//! Where errors of a grain's curvature are taken: some places in each cell of [`CurvatureErrors`].

use crate::measure::Curvature;
use crate::model::CurvatureErrors;
use crate::sphere::CubeCell;
use nalgebra::{Matrix3, Vector3};

/// Places along each side of a cell.
const PLACES: usize = 2;

/// Places of a cell.
pub(super) const PER_CELL: usize = PLACES * PLACES;

/// Directions of the grain's own frame, those of a cell one after the other.
pub(super) fn directions() -> Vec<Vector3<f64>> {
    let along = || (0..PLACES).map(|i| (i as f64 + 0.5) / PLACES as f64);
    let cells = CubeCell::uniform(CurvatureErrors::PARTS);
    let places = |cell: &CubeCell| {
        let both = along().flat_map(|s| along().map(move |t| (s, t)));
        both.map(|(s, t)| cell.at(s, t)).collect::<Vec<_>>()
    };
    cells.iter().flat_map(places).collect()
}

/// From the squared errors in these directions; `None` if they are not finite.
pub(super) fn errors(squares: &[f64]) -> Option<CurvatureErrors> {
    let cells = squares.chunks_exact(PER_CELL);
    let of_cell = |own: &[f64]| round((own.iter().sum::<f64>() / PER_CELL as f64).sqrt());
    CurvatureErrors::new(cells.map(of_cell).collect())
}

/// To three digits: an error needs no more.
fn round(error: f64) -> f64 {
    format!("{error:.2e}").parse().unwrap_or(error)
}

/// The curvature tensor: principal curvatures along their directions.
pub(super) fn tensor(curvature: &Curvature) -> Matrix3<f64> {
    let along = |i: usize| {
        let direction = curvature.directions[i];
        direction * direction.transpose() * curvature.principal[i]
    };
    along(0) + along(1)
}
