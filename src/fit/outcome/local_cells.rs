//! Where errors of a grain's surface are taken: some places in each cell of [`LocalErrors`].

use crate::measure::Curvature;
use crate::model::{Grain, LocalError, LocalErrors, Stretch, Surface, SurfaceJet};
use crate::sphere::CubeCell;
use nalgebra::{Matrix3, Vector3};

/// Places along each side of a cell.
const PLACES: usize = 2;

/// Places of a cell.
pub(in crate::fit) const PER_CELL: usize = PLACES * PLACES;

/// Squares of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fit) struct Squares {
    pub(in crate::fit) place: f64,
    pub(in crate::fit) curvature: f64,
}

/// Directions of the space of the cells, those of a cell one after the other.
pub(in crate::fit) fn directions() -> Vec<Vector3<f64>> {
    let along = || (0..PLACES).map(|i| (i as f64 + 0.5) / PLACES as f64);
    let cells = CubeCell::uniform(LocalErrors::PARTS);
    let places = |cell: &CubeCell| {
        let both = along().flat_map(|s| along().map(move |t| (s, t)));
        both.map(|(s, t)| cell.at(s, t)).collect::<Vec<_>>()
    };
    cells.iter().flat_map(places).collect()
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
    let off = squares_of_size(of_size, grain);
    let root_mean = |sum: f64| round((sum / PER_CELL as f64).sqrt());
    let cells = squares
        .chunks_exact(PER_CELL)
        .zip(off.chunks_exact(PER_CELL));
    let of_cell = |(own, off): (&[Squares], &[f64])| LocalError {
        place: root_mean(
            own.iter()
                .zip(off)
                .map(|(squares, off)| squares.place + off)
                .sum(),
        ),
        curvature: root_mean(own.iter().map(|squares| squares.curvature).sum()),
    };
    LocalErrors::new(cells.map(of_cell).collect())
}

/// Squares of how far the surface is off in these directions if the size is by a share.
fn squares_of_size(share: f64, grain: &Grain) -> Vec<f64> {
    let towards = of_cells(grain);
    if share == 0.0 {
        return vec![0.0; towards.len()];
    }
    let jets = grain.jets(&towards).into_iter().zip(&towards);
    let off = |jet: &SurfaceJet, n| share * Curvature::new(n, jet).normal.dot(&jet.place);
    jets.map(|(jet, n)| off(&jet, n).powi(2)).collect()
}

/// To three digits: an error needs no more.
fn round(error: f64) -> f64 {
    format!("{error:.2e}").parse().unwrap_or(error)
}

/// The curvature tensor: principal curvatures along their directions.
pub(in crate::fit) fn tensor(curvature: &Curvature) -> Matrix3<f64> {
    let along = |i: usize| {
        let direction = curvature.directions[i];
        direction * direction.transpose() * curvature.principal[i]
    };
    along(0) + along(1)
}
