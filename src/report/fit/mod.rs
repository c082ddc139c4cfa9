//! What `grainform fit` tells.

mod text;

#[cfg(feature = "cli")]
pub(crate) use text::described_reference;

use super::estimate::{EstimateRecord, EvaluationRecord};
use super::measure::{Dimensions, Measure, MeasureReport, NotMeasured, Principal, Withheld};
use super::rule::{kind_rule, rule};
use super::scan::ReportedScan;
use super::standard_errors::{StandardErrorsRecord, recorded};
use super::warning::sentences;
use crate::fit::{FitOptions, Fitted, LARGEST_OF_NOISE, Reference, Tolerance};
use crate::measure::Survey;
use crate::model::{Grain, NoStandardErrors, StarGrain};
use crate::sphere::Symmetry;
use crate::unit::Unit;
use serde::Serialize;

/// The figures of the grain that are told.
const FIGURES: [Measure; 4] = [
    Measure::Area,
    Measure::Volume,
    Measure::Principal,
    Measure::Dimensions,
];

/// Share of the mean radius up to which noise is not told from none: no search goes below 3e-6.
const LEAST_NOISE: f64 = 3.5e-6;

/// The result of a fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct FitReport {
    /// The scan.
    pub input: String,
    /// Unit of lengths, where it was told; areas and volumes are in its square and cube.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// "star" (a radius in every direction from a centre) or "position" (the position of points over the sphere).
    pub surface: &'static str,
    /// Why it is of this kind: half a sentence; left out of a radius that follows the scan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_rule: Option<String>,
    /// Largest degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments.
    pub segments: usize,
    /// Axes of the scan normal to the mirror planes; left out without these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<Symmetry>,
    /// Root mean square difference of the radius between mirror images of the scan; left out likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asymmetry: Option<f64>,
    /// Coefficients that the model holds.
    pub coefficients: usize,
    /// Area of the fitted surface, integrated exactly; `null`, as the next three, where it is in `not_measured`.
    pub area: Option<f64>,
    /// Volume of the fitted surface, integrated exactly.
    pub volume: Option<f64>,
    /// Principal moments of inertia and their axes.
    pub principal: Option<Principal>,
    /// Extents of the fitted surface along the principal axes, descending.
    pub dimensions: Option<Dimensions>,
    /// Figures that cannot be told: those of what was not seen, unless asked for, those that no number holds, and area
    /// and volume more than 5 % off those of the polyhedron through the points, where no standard error vouches for
    /// them, with what rests on them.
    pub not_measured: Vec<NotMeasured>,
    /// Standard errors of the figures above; `null` where none can be trusted.
    pub standard_errors: Option<StandardErrorsRecord>,
    /// Why there are none: half a sentence.
    pub no_standard_errors: Option<String>,
    /// Coefficients that one evaluation of the surface touches, as a mean over all directions.
    pub coefficients_touched: f64,
    /// What the fit is compared with; `null` where much of the surface was not seen.
    pub reference: Option<ReferenceRecord>,
    /// Area of the surface over that of the reference, which is itself off, less one; told also where `area` is not.
    pub area_error: Option<f64>,
    /// The same of the volume.
    pub volume_error: Option<f64>,
    /// Root mean square of the residuals of all points: along rays, of positions along normals.
    pub rms: f64,
    /// Largest absolute residual, likewise.
    pub max: f64,
    /// Root mean square error of points that were left out of the fit one by one: along rays, of positions along normals.
    pub heldout_rms: Option<f64>,
    /// Mean radius over all directions; of positions the radius of the ball of equal volume.
    pub mean_radius: f64,
    /// What the points say of the radius, before it is cut in segments; `null` of independent segments and mirrored
    /// fits, which are fitted to the points themselves.
    pub estimate: Option<EstimateRecord>,
    /// Root mean square difference of the model's radius from the estimate, over all directions; `null` likewise.
    pub estimate_rms: Option<f64>,
    /// What an evaluation of the model costs.
    pub evaluation: EvaluationRecord,
    /// What an evaluation costs of the expansion of the whole sphere that is as near to the estimate; `null` where the
    /// model has no cells.
    pub whole: Option<EvaluationRecord>,
    /// Standard deviation of the points' noise; `null` where it was not estimated, or not told apart from edges.
    pub noise: Option<f64>,
    /// Whether there is at most as much noise: where the largest residual is more than six times their RMS, for part of it is
    /// then shape, and up to some 3e-6 of the mean radius, which is not told from none.
    pub noise_is_bound: bool,
    /// The error that was good enough: the difference from the estimate, or the held-out RMS of independent segments and
    /// mirrored fits.
    pub limit: f64,
    /// The tolerance asked for; left out where it is that of the default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Why this degree and number of segments: half a sentence.
    pub rule: String,
    /// The largest jump of the radius between neighbouring segments.
    pub seam_jump: f64,
    /// Segments fitted at a lower degree because they hold too few points.
    pub reduced_segments: usize,
    /// The largest loss of the conversion to published coefficients, where these were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub harmonics_loss: Option<f64>,
    /// Wall-clock time.
    pub seconds: Seconds,
    /// What the search could leave out.
    pub skipped: Skipped,
    /// What is odd about the scan or the fit: whole sentences.
    pub warnings: Vec<String>,
}

/// The surface that a fit is compared with.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ReferenceRecord {
    /// "faces" (the scan's own), "voxels" (those of a segmented volume), "directions" (triangulated between the points) or
    /// "crust" (through a crust of voxels around them).
    pub kind: &'static str,
    /// Its area.
    pub area: f64,
    /// Its volume.
    pub volume: f64,
}

/// Wall-clock seconds of the stages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Seconds {
    /// Reading the scan.
    pub read: f64,
    /// Reference surface, centre, axes, and the fits of all candidates.
    pub search: f64,
    /// Meshing and writing files.
    pub mesh: f64,
    /// Everything.
    pub total: f64,
}

/// Work that could not change the choice.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Skipped {
    /// Candidates not fitted.
    pub candidates: usize,
    /// Segments not fitted.
    pub segments: usize,
}

impl FitReport {
    /// The report of a fit, for the options it was made with. Where much of the surface was not seen, figures of the whole are
    /// withheld.
    pub fn new(scan: ReportedScan, fitted: &Fitted, options: &FitOptions) -> Self {
        let withheld = Withheld::of(&fitted.grain, false);
        Self::with_survey(scan, fitted, &fitted.survey(), options, &withheld)
    }

    /// The same with these figures, as guesses with the errors of guesses.
    pub fn extrapolated(scan: ReportedScan, fitted: &Fitted, options: &FitOptions) -> Self {
        let withheld = Withheld::of(&fitted.grain, true);
        Self::with_survey(scan, fitted, &fitted.survey(), options, &withheld)
    }

    /// The same with the time of one evaluation of the fitted grain, and of the whole sphere where there are both, in nanoseconds.
    #[must_use]
    pub fn timed(mut self, fitted: &Fitted, nanoseconds: impl Fn(&Grain) -> f64) -> Self {
        self.evaluation.nanoseconds = Some(nanoseconds(&fitted.grain));
        if let (Some(record), Some(whole)) = (&mut self.whole, &fitted.whole) {
            record.nanoseconds = Some(nanoseconds(&whole.clone().into()));
        }
        self
    }

    /// The same with a survey of the fitted grain, of which more may be asked (what is measured is measured once), and with what
    /// is not to be told of it.
    pub(crate) fn with_survey(
        scan: ReportedScan,
        fitted: &Fitted,
        survey: &Survey,
        options: &FitOptions,
        withheld: &Withheld,
    ) -> Self {
        let ReportedScan {
            input,
            unit,
            warnings,
        } = scan;
        let search = &fitted.search;
        let symmetry = Some(fitted.grain.symmetry()).filter(|mirrors| *mirrors != Symmetry::NONE);
        let choice = search.choice();
        let told = MeasureReport::of_model(String::new(), survey, &FIGURES, withheld);
        let figures = told.measures;
        let errors = (figures.may_have_errors()).then(|| fitted.standard_errors(survey));
        let (standard_errors, no_standard_errors) = recorded(errors, &survey.axes());
        let is_noise = !matches!(errors, Some(Err(NoStandardErrors::Unresolved { .. })));
        let noise = search.noise.filter(|_| is_noise);
        let evaluation = EvaluationRecord::new(&fitted.grain);
        let reference = fitted.grain.unseen().is_none().then_some(fitted.reference);
        let beside = |found: Option<f64>, of: fn(&Reference) -> f64| {
            Some(found? / of(reference.as_ref()?) - 1.0)
        };
        Self {
            input,
            unit,
            points: fitted.points,
            surface: fitted.grain.star().map_or("position", |_| "star"),
            surface_rule: kind_rule(fitted, unit),
            degree: symmetry.map_or(choice.degree, |_| fitted.grain.degree()),
            segments: choice.segments,
            symmetry,
            asymmetry: fitted.asymmetry,
            coefficients: fitted.grain.coefficient_count(),
            area: figures.area,
            volume: figures.volume,
            principal: figures.principal,
            dimensions: figures.dimensions,
            not_measured: told.not_measured,
            standard_errors,
            no_standard_errors,
            coefficients_touched: evaluation.touched,
            area_error: beside(survey.area().ok(), |reference| reference.area),
            volume_error: beside(survey.volume().ok(), |reference| reference.volume),
            reference: reference.map(Into::into),
            rms: fitted.residuals.rms,
            max: fitted.residuals.max,
            heldout_rms: choice.heldout_rms,
            mean_radius: fitted.mean_radius,
            estimate: fitted.estimate.map(Into::into),
            estimate_rms: choice.estimate_rms,
            evaluation,
            whole: fitted
                .whole
                .clone()
                .map(|whole| EvaluationRecord::new(&whole.into())),
            noise,
            noise_is_bound: noise.is_some_and(|noise| is_bound(noise, fitted)),
            limit: search.limit,
            tolerance: (options.tolerance != Tolerance::Auto).then_some(search.tolerance),
            rule: rule(fitted, options, unit),
            seam_jump: fitted.grain.star().map_or(0.0, StarGrain::seam_jump),
            reduced_segments: choice.reduced_segments,
            harmonics_loss: None,
            seconds: Seconds::default(),
            skipped: Skipped {
                candidates: search.work.candidates_skipped,
                segments: search.work.segments_skipped,
            },
            warnings: sentences(&warnings, &fitted.warnings, unit),
        }
    }
}

impl From<Reference> for ReferenceRecord {
    fn from(reference: Reference) -> Self {
        Self {
            kind: reference.kind.name(),
            area: reference.area,
            volume: reference.volume,
        }
    }
}

/// Whether there is at most so much noise: a model with few coefficients leaves more than it.
fn is_bound(noise: f64, fitted: &Fitted) -> bool {
    noise <= LEAST_NOISE * fitted.mean_radius
        || fitted.residuals.max > LARGEST_OF_NOISE * fitted.residuals.rms.min(noise)
}
