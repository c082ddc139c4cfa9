//! The figures of a body that is known.

use super::measure::rows;
use super::number::{short, triple, triples};
use crate::measure::MassProperties;
use serde::Serialize;
use std::fmt;

/// Area, volume, centroid and inertia of a body, in millimetres.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TruthRecord {
    /// Area.
    pub area: f64,
    /// Volume.
    pub volume: f64,
    /// Centroid, where the scan lies.
    pub centroid: [f64; 3],
    /// Inertia about the centroid.
    pub inertia: [[f64; 3]; 3],
    /// Relative error of these figures: estimated where they come from quadrature.
    pub relative_error: f64,
}

impl TruthRecord {
    /// The record of these figures.
    pub fn new(properties: &MassProperties, relative_error: f64) -> Self {
        Self {
            area: properties.area,
            volume: properties.volume,
            centroid: properties.centroid.coords.into(),
            inertia: rows(&properties.inertia),
            relative_error,
        }
    }
}

impl fmt::Display for TruthRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "area         {}", short(self.area))?;
        writeln!(f, "volume       {}", short(self.volume))?;
        writeln!(f, "centroid     {}", triple(self.centroid))?;
        for (i, row) in triples(self.inertia).into_iter().enumerate() {
            let name = if i == 0 { "inertia" } else { "" };
            writeln!(f, "{name:<13}{row}")?;
        }
        Ok(())
    }
}
