//! How well figures are known that are no sums over the surface: as far as it may be off where they are taken from.
//!
//! A grain tells standard errors of its area, volume, moments and dimensions, and from place to place how far its surface may be
//! off. What else is measured follows from these. Places may all be off alike, and lengths have to do with each other in ways that
//! are not known, so errors add up: those that are told are as large as they may be, and wide as a rule.

mod bending;
mod chance;
mod corners;
mod ends;
mod from_centroid;
mod known;
mod outlines;
mod ratios;
mod sizes;
#[cfg(test)]
mod testing;
mod touching;

pub use bending::CurvatureErrors;
pub(super) use known::KnownPlace;
pub use outlines::OutlineErrors;
pub use sizes::BoxErrors;

use super::{Survey, SurveyError};
use nalgebra::Vector3;

/// Share of itself by which a length on a mesh of a smooth grain may be off.
const OF_MESH: f64 = 1e-4;

impl Survey<'_> {
    /// Of length, width and thickness, as shares of them.
    fn relative_dimension_errors(&self) -> Result<Option<Vector3<f64>>, SurveyError> {
        let Ok(errors) = self.standard_errors() else {
            return Ok(None);
        };
        Ok(Some(errors.dimensions.component_div(&self.dimensions()?)))
    }
}
