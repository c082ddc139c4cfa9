//! The search over segment count and degree.
//!
//! **Rule.** Among the candidates that are not rejected, take the fewest coefficients whose held-out
//! RMS is within the limit; of several with the same count, the one that deviates least from the
//! reference surface (|area error| + |volume error|). Where none is within the limit, take the least
//! held-out RMS. The limit is the tolerance, or the scan's noise floor where that is larger. The
//! reference deviations alone do not decide: the reference is a polyhedron that is itself off by up
//! to some percent, and coarse steppy surfaces meet its area by accident.
//!
//! **Held-out error.** Every sample is predicted from all samples but itself (leave-one-out, in
//! closed form: residual / (1 - leverage)); of clouds above 16 384 points, one point in each of
//! 13 824 patches of directions.
//!
//! **Noise floor.** 1.1 times the standard deviation of the samples round a local fit with some 32
//! samples per segment: a model within it adds less than half the noise to the truth.
//!
//! **Skipping.** Levels are fitted from coarse to fine. Once a candidate is within the limit, those
//! with more coefficients cannot win and are not fitted; a level is factored only up to the largest
//! degree that still can.

use super::level::FittedLevel;
use super::levels::Levels;
use super::segment::SegmentFit;
use crate::fit::candidate::{Candidate, Rejection, Search, Work, choose};
use crate::fit::context::{Context, Stage};
use crate::fit::error::FitError;
use crate::fit::options::FitOptions;
use crate::fit::outcome::Residuals;
use crate::fit::prepare::PreparedScan;
use crate::model::Segmented;
use crate::sphere::{AngularPartition, coefficient_count};

/// The independent segments that a search chose.
pub(crate) struct SegmentsFit {
    pub(crate) surface: Segmented,
    /// Distinct points.
    pub(crate) points: usize,
    pub(crate) residuals: Residuals,
    pub(crate) search: Search,
}

/// A local fit adds noise / sqrt(samples per coefficient); the limit leaves room for that.
const NOISE_MARGIN: f64 = 1.1;

/// Searches the prepared scan.
pub(crate) fn search(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<SegmentsFit, FitError> {
    let (degrees, parts) = (options.degrees(), options.parts()?);
    let top = options.top_degree();
    let levels = Levels::new(prepared, &parts, top);
    let mut work = Work::default();
    let mut fit = |k: usize, degree: usize| {
        work.segments += k * k;
        FittedLevel::new(&levels.level(k, degree))
    };

    let only_one = degrees.len() * parts.len() == 1;
    let noise_parts = levels.noise_parts;
    let noise_level = (!only_one).then(|| fit(noise_parts, top));
    let noise = noise_level
        .as_ref()
        .map(|level| level.residual_variance().sqrt())
        // Points that are all met tell of no noise.
        .filter(|noise| *noise > 0.0);
    let tolerance = options.tolerance.length(prepared.mean_radius);
    let limit = tolerance.max(NOISE_MARGIN * noise.unwrap_or(0.0));

    let mut candidates = Vec::with_capacity(degrees.len() * parts.len());
    let mut fitted = Vec::with_capacity(parts.len());
    let mut enough = usize::MAX;
    for (done, &k) in parts.iter().enumerate() {
        let all = Some(parts.len());
        context.enter(Stage::Searching { done, all })?;
        let within_reach =
            |degree: usize| options.exhaustive || k * k * coefficient_count(degree) <= enough;
        let reachable = degrees.iter().copied().filter(|&d| within_reach(d)).max();
        let level = reachable.map(|degree| match &noise_level {
            Some(level) if noise_parts == k => level.clone(),
            _ => fit(k, degree),
        });
        for &degree in &degrees {
            candidates.push(match &level {
                Some(level) if within_reach(degree) => level.candidate(degree, &prepared.reference),
                _ => Candidate::skipped(degree, k),
            });
        }
        for candidate in &candidates[candidates.len() - degrees.len()..] {
            if candidate.rejected.is_none() && candidate.heldout_rms.is_some_and(|rms| rms <= limit)
            {
                enough = enough.min(candidate.coefficients);
            }
        }
        fitted.push(level);
    }

    let chosen = choose(&candidates, limit);
    let is_fitted = |c: &&Candidate| c.rejected != Some(Rejection::Skipped);
    work.candidates = candidates.iter().filter(is_fitted).count();
    work.candidates_skipped = candidates.len() - work.candidates;
    work.segments_skipped = fitted
        .iter()
        .zip(&parts)
        .filter(|(level, _)| level.is_none())
        .map(|(_, k)| k * k)
        .sum();
    let segments = fitted
        .swap_remove(chosen / degrees.len())
        .map_or_else(Vec::new, |level| level.segments);
    let (surface, residuals) = surface(&levels, &candidates[chosen], segments);
    Ok(SegmentsFit {
        surface,
        points: levels.points(),
        residuals,
        search: Search {
            candidates,
            chosen,
            limit,
            tolerance,
            noise,
            work,
        },
    })
}

/// The surface of the chosen candidate and the residuals of all samples.
fn surface(
    levels: &Levels,
    choice: &Candidate,
    segments: Vec<SegmentFit>,
) -> (Segmented, Residuals) {
    let degree = choice.degree;
    let partition = AngularPartition::new(choice.segments.isqrt());
    let level = levels.level(partition.per_angle(), degree);
    let residuals = level.residuals(&segments);
    let coefficients = segments
        .into_iter()
        .map(|mut segment| {
            let fitted = degree.min(segment.degrees.len() - 1);
            segment.degrees.swap_remove(fitted).coefficients
        })
        .collect();
    let surface = Segmented::new(partition, coefficients)
        .expect("finite samples give finite coefficients, (L + 1)^2 per segment");
    (surface, residuals)
}
