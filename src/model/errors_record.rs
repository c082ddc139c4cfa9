//! Standard errors in the file of a model.

use super::{LocalError, LocalErrors, StandardErrors};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// The standard errors of a grain's figures, in the powers of the scan's unit of these.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ErrorsRecord {
    area: f64,
    volume: f64,
    /// Along the grain's axes.
    centroid: [f64; 3],
    /// Columns, along the grain's axes.
    inertia: [[f64; 3]; 3],
    /// Ascending.
    moments: [f64; 3],
    /// Length, width and thickness.
    dimensions: [f64; 3],
    dimensions_excess: [f64; 3],
}

impl From<StandardErrors> for ErrorsRecord {
    fn from(errors: StandardErrors) -> Self {
        Self {
            area: errors.area,
            volume: errors.volume,
            centroid: errors.centroid.into(),
            inertia: errors.inertia.into(),
            moments: errors.moments.into(),
            dimensions: errors.dimensions.into(),
            dimensions_excess: errors.dimensions_excess.into(),
        }
    }
}

impl From<ErrorsRecord> for StandardErrors {
    fn from(record: ErrorsRecord) -> Self {
        Self {
            area: record.area,
            volume: record.volume,
            centroid: record.centroid.into(),
            inertia: Matrix3::from(record.inertia),
            moments: record.moments.into(),
            dimensions: record.dimensions.into(),
            dimensions_excess: record.dimensions_excess.into(),
        }
    }
}

/// Standard errors by cell.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LocalErrorsRecord {
    place: Vec<f64>,
    curvature: Vec<f64>,
}

impl LocalErrorsRecord {
    pub(super) fn of(errors: &LocalErrors) -> Self {
        let cells = errors.of_cells();
        Self {
            place: cells.iter().map(|error| error.place).collect(),
            curvature: cells.iter().map(|error| error.curvature).collect(),
        }
    }

    /// `None` if these are no errors of all cells.
    pub(super) fn read(&self) -> Option<LocalErrors> {
        let is_paired = self.place.len() == self.curvature.len();
        let pairs = self.place.iter().zip(&self.curvature);
        let cells = pairs.map(|(&place, &curvature)| LocalError { place, curvature });
        LocalErrors::new(cells.collect()).filter(|_| is_paired)
    }
}
