//! How uncertain the curvature of a grain is, from place to place.

use crate::sphere::CubeCell;
use nalgebra::Vector3;

/// Standard errors of a grain's curvature, one for each of 864 cells of directions of the grain's own frame.
///
/// Each is the root mean square, over the cell, of the error of the curvature tensor (its Frobenius norm): no normal
/// curvature, and neither principal one, is expected to be off by more. In one over the scan's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvatureErrors(Vec<f64>);

impl CurvatureErrors {
    /// Cells along an edge of the cube.
    pub const PARTS: u16 = 12;

    /// From the errors of the [`CubeCell::uniform`] cells; `None` if they are not 864 finite numbers, none below zero.
    pub fn new(of_cells: Vec<f64>) -> Option<Self> {
        let is_whole = of_cells.len() == 6 * usize::from(Self::PARTS).pow(2);
        let are_errors = of_cells.iter().all(|e| e.is_finite() && *e >= 0.0);
        (is_whole && are_errors).then_some(Self(of_cells))
    }

    /// The errors of the cells.
    pub fn of_cells(&self) -> &[f64] {
        &self.0
    }

    /// The error in a direction of the grain's own frame.
    pub fn at(&self, n: &Vector3<f64>) -> f64 {
        self.0[CubeCell::position(Self::PARTS, n)]
    }

    /// Those of a grain so many times as large.
    pub(super) fn over(&self, factor: f64) -> Self {
        Self(self.0.iter().map(|error| error / factor).collect())
    }
}
