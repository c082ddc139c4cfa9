//! What a fit tells of its estimate, and of what an evaluation costs.

use crate::digits::plural;
use crate::fit::EstimateSummary;
use crate::model::Grain;
use serde::Serialize;
use std::fmt;

/// What the points say of the radius before it is cut in segments: lengths in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EstimateRecord {
    /// Largest degree of its expansion.
    pub degree: usize,
    /// Standard deviation of the radius, as root mean square over all directions.
    pub deviation: f64,
    /// Standard deviation of what it does not follow of one point: noise, and edges that it does not resolve (of the mean of a
    /// patch, of clouds of more than 30 000 points).
    pub noise: f64,
    /// Exponent of the power law by which the variance of its harmonics falls with their degree.
    pub slope: f64,
    /// Points that were left out: those that stand apart from their neighbours, those that stand alone, and dust or glare on one
    /// side.
    pub outliers: usize,
    /// Largest difference of the model's radius from the estimate; `null` where the model is its expansion.
    pub largest_difference: Option<f64>,
}

impl From<EstimateSummary> for EstimateRecord {
    fn from(summary: EstimateSummary) -> Self {
        let EstimateSummary {
            degree,
            deviation,
            noise,
            slope,
            outliers,
            largest_difference,
        } = summary;
        Self {
            degree,
            deviation,
            noise,
            slope,
            outliers,
            largest_difference,
        }
    }
}

/// What an evaluation of a surface costs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EvaluationRecord {
    /// Largest degree.
    pub degree: usize,
    /// Coefficients of all segments.
    pub coefficients: usize,
    /// Coefficients that one evaluation touches, as a mean over all directions.
    pub touched: f64,
    /// Nanoseconds of one place, where they were [measured](super::FitReport::timed).
    pub nanoseconds: Option<f64>,
}

impl EvaluationRecord {
    pub(super) fn new(grain: &Grain) -> Self {
        Self {
            degree: grain.degree(),
            coefficients: grain.coefficient_count(),
            touched: grain.coefficients_touched(),
            nanoseconds: None,
        }
    }
}

impl fmt::Display for EvaluationRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}, {:.0} per evaluation",
            plural(self.coefficients, "coefficient"),
            self.touched
        )?;
        self.nanoseconds
            .map_or(Ok(()), |time| write!(f, " ({time:.0} ns)"))
    }
}
