//! What `grainform fit` tells.

use super::number::{percent, short};
use super::rule::rule;
use crate::fit::{FitOptions, Fitted, Reference, ReferenceKind};
use crate::measure::grain_properties;
use serde::Serialize;
use std::fmt;

/// The result of a fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitReport {
    /// The scan.
    pub input: String,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// Degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments.
    pub segments: usize,
    /// Coefficients that the model holds: (degree + 1)^2 per segment, fewer where a segment was
    /// reduced.
    pub coefficients: usize,
    /// Area of the fitted surface, integrated exactly.
    pub area: f64,
    /// Volume of the fitted surface, integrated exactly.
    pub volume: f64,
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
    /// Standard deviation of the points round a local fit; 0 where nothing was searched.
    pub noise: f64,
    /// The held-out RMS that was good enough.
    pub limit: f64,
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
        fitted: &Fitted,
        options: &FitOptions,
        scan_warnings: &[String],
    ) -> Self {
        let search = &fitted.search;
        let choice = search.choice();
        let properties = grain_properties(&fitted.grain).properties;
        Self {
            input,
            points: fitted.points,
            degree: choice.degree,
            segments: choice.segments,
            coefficients: fitted.grain.coefficient_count(),
            area: properties.area,
            volume: properties.volume,
            area_error: properties.area / fitted.reference.area - 1.0,
            volume_error: properties.volume / fitted.reference.volume - 1.0,
            reference: fitted.reference.into(),
            rms: fitted.residuals.rms,
            max: fitted.residuals.max,
            heldout_rms: choice.heldout_rms,
            mean_radius: fitted.mean_radius,
            noise: search.noise,
            limit: search.limit,
            rule: rule(fitted, options),
            seam_jump: fitted.grain.seam_jump(),
            reduced_segments: choice.reduced_segments,
            harmonics_loss: None,
            seconds: Seconds::default(),
            skipped: Skipped {
                candidates: search.work.candidates_skipped,
                segments: search.work.segments_skipped,
            },
            warnings: [scan_warnings, &fitted.warnings].concat(),
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
        let of_radius = |length: f64| {
            let share = 100.0 * length / self.mean_radius;
            format!("{} ({share:.3} % of the mean radius)", short(length))
        };
        let against =
            |error: f64, reference: f64| format!("{} against {}", percent(error), short(reference));
        let heldout = self.heldout_rms.map_or("unknown".into(), of_radius);
        writeln!(f, "scan          {}, {} points", self.input, self.points)?;
        writeln!(
            f,
            "model         degree {}, {} segments, {} coefficients",
            self.degree, self.segments, self.coefficients
        )?;
        writeln!(f, "chosen for    {}", self.rule)?;
        writeln!(f, "reference     {}", self.reference.description())?;
        writeln!(
            f,
            "area          {}, {}",
            short(self.area),
            against(self.area_error, self.reference.area)
        )?;
        writeln!(
            f,
            "volume        {}, {}",
            short(self.volume),
            against(self.volume_error, self.reference.volume)
        )?;
        writeln!(f, "held-out RMS  {heldout}")?;
        writeln!(f, "residuals     RMS {}", of_radius(self.rms))?;
        writeln!(f, "              largest {}", of_radius(self.max))?;
        writeln!(f, "seam jump     largest {}", of_radius(self.seam_jump))?;
        writeln!(f, "mean radius   {}", short(self.mean_radius))?;
        if self.reduced_segments > 0 {
            writeln!(
                f,
                "reduced       {} segments hold too few points and have a lower degree",
                self.reduced_segments
            )?;
        }
        if let Some(loss) = self.harmonics_loss {
            writeln!(f, "harmonics     converted with a loss of {loss:.1e}")?;
        }
        write!(f, "Lengths are in the scan's unit.")
    }
}
