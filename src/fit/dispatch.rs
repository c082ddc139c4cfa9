//! The only place that knows all families of models: which one the options ask for, and how what it
//! gives becomes a fitted grain.

use super::blended::{self, Round, Settings, Target};
use super::candidate::{Candidate, Search, Work};
use super::context::{Context, Stage};
use super::error::FitError;
use super::estimate::{Estimate, estimate};
use super::mirrored;
use super::options::{FitOptions, Seams, Tolerance};
use super::outcome::{EstimateSummary, Fitted, KindChoice, Residuals};
use super::prepare::{PreparedScan, Sample};
use super::segments;
use super::sound;
use super::warning::FitWarning;
use crate::model::{Family, Frame, Grain, StarGrain, Stretch};
use crate::sphere::Symmetry;
use nalgebra::Vector3;
use rayon::prelude::*;

/// An expansion of the whole sphere with no more coefficients than this needs no cells: they would touch as many.
const FEW_COEFFICIENTS: usize = 64;

/// Difference from the estimate that is always good enough, as a share of the estimate's own standard deviation:
/// it adds 5 % to the error.
const GOOD_ENOUGH: f64 = 1.0 / 3.0;

impl PreparedScan<'_> {
    /// Fits the model that the options ask for.
    ///
    /// # Errors
    /// [`FitError`] if the options are out of range or ask for other mirror planes than the scan was
    /// prepared for, if the fit was cancelled, or if what was fitted is no body or far from the points.
    pub fn fit(&self, options: &FitOptions, context: &Context<'_>) -> Result<Fitted, FitError> {
        options.check()?;
        if options.symmetry != self.symmetry {
            return Err(FitError::OtherSymmetry);
        }
        let mut fitted = context.run(|| match options.seams {
            _ if options.symmetry != Symmetry::NONE => mirrored(self, options, context),
            Seams::None => independent(self, options, context),
            Seams::Blended => estimated(self, options, context),
        })?;
        fitted.warnings.extend(sound::check(&fitted, options)?);
        Ok(fitted)
    }

    /// What is known before any fit.
    fn fitted(
        &self,
        grain: StarGrain,
        search: Search,
        residuals: Residuals,
        points: usize,
    ) -> Fitted {
        Fitted {
            grain: Grain::from(grain).with_unseen(self.unseen),
            kind: KindChoice::Star,
            search,
            reference: self.reference,
            points,
            mean_radius: self.mean_radius,
            residuals,
            asymmetry: None,
            estimate: None,
            whole: None,
            warnings: self.warnings.clone(),
            posterior: None,
            errors: None,
        }
    }
}

/// Difference of mirror images, as a share of the mean radius, above which a scan is not symmetric.
const LARGEST_ASYMMETRY: f64 = 0.01;

fn mirrored(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let fit = mirrored::search(prepared, options, context)?;
    let grain = grain(
        prepared.frame(),
        Stretch::NONE,
        Family::Mirrored(fit.surface),
    );
    let mut fitted = prepared.fitted(grain, fit.search, fit.residuals, fit.points);
    fitted.warnings.extend(rejected(&fitted.search));
    let share = fit.asymmetry / prepared.mean_radius;
    if share > LARGEST_ASYMMETRY {
        fitted.warnings.push(FitWarning::Asymmetric { share });
    }
    fitted.asymmetry = Some(fit.asymmetry);
    Ok(fitted)
}

fn independent(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let fit = segments::search(prepared, options, context)?;
    let grain = grain(
        prepared.frame(),
        Stretch::NONE,
        Family::Segmented(fit.surface),
    );
    let mut fitted = prepared.fitted(grain, fit.search, fit.residuals, fit.points);
    fitted.warnings.extend(rejected(&fitted.search));
    Ok(fitted)
}

fn rejected(search: &Search) -> Option<FitWarning> {
    let choice = search.choice();
    Some(FitWarning::Rejected {
        reason: choice.rejected?,
        segments: choice.segments,
        is_only: search.candidates.len() == 1,
    })
}

/// Estimates the radius, then approximates the estimate.
fn estimated(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    context.enter(Stage::Estimating)?;
    let samples = prepared.sorted_samples();
    let estimate = estimate(samples.rows(), prepared.semi_axes, context)?;
    let tolerance = options.tolerance.length(prepared.mean_radius);
    let limit = tolerance.max(GOOD_ENOUGH * estimate.deviation());
    let stretch = estimate.stretch();
    let frame = prepared.frame();
    let whole = |degree: usize| grain(frame, stretch, Family::Whole(estimate.expansion(degree)));

    // The estimate itself, unless a tolerance asks for less of it.
    let own_limit = match options.tolerance {
        Tolerance::Auto => estimate.resolution(),
        _ => limit,
    };
    if options.segments == Some(1)
        && let Some(asked) = options.degree.filter(|&asked| asked > estimate.degree)
    {
        let reached = estimate.degree;
        return Err(FitError::DegreeOfEstimate { asked, reached });
    }
    let most = options.max_degree.unwrap_or(estimate.degree);
    let asked = (options.segments == Some(1)).then(|| {
        let least = || estimate.least_degree(own_limit).min(most);
        options.degree.unwrap_or_else(least)
    });
    let degree = asked.unwrap_or_else(|| estimate.least_degree(limit));
    let are_cells_too_many = options.segments.is_none() && options.most_segments() < 6;
    let degree = match are_cells_too_many {
        true => options
            .degree
            .unwrap_or(degree.min(most))
            .min(estimate.degree),
        false => degree,
    };
    let held_out = estimate.held_out();
    let near = |rms: f64, candidate: Candidate| Candidate {
        estimate_rms: Some(rms),
        heldout_rms: Some(rms.hypot(held_out)),
        ..candidate
    };
    let of_whole = Candidate::unfitted(degree, 1, (degree + 1).pow(2));
    let is_whole = asked.is_some()
        || are_cells_too_many
        || (options.segments.is_none()
            && options.degree.is_none()
            && degree <= most
            && (degree + 1).pow(2) <= FEW_COEFFICIENTS);
    let mut candidates = vec![near(estimate.truncation(degree), of_whole)];
    let mut work = Work::default();
    let mut warnings = Vec::new();
    let mut chosen = 0;
    let mut largest_difference = None;
    let (grain, rival) = match is_whole {
        true => (whole(degree), None),
        false => {
            context.enter(Stage::Searching { done: 0, all: None })?;
            let settings = Settings {
                degree: options.degree,
                max_degree: options.top_degree(),
                segments: options.segments,
                max_segments: options.most_segments(),
                limit,
            };
            let outcome =
                blended::approximate(&Plain(&estimate), &settings).ok_or(FitError::NoEstimate)?;
            let size: usize = outcome.surface.coefficients().iter().map(Vec::len).sum();
            let is_it = |round: &Round| round.coefficients == size;
            chosen = 1 + outcome.rounds.iter().rposition(is_it).unwrap_or(0);
            largest_difference = Some(outcome.max);
            work.candidates = outcome.rounds.len();
            work.segments = outcome.rounds.iter().map(|round| round.cells).sum();
            candidates.extend(outcome.rounds.iter().map(|round| {
                let size = Candidate::unfitted(round.degree, round.cells, round.coefficients);
                near(round.rms, size)
            }));
            if options.segments.is_none() && !outcome.met {
                warnings.push(FitWarning::LimitNotMet {
                    rms: outcome.rms,
                    limit,
                });
            }
            let cells = grain(frame, stretch, Family::Blended(outcome.surface));
            (cells, Some(whole(degree)))
        }
    };
    let search = Search {
        seams: Seams::Blended,
        chosen,
        candidates,
        limit: if asked.is_some() { own_limit } else { limit },
        noise: Some(estimate.noise()),
        work,
    };
    let residuals = residuals(&grain, samples.rows());
    let points = samples.rows().len() - estimate.outliers;
    let mut fitted = prepared.fitted(grain, search, residuals, points);
    fitted.whole = rival;
    fitted.warnings.extend(warnings);
    if estimate.outliers > 0 {
        fitted.warnings.push(FitWarning::Outliers {
            outliers: estimate.outliers,
        });
    }
    fitted.estimate = Some(EstimateSummary {
        degree: estimate.degree,
        deviation: estimate.deviation(),
        noise: estimate.noise(),
        slope: estimate.spectrum.slope(),
        outliers: estimate.outliers,
        largest_difference,
    });
    fitted.posterior = Some(Box::new(estimate));
    Ok(fitted)
}

/// The estimate in its stretched space, its errors weighed as those of the plain radius over all plain directions.
struct Plain<'a>(&'a Estimate);

impl Target for Plain<'_> {
    fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        self.0.stretched_radii(directions)
    }

    fn weight(&self, n: &Vector3<f64>) -> f64 {
        self.0.weight(n)
    }
}

fn grain(frame: &Frame, stretch: Stretch, family: Family) -> StarGrain {
    StarGrain::stretched(*frame, stretch, family).expect("the axes are orthonormal")
}

/// Samples whose residuals are found at once.
const CHUNK: usize = 1 << 15;

/// Residuals of all samples, in the grain's own frame.
fn residuals(grain: &StarGrain, samples: &[Sample]) -> Residuals {
    let of_chunk = |samples: &[Sample]| {
        let direction = |&[x, y, z, _]: &Sample| Vector3::new(x, y, z);
        let directions: Vec<_> = samples.iter().map(direction).collect();
        let mut radii = grain.local_radii(&directions);
        for (radius, sample) in radii.iter_mut().zip(samples) {
            *radius = sample[3] - *radius;
        }
        radii
    };
    let all: Vec<f64> = samples.par_chunks(CHUNK).flat_map_iter(of_chunk).collect();
    Residuals::of(all)
}
