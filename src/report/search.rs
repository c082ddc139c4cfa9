//! What `grainform search` tells: every candidate.

use super::rule::rule;
use super::scan::ReportedScan;
use super::warning::sentences;
use super::{ReferenceRecord, Seconds};
use crate::fit::{Candidate, FitOptions, Fitted};
use crate::unit::Unit;
use serde::Serialize;

/// The candidates of a search and the choice.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SearchReport {
    /// The scan.
    pub input: String,
    /// Unit of lengths, where it was told; areas and volumes are in its square and cube.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Distinct points that the fits rest on.
    pub points: usize,
    /// Every candidate, by segments and then by degree.
    pub candidates: Vec<CandidateRecord>,
    /// Index of the chosen one.
    pub chosen: usize,
    /// Why it was chosen: half a sentence.
    pub rule: String,
    /// The error that was good enough: the difference from the estimate, or the held-out RMS of independent
    /// segments and mirrored fits.
    pub limit: f64,
    /// Standard deviation of what the estimate does not follow of one point: noise, and edges that it does not resolve; without
    /// an estimate of the noise as the candidates tell it; `null` where it is not known.
    pub noise: Option<f64>,
    /// Mean radius over all directions.
    pub mean_radius: f64,
    /// What the candidates are compared with; `null` where much of the surface was not seen.
    pub reference: Option<ReferenceRecord>,
    /// Wall-clock time.
    pub seconds: Seconds,
    /// What is odd about the scan or the fit: whole sentences.
    pub warnings: Vec<String>,
}

/// One degree and number of segments. Errors are `null` where it could not be fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CandidateRecord {
    /// Largest degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments.
    pub segments: usize,
    /// Coefficients of all segments together.
    pub coefficients: usize,
    /// Area against the reference.
    pub area_error: Option<f64>,
    /// Volume against the reference.
    pub volume_error: Option<f64>,
    /// Root mean square error of points that were left out one by one, along rays; of blended cells that were not chosen it is
    /// forecast from the estimate.
    pub heldout_rms: Option<f64>,
    /// Root mean square difference of the radius from the estimate, over all directions; `null` of candidates that
    /// are fitted to the points themselves.
    pub estimate_rms: Option<f64>,
    /// Segments fitted at a lower degree because they hold too few points.
    pub reduced_segments: usize,
    /// Why this candidate cannot be chosen, if so.
    pub rejected: Option<String>,
}

impl SearchReport {
    /// The report of a search, for the options it was made with.
    pub fn new(scan: ReportedScan, fitted: &Fitted, options: &FitOptions) -> Self {
        let ReportedScan {
            input,
            unit,
            warnings,
        } = scan;
        let search = &fitted.search;
        Self {
            input,
            unit,
            points: fitted.points,
            candidates: search.candidates.iter().map(Into::into).collect(),
            chosen: search.chosen,
            rule: rule(fitted, options, unit),
            limit: search.limit,
            noise: search.noise,
            mean_radius: fitted.mean_radius,
            reference: fitted
                .grain
                .unseen()
                .is_none()
                .then(|| fitted.reference.into()),
            seconds: Seconds::default(),
            warnings: sentences(&warnings, &fitted.warnings, unit),
        }
    }
}

impl From<&Candidate> for CandidateRecord {
    fn from(candidate: &Candidate) -> Self {
        Self {
            degree: candidate.degree,
            segments: candidate.segments,
            coefficients: candidate.coefficients,
            area_error: candidate.area_error,
            volume_error: candidate.volume_error,
            heldout_rms: candidate.heldout_rms,
            estimate_rms: candidate.estimate_rms,
            reduced_segments: candidate.reduced_segments,
            rejected: candidate.rejected.map(|reason| reason.to_string()),
        }
    }
}
