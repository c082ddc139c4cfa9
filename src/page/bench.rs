//! Families of models, as plots of error against what they cost.

use crate::bench::BenchScan;
use serde::Serialize;

/// Cost and error of every model fitted, by family.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct BenchPart {
    families: Vec<&'static str>,
    segments: Vec<usize>,
    coefficients: Vec<usize>,
    seconds: Vec<f64>,
    heldout_shares: Vec<Option<f64>>,
}

impl From<&BenchScan> for BenchPart {
    fn from(scan: &BenchScan) -> Self {
        let rows = || scan.rows.iter();
        Self {
            families: rows().map(|row| row.family.name()).collect(),
            segments: rows().map(|row| row.segments).collect(),
            coefficients: rows().map(|row| row.coefficients).collect(),
            seconds: rows().map(|row| row.seconds).collect(),
            heldout_shares: rows().map(|row| row.heldout_share).collect(),
        }
    }
}
