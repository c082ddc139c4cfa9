//! How uncertain a grain's surface is, from place to place.

use crate::sphere::CubeCell;
use nalgebra::Vector3;

/// Standard errors of a grain's surface in a direction.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LocalError {
    /// Of where the surface is, along its normal, in the scan's unit.
    pub place: f64,
    /// Of the curvature tensor (its Frobenius norm): no normal curvature, and neither principal one, is expected to be off
    /// by more. In one over the scan's unit.
    pub curvature: f64,
}

/// Standard errors of a grain's surface, one for each of 864 cells of directions of the grain's own frame, of a stretched
/// grain those of its [stretched space](super::Stretch), in which tips are as wide as sides.
///
/// Each is the root mean square over the cell.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalErrors(Vec<LocalError>);

impl LocalErrors {
    /// Cells along an edge of the cube.
    pub const PARTS: u16 = 12;

    /// From the errors of the [`CubeCell::uniform`] cells; `None` if they are not 864 pairs of finite numbers, none below
    /// zero.
    pub fn new(of_cells: Vec<LocalError>) -> Option<Self> {
        let is_whole = of_cells.len() == 6 * usize::from(Self::PARTS).pow(2);
        let is_error = |e: f64| e.is_finite() && e >= 0.0;
        let are_errors = of_cells
            .iter()
            .all(|e| is_error(e.place) && is_error(e.curvature));
        (is_whole && are_errors).then_some(Self(of_cells))
    }

    /// The errors of the cells.
    pub fn of_cells(&self) -> &[LocalError] {
        &self.0
    }

    /// The errors in a direction of the space of the cells.
    pub fn at(&self, n: &Vector3<f64>) -> LocalError {
        self.0[CubeCell::position(Self::PARTS, n)]
    }

    /// Those of a grain so many times as large.
    pub(super) fn times(&self, factor: f64) -> Self {
        let larger = |error: &LocalError| LocalError {
            place: error.place * factor,
            curvature: error.curvature / factor,
        };
        Self(self.0.iter().map(larger).collect())
    }
}
