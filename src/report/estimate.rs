//! What a fit tells of its estimate, and of what an evaluation costs.

use crate::digits::plural;
use crate::fit::EstimateSummary;
use crate::model::{Grain, Surface};
use crate::sphere::cube_grid;
use serde::Serialize;
use std::fmt;
use std::hint::black_box;
use std::time::Instant;

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
    /// Nanoseconds of one place, measured here and now.
    pub nanoseconds: f64,
}

/// Cells along a cube's edge of the directions that are timed: 98 directions.
const TIMED: usize = 4;

/// Times that they are evaluated: the least is told.
const REPEATS: usize = 3;

impl EvaluationRecord {
    pub(super) fn new(grain: &Grain) -> Self {
        let (directions, _) = cube_grid(TIMED);
        let seconds = (0..REPEATS).map(|_| {
            let started = Instant::now();
            for n in &directions {
                black_box(grain.place(black_box(n)));
            }
            started.elapsed().as_secs_f64()
        });
        let least = seconds.fold(f64::INFINITY, f64::min);
        Self {
            degree: grain.degree(),
            coefficients: grain.coefficient_count(),
            touched: grain.coefficients_touched(),
            nanoseconds: 1e9 * least / directions.len() as f64,
        }
    }
}

impl fmt::Display for EvaluationRecord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}, {:.0} per evaluation ({:.0} ns)",
            plural(self.coefficients, "coefficient"),
            self.touched,
            self.nanoseconds
        )
    }
}
