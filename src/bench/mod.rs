//! Run time against error: every family of models over a grid of settings, on the same scans.
//!
//! Times are the processor's, so that they hold on a machine that does other things too, and the least of a few
//! runs; threads are those of the caller's pool: `grainform bench` takes one. A fit is [`PreparedScan::fit`] of one
//! setting, all of it. Preparing (reference surface, centre, axes) is timed apart, because it is done once for a scan.
//!
//! Beside them, where asked for and python3 has it, stands ducc0, which fits an expansion of the whole sphere by an
//! iterative solver with a non-uniform fast transform. Then a tenth of the points is hidden from all fits and judges
//! them.
//!
//! [`PreparedScan::fit`]: crate::fit::PreparedScan::fit

mod axis;
mod csv;
mod front;
mod marker;
mod plot;
mod rivals;
mod run;
mod setting;
mod subject;
mod timing;

pub use csv::write_csv;
pub use front::{Cost, front};
pub use plot::{PlotError, plot};
pub use rivals::{RivalError, find_rivals};
pub use run::{BenchError, measure, run};
pub use setting::{Asked, Family, Setting, asked};
pub use subject::{NOISE, Subject, Truth, synthetic};

use crate::digits::plural;
use crate::report::{Unit, escaped};
use serde::Serialize;

/// The rows of several scans.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchReport {
    /// Unit of the scans' lengths, where it was told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// One entry per scan.
    pub scans: Vec<BenchScan>,
}

/// The settings fitted to one scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchScan {
    /// Name of the body, or the scan's file.
    pub scan: String,
    /// Points that were fitted.
    pub points: usize,
    /// Points that were hidden, by which fits are judged: none without rivals.
    pub hidden: usize,
    /// Standard deviation of the radial noise, as a share of the mean radius; `None` if unknown.
    pub noise: Option<f64>,
    /// What area and volume are compared with: "truth" (the closed form), or the polyhedron of the scan, which is itself off:
    /// "faces", "voxels", "directions" or "crust".
    pub reference: &'static str,
    /// Settings left out: more coefficients than half of the points.
    pub skipped: usize,
    /// Settings whose fits are no bodies, or far from the points.
    pub refused: usize,
    /// The settings fitted, family by family.
    pub rows: Vec<BenchRow>,
}

impl BenchScan {
    /// What was fitted: `maize: 6146 points, noise 0.5 % of the mean radius`.
    pub fn title(&self) -> String {
        let noise = match self.noise {
            None => String::new(),
            Some(0.0) => ", clean".into(),
            Some(noise) => format!(", noise {} % of the mean radius", 100.0 * noise),
        };
        format!(
            "{}: {}{noise}",
            escaped(&self.scan),
            plural(self.points, "point")
        )
    }
}

/// One setting, fitted. Shares are of the mean radius.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchRow {
    /// The family of models.
    pub family: Family,
    /// Degree of the expansions, where the family fixes it.
    pub degree: Option<usize>,
    /// Segments of the model.
    pub segments: usize,
    /// RMS error asked for, as a share, where the family asks for one.
    pub tolerance: Option<f64>,
    /// Coefficients that the model holds.
    pub coefficients: usize,
    /// Coefficients touched to evaluate one radius: the mean over all directions.
    pub touched: f64,
    /// Seconds of the processor for the fit alone: the least of a few runs.
    pub seconds: f64,
    /// The most of these.
    pub seconds_most: f64,
    /// Seconds of preparing the scan for it.
    pub seconds_prepare: f64,
    /// Nanoseconds of one evaluation, each in another random direction.
    pub nanoseconds: f64,
    /// Nanoseconds of one of 131 072 evaluations in random directions that are asked for at once; told beside rivals.
    pub nanoseconds_bulk: Option<f64>,
    /// Root mean square of the radial leave-one-out errors, in the scan's unit; of superquadrics what generalised
    /// cross-validation says of it.
    pub heldout_rms: Option<f64>,
    /// `heldout_rms` as a share.
    pub heldout_share: Option<f64>,
    /// Root mean square of the distance to points that were hidden, radial where there is a radius, as a share.
    pub hidden_share: Option<f64>,
    /// Area against the reference: signed, relative.
    pub area_error: f64,
    /// Volume against the reference: signed, relative.
    pub volume_error: f64,
    /// Root mean square of the radial distance to the closed form, as a share; `None` without one.
    pub rms_error: Option<f64>,
    /// The largest jump of the radius between neighbouring segments, as a share.
    pub seam_jump: f64,
    /// Why the search would not choose it, if so.
    pub rejected: Option<String>,
}

impl BenchRow {
    /// What it is judged by, as a share: the RMS distance to hidden points where there are any, else the held-out RMS;
    /// not a number if neither is known.
    pub fn error(&self) -> f64 {
        let share = self.hidden_share.or(self.heldout_share);
        share.unwrap_or(f64::NAN)
    }
}
