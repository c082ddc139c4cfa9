//! From a scan to a fitted grain: centre and axes, estimate, segments.
//!
//! ```no_run
//! use grainform::{FitOptions, fit, scan::read_scan};
//!
//! let scan = read_scan("grains/maize.ply".as_ref())?;
//! let fitted = fit(&scan, &FitOptions::default())?;
//! println!("{} coefficients", fitted.grain.coefficient_count());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blended;
mod candidate;
mod context;
mod crust;
mod dispatch;
mod error;
mod estimate;
mod estimated;
mod holes;
mod kind;
mod linear;
mod mirrored;
mod options;
mod outcome;
mod points;
mod position;
mod positioned;
mod prepare;
mod rippled;
mod segments;
mod superquadric;
mod warning;

pub use candidate::{Candidate, Rejection, Search, Work};
pub use context::{Context, Stage};
pub use error::FitError;
pub use estimate::RadiusError;
pub use kind::choice::{KindChoice, Rival};
pub use kind::fit_scan;
pub(crate) use kind::misfit::LARGEST_OF_NOISE;
pub use mirrored::{DirectedSample, MirroredFitError, fit_mirrored};
pub use options::{
    FitOptions, Kind, MAX_CELLS, MAX_COEFFICIENTS, MAX_DEGREE, MAX_PARTS, MAX_WHOLE_DEGREE, Seams,
    Tolerance,
};
pub use outcome::{EstimateSummary, Fitted, Residuals};
pub use position::{Distance, PositionFit, fit_position, map::MapError};
#[cfg(feature = "cli")]
pub(crate) use prepare::whole_or_largest;
pub use prepare::{
    PreparedScan, Reference, ReferenceKind, ScannedSurface, largest_body, scanned_surface,
};
pub use superquadric::{
    AtBound, Form, MAX_UNION_PARTS, MultiFit, ParameterErrors, SolidErrors, SuperquadricFit,
    SuperquadricFitError, fit_multi_superquadric, fit_superquadric,
};
pub use warning::FitWarning;

use crate::scan::Scan;

/// Fits a grain to a scan, as [`fit_scan`] does, on the caller's threads.
///
/// # Errors
/// [`FitError`] if the options are out of range or the scan is not one closed surface.
pub fn fit(scan: &Scan, options: &FitOptions) -> Result<Fitted, FitError> {
    fit_scan(scan, options, &Context::default())
}
