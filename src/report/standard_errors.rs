//! Standard errors of figures, or why there are none.

use super::measure::records::{Dimensions, rows};
use crate::model::{NoInterval, StandardErrors};
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
    /// Of the centroid's coordinates along the grain's axes.
    pub centroid: [f64; 3],
    /// Of the inertia tensor about the centroid, along the grain's axes.
    pub inertia: [[f64; 3]; 3],
}

impl From<StandardErrors> for StandardErrorsRecord {
    fn from(errors: StandardErrors) -> Self {
        Self {
            area: errors.area,
            volume: errors.volume,
            moments: errors.moments.into(),
            dimensions: Dimensions::new(errors.dimensions),
            dimensions_excess: Dimensions::new(errors.dimensions_excess),
            centroid: errors.centroid.into(),
            inertia: rows(&errors.inertia),
        }
    }
}

/// What a report says of the errors of its figures: these, or why there are none, half a sentence. `None` is that of no
/// figures.
pub(super) fn recorded(
    errors: Option<Result<StandardErrors, NoInterval>>,
) -> (Option<StandardErrorsRecord>, Option<String>) {
    match errors {
        Some(Ok(errors)) => (Some(errors.into()), None),
        Some(Err(why)) => (None, Some(why.to_string())),
        None => (None, Some("there are no figures for them".into())),
    }
}
