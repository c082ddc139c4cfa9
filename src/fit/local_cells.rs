//! Where errors of a grain's surface are taken: in the middles of the cells of [`LocalErrors`].

use crate::measure::Curvature;
use crate::model::{Grain, LocalError, LocalErrors, Stretch, Surface};
use crate::sphere::CubeCell;
use nalgebra::{Matrix3, Vector3};

/// Squares of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Squares {
    pub(super) place: f64,
    pub(super) curvature: f64,
}

/// The middles of the cells.
pub(super) fn directions() -> Vec<Vector3<f64>> {
    let cells = CubeCell::uniform(LocalErrors::PARTS);
    cells.iter().map(CubeCell::middle).collect()
}

/// The same in the scan's frame.
pub(super) fn of_cells(grain: &Grain) -> Vec<Vector3<f64>> {
    let axes = grain.frame().axes;
    let stretch = grain.star().map_or(Stretch::NONE, |star| *star.stretch());
    let plain = |n: Vector3<f64>| axes * n.component_div(stretch.factors()).normalize();
    directions().into_iter().map(plain).collect()
}

/// From the squared errors in these directions, and a share by which the size of the grain may be off; `None` if they are
/// not finite.
pub(super) fn errors(squares: &[Squares], of_size: f64, grain: &Grain) -> Option<LocalErrors> {
    let towards = of_cells(grain);
    let away = grain.jets(&towards).into_iter().zip(&towards);
    let errors = away.zip(squares).map(|((jet, n), squares)| {
        let off = of_size * Curvature::new(n, &jet).normal.dot(&jet.place);
        LocalError {
            place: round((squares.place + off.powi(2)).sqrt()),
            curvature: round(squares.curvature.sqrt()),
        }
    });
    LocalErrors::new(errors.collect())
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
