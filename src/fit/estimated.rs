//! The radius estimated, and the estimate approximated: by blended cells, or by one expansion where that is enough.

use super::blended::{self, Outcome, Settings, Target};
use super::candidate::{Candidate, Search, Work};
use super::context::{Context, Stage};
use super::error::FitError;
use super::estimate::Estimate;
use super::options::{FitOptions, Tolerance};
use super::outcome::{EstimateSummary, Fitted, Residuals};
use super::prepare::{Origin, PreparedScan, Sample};
use super::rippled::without_ripples;
use super::warning::FitWarning;
use crate::model::{Family, StarGrain};
use crate::sphere::{Interpolant, coefficient_count};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::iter::once;

/// An expansion of the whole sphere with no more coefficients than this needs no cells, which would touch as many: of degree 8 it
/// is evaluated in less time than any cells.
const FEW_COEFFICIENTS: usize = 81;

/// Difference from the estimate that is always good enough, as a share of the estimate's own standard deviation:
/// it adds 5 % to the error. Of a smooth grain not even that: cells even out noise that the estimate follows.
const GOOD_ENOUGH: f64 = 1.0 / 3.0;

/// The same where what is left of the points is no noise but detail, at least and at most: it adds 3 to 12 %, ...
const GOOD_ENOUGH_OF_DETAIL: [f64; 2] = [1.0 / 4.0, 1.0 / 2.0];

/// ... and in between the difference that is this share of the distance at which points are missed that the estimate has not seen: it
/// adds 2 % to that.
const OF_MISSED: f64 = 1.0 / 5.0;

/// Cells that are so many times farther off than the limit give way to one expansion that is within it and has no more
/// coefficients.
const FAR: f64 = 2.0;

/// What the estimate is made to.
struct Aim {
    /// The error that was asked for.
    tolerance: f64,
    /// Difference from the estimate that is near enough, as RMS.
    limit: f64,
    /// Degree at which one expansion is as near.
    degree: usize,
    /// Whether that expansion is the model, and not cells.
    is_whole: bool,
}

impl Aim {
    fn new(
        prepared: &PreparedScan<'_>,
        options: &FitOptions,
        estimate: &Estimate,
    ) -> Result<Self, FitError> {
        let tolerance = options.tolerance.length(prepared.mean_radius);
        let deviation = estimate.deviation();
        let good_enough = GOOD_ENOUGH * deviation;
        let limit = match good_enough > tolerance && estimate.is_rough() {
            true => {
                let [least, most] = GOOD_ENOUGH_OF_DETAIL.map(|share| share * deviation);
                tolerance.max((OF_MISSED * estimate.held_out()).clamp(least, most))
            }
            false => tolerance.max(good_enough),
        };
        let most = options.max_degree.unwrap_or(estimate.degree);
        if options.segments == Some(1) {
            // The estimate itself, unless a tolerance asks for less of it.
            let limit = match options.tolerance {
                Tolerance::Auto => estimate.resolution(),
                _ => limit,
            };
            let least = || estimate.least_degree(limit).min(most);
            let degree = options.degree.unwrap_or_else(least);
            if degree > estimate.degree {
                return Err(FitError::DegreeOfEstimate {
                    asked: degree,
                    reached: estimate.degree,
                });
            }
            return Ok(Self {
                tolerance,
                limit,
                degree,
                is_whole: true,
            });
        }
        let degree = estimate.least_degree(limit);
        let are_cells_asked = options.segments.is_some();
        if options.is_without_cells() {
            let degree = options.degree.unwrap_or(degree.min(most));
            return Ok(Self {
                tolerance,
                limit,
                degree: degree.min(estimate.degree),
                is_whole: true,
            });
        }
        let is_small = degree <= most && coefficient_count(degree) <= FEW_COEFFICIENTS;
        Ok(Self {
            tolerance,
            limit,
            degree,
            is_whole: is_small && !are_cells_asked && options.degree.is_none(),
        })
    }
}

/// Estimates the radius, then approximates the estimate.
pub(super) fn estimated(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    context.enter(Stage::Estimating)?;
    let (samples, estimate) = without_ripples(prepared, context)?;
    let aim = Aim::new(prepared, options, &estimate)?;
    let cut = match aim.is_whole {
        true => None,
        false => {
            context.enter(Stage::Searching { done: 0, all: None })?;
            Some(cut(&estimate, options, aim.limit)?)
        }
    };
    let mut search = search(&estimate, &aim, cut.as_ref());
    let is_outdone = cut.as_ref().is_some_and(|cut| {
        let fewer = coefficient_count(aim.degree) <= cut.rounds[cut.chosen].coefficients;
        options.is_unbounded() && fewer && cut.rms > FAR * aim.limit
    });
    let cut = cut.filter(|_| !is_outdone);
    if is_outdone {
        search.chosen = 0;
    }
    let not_met = cut
        .as_ref()
        .filter(|cut| options.segments.is_none() && !cut.met);
    let not_met = not_met.map(|cut| FitWarning::LimitNotMet {
        rms: cut.rms,
        limit: aim.limit,
    });
    let largest_difference = cut.as_ref().map(|cut| cut.max);
    let grain = |family: Family| {
        StarGrain::stretched(*prepared.frame(), estimate.stretch(), family)
            .expect("the axes are orthonormal")
    };
    let whole = grain(Family::Whole(estimate.expansion(aim.degree)));
    let (grain, whole) = match cut {
        Some(cut) => (grain(Family::Blended(cut.surface)), Some(whole)),
        None => (whole, None),
    };

    let residuals = residuals(&grain, samples.rows());
    let choice = &mut search.candidates[search.chosen];
    choice.heldout_rms = Some(estimate.held_out_of(&residuals, samples.rows()));
    let (outliers, one_sided) = (estimate.outliers, estimate.one_sided);
    let mut fitted = prepared.fitted(
        grain,
        search,
        Residuals::of(residuals),
        samples.rows().len() - outliers - one_sided,
    );
    fitted.whole = whole;
    fitted.warnings.extend(not_met);
    if outliers > 0 {
        fitted.warnings.push(FitWarning::Outliers { outliers });
    }
    if one_sided > 0 {
        let points = one_sided;
        fitted.warnings.push(FitWarning::OneSided { points });
    }
    let is_layered = |warning: &FitWarning| matches!(warning, FitWarning::Layers { .. });
    if prepared.origin() == Origin::Points
        && !fitted.warnings.iter().any(is_layered)
        && let Some(share) = estimate.layers()
    {
        let apart = share * fitted.mean_radius;
        fitted.warnings.push(FitWarning::Layers { apart, share });
    }
    fitted.estimate = Some(EstimateSummary {
        degree: estimate.degree,
        deviation: estimate.deviation(),
        noise: estimate.noise(),
        slope: estimate.spectrum.slope(),
        outliers: prepared.strays() + outliers + one_sided,
        largest_difference,
    });
    if estimate.hides_edges(estimate.is_rough()) {
        fitted.edged = Some(prepared.points().to_vec());
    }
    fitted.posterior = Some(Box::new(estimate));
    Ok(fitted)
}

/// Blended cells that are within a limit of the estimate.
fn cut(estimate: &Estimate, options: &FitOptions, limit: f64) -> Result<Outcome, FitError> {
    let settings = Settings {
        degree: options.degree,
        max_degree: options.top_degree(),
        segments: options.segments,
        max_segments: options.most_segments(),
        limit,
        is_textured: estimate.is_rough(),
    };
    let radius = estimate.stretched_radius();
    blended::approximate(&Plain { estimate, radius }, &settings).ok_or(FitError::NoEstimate)
}

/// What was tried: one expansion, and the rounds in which cells were cut.
fn search(estimate: &Estimate, aim: &Aim, cut: Option<&Outcome>) -> Search {
    let held_out = estimate.held_out();
    let near = |degree: usize, segments: usize, coefficients: usize, rms: f64| Candidate {
        estimate_rms: Some(rms),
        heldout_rms: Some(rms.hypot(held_out)),
        ..Candidate::unfitted(degree, segments, coefficients)
    };
    let size = coefficient_count(aim.degree);
    let whole = near(aim.degree, 1, size, estimate.truncation(aim.degree));
    let rounds = cut.map_or(&[][..], |cut| &cut.rounds);
    let cells = rounds
        .iter()
        .map(|round| near(round.degree, round.cells, round.coefficients, round.rms));
    Search {
        chosen: cut.map_or(0, |cut| 1 + cut.chosen),
        candidates: once(whole).chain(cells).collect(),
        limit: aim.limit,
        tolerance: aim.tolerance,
        noise: Some(estimate.noise()),
        work: Work {
            candidates: rounds.len(),
            segments: rounds.iter().map(|round| round.cells).sum(),
            ..Work::default()
        },
    }
}

/// The estimate in its stretched space, its errors weighed as those of the plain radius over all plain directions.
struct Plain<'a> {
    estimate: &'a Estimate,
    radius: Interpolant,
}

impl Target for Plain<'_> {
    fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        self.radius.values(directions)
    }

    fn weight(&self, n: &Vector3<f64>) -> f64 {
        self.estimate.weight(n)
    }

    fn length(&self, n: &Vector3<f64>) -> f64 {
        self.estimate.length(n)
    }
}

/// Samples whose residuals are found at once.
const CHUNK: usize = 1 << 15;

/// Residuals of all samples, in the grain's own frame.
fn residuals(grain: &StarGrain, samples: &[Sample]) -> Vec<f64> {
    let of_chunk = |samples: &[Sample]| {
        let direction = |&[x, y, z, _]: &Sample| Vector3::new(x, y, z);
        let directions: Vec<_> = samples.iter().map(direction).collect();
        let mut radii = grain.local_radii(&directions);
        for (radius, sample) in radii.iter_mut().zip(samples) {
            *radius = sample[3] - *radius;
        }
        radii
    };
    samples.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
}
