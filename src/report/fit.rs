//! What `grainform fit` tells.

use super::escape::escaped;
use super::estimate::{EstimateRecord, EvaluationRecord};
use super::measure::{Dimensions, Principal, rows};
use super::number::{percent, short, with_error};
use super::rule::rule;
use super::unit::{Labels, Unit};
use super::warning::sentences;
use crate::fit::{
    FitOptions, Fitted, NoInterval, Reference, ReferenceKind, StandardErrors, Tolerance,
};
use crate::measure::{dimensions_of_surface, grain_properties};
use crate::model::Mirrored;
use crate::scan::plural;
use crate::sphere::Symmetry;
use serde::Serialize;
use std::fmt;

/// The result of a fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitReport {
    /// The scan.
    pub input: String,
    /// Unit of lengths, where it was told; areas and volumes are in its square and cube.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// Degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments.
    pub segments: usize,
    /// Axes of the scan normal to the mirror planes; left out without these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<Symmetry>,
    /// Root mean square difference of the radius between mirror images of the scan; left out likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asymmetry: Option<f64>,
    /// Coefficients that the model holds: (degree + 1)^2 per segment, fewer where a segment was
    /// reduced.
    pub coefficients: usize,
    /// Area of the fitted surface, integrated exactly.
    pub area: f64,
    /// Volume of the fitted surface, integrated exactly.
    pub volume: f64,
    /// Principal moments of inertia and their axes; `null` where the inertia is not finite.
    pub principal: Option<Principal>,
    /// Extents of the fitted surface along the principal axes, descending; `null` without these.
    pub dimensions: Option<Dimensions>,
    /// Standard errors of the figures above; `null` where none can be trusted.
    pub standard_errors: Option<StandardErrorsRecord>,
    /// Why there are none: half a sentence.
    pub no_standard_errors: Option<String>,
    /// Coefficients that one evaluation of the surface touches, as a mean over all directions.
    pub coefficients_touched: f64,
    /// What the fit is compared with.
    pub reference: ReferenceRecord,
    /// `area` against the reference.
    pub area_error: f64,
    /// `volume` against the reference.
    pub volume_error: f64,
    /// Root mean square of the radial residuals of all points.
    pub rms: f64,
    /// Largest absolute radial residual.
    pub max: f64,
    /// Root mean square of the radial errors of points that were left out of the fit one by one.
    pub heldout_rms: Option<f64>,
    /// Mean radius over all directions.
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
    /// Standard deviation of the points' noise; `null` where it was not estimated.
    pub noise: Option<f64>,
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

/// Standard errors (one standard deviation) of a fitted grain's figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StandardErrorsRecord {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
    /// Of the principal moments.
    pub moments: [f64; 3],
    /// Of the dimensions.
    pub dimensions: Dimensions,
    /// What noise adds to the dimensions, as a mean: an extent is between the points farthest out.
    pub dimensions_excess: Dimensions,
    /// Of the centroid's coordinates along the grain's axes.
    pub centroid: [f64; 3],
    /// Of the inertia tensor about the centroid, along the grain's axes.
    pub inertia: [[f64; 3]; 3],
}

/// The surface that a fit is compared with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReferenceRecord {
    /// "faces" (the scan's own) or "directions" (triangulated between the points).
    pub kind: &'static str,
    /// Its area.
    pub area: f64,
    /// Its volume.
    pub volume: f64,
}

/// Wall-clock seconds of the stages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
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
pub struct Skipped {
    /// Candidates not fitted.
    pub candidates: usize,
    /// Segments not fitted.
    pub segments: usize,
}

impl FitReport {
    /// The report of a fit, for the options it was made with; `scan_warnings` are the reader's.
    pub fn new(
        input: String,
        unit: Option<Unit>,
        fitted: &Fitted,
        options: &FitOptions,
        scan_warnings: &[String],
    ) -> Self {
        let search = &fitted.search;
        let mirrored = fitted.grain.surface().mirrored();
        let choice = search.choice();
        let properties = grain_properties(&fitted.grain).properties;
        let principal = properties.principal();
        let extents = principal.map(|principal| {
            let (grain, centre) = (&fitted.grain, fitted.grain.frame().centre);
            let mesh = grain.mesh(MESH_RESOLUTION);
            dimensions_of_surface(grain, &centre, &mesh, &principal.axes)
        });
        let (standard_errors, no_errors) = match extents {
            None => (None, Some(NoInterval::NotFinite)),
            Some(extents) => match fitted.standard_errors(&properties, &extents) {
                Ok(errors) => (Some(errors), None),
                Err(reason) => (None, Some(reason)),
            },
        };
        Self {
            input,
            unit,
            points: fitted.points,
            degree: mirrored.map_or(choice.degree, Mirrored::degree),
            segments: choice.segments,
            symmetry: mirrored.map(Mirrored::symmetry),
            asymmetry: fitted.asymmetry,
            coefficients: fitted.grain.coefficient_count(),
            area: properties.area,
            volume: properties.volume,
            principal: principal.map(|principal| Principal::new(&principal)),
            dimensions: extents.map(Dimensions::new),
            standard_errors: standard_errors.map(Into::into),
            no_standard_errors: no_errors.map(|reason| reason.to_string()),
            coefficients_touched: fitted.grain.coefficients_touched(),
            area_error: properties.area / fitted.reference.area - 1.0,
            volume_error: properties.volume / fitted.reference.volume - 1.0,
            reference: fitted.reference.into(),
            rms: fitted.residuals.rms,
            max: fitted.residuals.max,
            heldout_rms: choice.heldout_rms,
            mean_radius: fitted.mean_radius,
            estimate: fitted.estimate.map(Into::into),
            estimate_rms: choice.estimate_rms,
            evaluation: EvaluationRecord::new(&fitted.grain),
            whole: fitted.whole.as_ref().map(EvaluationRecord::new),
            noise: search.noise,
            limit: search.limit,
            tolerance: (options.tolerance != Tolerance::Auto)
                .then(|| options.tolerance.length(fitted.mean_radius)),
            rule: rule(fitted, options, unit),
            seam_jump: fitted.grain.seam_jump(),
            reduced_segments: choice.reduced_segments,
            harmonics_loss: None,
            seconds: Seconds::default(),
            skipped: Skipped {
                candidates: search.work.candidates_skipped,
                segments: search.work.segments_skipped,
            },
            warnings: sentences(scan_warnings, &fitted.warnings),
        }
    }
}

/// Cells per edge of the cube of directions from which the search for the grain's dimensions starts.
const MESH_RESOLUTION: usize = 64;

impl From<StandardErrors> for StandardErrorsRecord {
    fn from(errors: StandardErrors) -> Self {
        Self {
            area: errors.area,
            volume: errors.volume,
            moments: errors.moments.into(),
            dimensions: Dimensions::new(errors.dimensions),
            dimensions_excess: Dimensions::new(errors.dimensions_excess),
            centroid: errors.centroid.into(),
            inertia: rows(&errors.inertia),
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

impl ReferenceRecord {
    /// What it is, in words.
    fn description(&self) -> &'static str {
        if self.kind == ReferenceKind::Faces.name() {
            "the scan's own faces"
        } else {
            "the points, triangulated by direction"
        }
    }
}

impl fmt::Display for FitReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        let mm = labels.length();
        let share = |length: f64| {
            let share = 100.0 * length / self.mean_radius;
            match share.abs() {
                0.0 | 0.001.. => format!("{share:.3}"),
                _ => format!("{share:.1e}"),
            }
        };
        let of_radius = |length: f64| {
            format!(
                "{}{mm} ({} % of the mean radius)",
                short(length),
                share(length)
            )
        };
        let against =
            |error: f64, reference: f64| format!("{} against {}", percent(error), short(reference));
        let (area, volume) = (labels.area(), labels.volume());
        let heldout = self.heldout_rms.map_or("unknown".into(), of_radius);
        let points = plural(self.points, "point");
        writeln!(f, "scan          {}, {points}", escaped(&self.input))?;
        write!(f, "model         degree {}, ", self.degree)?;
        match self.symmetry {
            Some(symmetry) => writeln!(
                f,
                "{} on {}",
                plural(self.coefficients, "coefficient"),
                mirroring(symmetry)
            )?,
            None if self.segments == 1 => {
                writeln!(f, "the whole sphere, {}", self.evaluation)?;
            }
            None => {
                let segments = plural(self.segments, "segment");
                writeln!(f, "{segments}, {}", self.evaluation)?;
            }
        }
        if let Some(whole) = &self.whole {
            writeln!(f, "              as one expansion: {whole}")?;
        }
        writeln!(f, "chosen for    {}", self.rule)?;
        if let Some(tolerance) = self.tolerance {
            writeln!(
                f,
                "tolerance     {}{}, {} % of the mean radius",
                short(tolerance),
                self.unit
                    .map_or(" in the scan's unit".into(), |_| labels.length()),
                share(tolerance)
            )?;
        }
        if let Some(estimate) = &self.estimate {
            writeln!(
                f,
                "estimate      degree {}, known to {}",
                estimate.degree,
                of_radius(estimate.deviation)
            )?;
        }
        if let Some(rms) = self.estimate_rms {
            writeln!(f, "difference    RMS {} from the estimate", of_radius(rms))?;
            if let Some(largest) = self.estimate.and_then(|e| e.largest_difference) {
                writeln!(f, "              largest {}", of_radius(largest))?;
            }
        }
        writeln!(f, "reference     {}", self.reference.description())?;
        writeln!(
            f,
            "area          {}{area}, {}{area}",
            with_error(
                self.area,
                self.standard_errors.as_ref().map(|errors| errors.area)
            ),
            against(self.area_error, self.reference.area)
        )?;
        writeln!(
            f,
            "volume        {}{volume}, {}{volume}",
            with_error(
                self.volume,
                self.standard_errors.as_ref().map(|errors| errors.volume)
            ),
            against(self.volume_error, self.reference.volume)
        )?;
        if let Some(dimensions) = &self.dimensions {
            let errors = self
                .standard_errors
                .as_ref()
                .map(|errors| &errors.dimensions);
            writeln!(
                f,
                "size          {} x {} x {}{mm}",
                with_error(dimensions.length, errors.map(|errors| errors.length)),
                with_error(dimensions.width, errors.map(|errors| errors.width)),
                with_error(dimensions.thickness, errors.map(|errors| errors.thickness)),
            )?;
        }
        writeln!(f, "held-out RMS  {heldout}")?;
        writeln!(f, "residuals     RMS {}", of_radius(self.rms))?;
        writeln!(f, "              largest {}", of_radius(self.max))?;
        if self.seam_jump > 0.0 {
            writeln!(f, "seam jump     largest {}", of_radius(self.seam_jump))?;
        }
        if let Some(asymmetry) = self.asymmetry {
            writeln!(f, "asymmetry     RMS {}", of_radius(asymmetry))?;
        }
        if let Some(noise) = self.noise {
            writeln!(f, "noise         {}", of_radius(noise))?;
        }
        writeln!(f, "mean radius   {}{mm}", short(self.mean_radius))?;
        if self.reduced_segments > 0 {
            let (count, s) = match self.reduced_segments {
                1 => (plural(1, "segment"), "s"),
                count => (plural(count, "segment"), ""),
            };
            writeln!(
                f,
                "reduced       {count} need{s} no higher degree, or hold{s} too few points for it"
            )?;
        }
        if let Some(loss) = self.harmonics_loss {
            writeln!(f, "harmonics     converted with a loss of {loss:.1e}{mm}")?;
        }
        if self.standard_errors.is_some() {
            writeln!(f, "Figures after ± are standard errors.")?;
        }
        if let Some(reason) = &self.no_standard_errors {
            writeln!(f, "No standard errors: {reason}.")?;
        }
        write!(f, "Lengths are in {}.", labels.name())
    }
}

/// What the expansion covers, and along which axes it is mirrored.
fn mirroring(symmetry: Symmetry) -> String {
    let part = match symmetry.images() {
        1 => "the whole sphere",
        2 => "one half",
        4 => "one quarter",
        _ => "one octant",
    };
    let names = symmetry.names();
    let axes = match names.as_slice() {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        names => names.concat(),
    };
    format!("{part}, mirrored along {axes}")
}
