//! The candidates of a search, as plots of error.

use crate::report::SearchReport;
use serde::Serialize;

/// Errors of all candidates.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct SearchPart {
    degrees: Vec<usize>,
    segments: Vec<usize>,
    coefficients: Vec<usize>,
    area_errors: Vec<Option<f64>>,
    volume_errors: Vec<Option<f64>>,
    heldout_rms: Vec<Option<f64>>,
}

impl From<&SearchReport> for SearchPart {
    fn from(report: &SearchReport) -> Self {
        let rows = || report.candidates.iter();
        Self {
            degrees: rows().map(|row| row.degree).collect(),
            segments: rows().map(|row| row.segments).collect(),
            coefficients: rows().map(|row| row.coefficients).collect(),
            area_errors: rows().map(|row| row.area_error).collect(),
            volume_errors: rows().map(|row| row.volume_error).collect(),
            heldout_rms: rows().map(|row| row.heldout_rms).collect(),
        }
    }
}
