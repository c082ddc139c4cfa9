//! From a scan to a fitted grain: centre and axes, least squares, search.
//!
//! ```no_run
//! use grainform::{FitOptions, fit, scan::read_scan};
//!
//! let scan = read_scan("grains/maize.ply".as_ref())?;
//! let fitted = fit(&scan, &FitOptions::default())?;
//! println!("{} coefficients", fitted.grain.coefficient_count());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axes;
#[cfg_attr(
    not(test),
    expect(
        dead_code,
        reason = "the fit to an estimate is its only user, and to come"
    )
)]
mod blended;
mod centre;
mod factor;
mod held_out;
mod householder;
mod joint;
mod level;
mod mirrored;
mod options;
mod prepare;
mod reduce;
mod reference;
mod row;
mod samples;
mod search;
mod segment;
mod spread;
mod strays;
mod surface;
mod thin;

pub use mirrored::{DirectedSample, MirroredFitError, fit_mirrored};
pub use options::{
    FitError, FitOptions, MAX_CELLS, MAX_COEFFICIENTS, MAX_DEGREE, MAX_PARTS, Seams, Tolerance,
};
pub use prepare::PreparedScan;
pub use reference::{Reference, ReferenceKind};
pub use search::{Candidate, Rejection, Search, Work};
pub use spread::StandardErrors;
pub use surface::{ScannedSurface, scanned_surface};

use crate::model::Grain;
use crate::scan::Scan;
use spread::Spread;

/// A fitted grain and what is known of it.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The grain, in the scan's frame and unit.
    pub grain: Grain,
    /// The candidates, the choice and the work done.
    pub search: Search,
    /// What the candidates were compared with.
    pub reference: Reference,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// Mean of the radius over all directions, in the scan's unit.
    pub mean_radius: f64,
    /// Radial residuals of all points the fit rests on.
    pub residuals: Residuals,
    /// Root mean square difference of the radius between mirror images, as far as expansions of degree
    /// 3 follow it, in the scan's unit. `None` of a fit without mirrors.
    pub asymmetry: Option<f64>,
    /// What a user should know of the scan: whole sentences.
    pub warnings: Vec<String>,
    spread: Option<Spread>,
}

impl Fitted {
    /// Standard errors of the grain's area, volume, inertia and dimensions, from the covariance of
    /// its coefficients. Drawn when asked for: some milliseconds. `None` of independent segments,
    /// whose seams no covariance describes.
    pub fn standard_errors(&self) -> Option<StandardErrors> {
        let surface = self.grain.surface().blended()?;
        self.spread.as_ref()?.standard_errors(surface)
    }
}

/// Radial residuals: radius of the point minus radius of the grain in its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residuals {
    /// Root mean square, in the scan's unit.
    pub rms: f64,
    /// Largest absolute value, in the scan's unit.
    pub max: f64,
}

/// Fits a grain to a scan: [`PreparedScan::new`], [`PreparedScan::search`] and
/// [`PreparedScan::finish`] in one.
///
/// # Errors
/// [`FitError`] if the options are out of range or the scan is not one closed surface round a
/// centre.
pub fn fit(scan: &Scan, options: &FitOptions) -> Result<Fitted, FitError> {
    let prepared = PreparedScan::new(scan, options)?;
    let found = prepared.search(&|_| ());
    Ok(prepared.finish(found))
}
