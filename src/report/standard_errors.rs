//! Standard errors of figures, or why there are none.

use super::measure::records::{Dimensions, rows};
use crate::model::{NoStandardErrors, StandardErrors};
use nalgebra::Matrix3;
use serde::Serialize;

/// Standard errors (one standard deviation) of a fitted grain's figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StandardErrorsRecord {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
    /// Of the principal moments.
    pub moments: [f64; 3],
    /// Of the dimensions.
    pub dimensions: Dimensions,
    /// What noise adds to the dimensions, as a mean: an extent is between the points farthest out.
    pub dimensions_excess: Dimensions,
    /// Of the centroid's coordinates along the grain's own axes.
    pub centroid: [f64; 3],
    /// Of the inertia tensor about the centroid, along the grain's own axes.
    pub inertia: [[f64; 3]; 3],
    /// The grain's own axes in the scan.
    pub axes: [[f64; 3]; 3],
}

impl StandardErrorsRecord {
    /// With the grain's own axes in columns.
    pub(crate) fn new(errors: &StandardErrors, axes: &Matrix3<f64>) -> Self {
        Self {
            area: errors.area,
            volume: errors.volume,
            moments: errors.moments.into(),
            dimensions: Dimensions::new(errors.dimensions),
            dimensions_excess: Dimensions::new(errors.dimensions_excess),
            centroid: errors.centroid.into(),
            inertia: rows(&errors.inertia),
            axes: rows(&axes.transpose()),
        }
    }
}

/// What a report says of the errors of its figures, given the grain's own axes: these, or why there are none, half a sentence. `None` is that of no
/// figures.
pub(super) fn recorded(
    errors: Option<Result<StandardErrors, NoStandardErrors>>,
    axes: &Matrix3<f64>,
) -> (Option<StandardErrorsRecord>, Option<String>) {
    match errors {
        Some(Ok(errors)) => (Some(StandardErrorsRecord::new(&errors, axes)), None),
        Some(Err(why)) => (None, Some(why.to_string())),
        None => (None, Some("there are no figures for them".into())),
    }
}
