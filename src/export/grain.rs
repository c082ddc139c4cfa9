//! Saving a grain.

use super::{SaveError, write_atomically};
use crate::model::{Grain, grain_to_json};
use std::path::Path;

/// Saves a grain as JSON, which [`load_grain`](crate::model::load_grain) reads exactly.
///
/// ```
/// use grainform::nalgebra::Vector3;
/// use grainform::scan::Scan;
/// use grainform::shapes::{Body, SynthOptions, synthesize};
/// use grainform::{FitOptions, Surface, fit, load_grain, save_grain};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("sphere.json");
/// let points = synthesize(&SynthOptions::clean(Body::Sphere).with_points(386))?.points;
/// let grain = fit(&Scan::from_points(points), &FitOptions::default())?.grain;
/// save_grain(&path, &grain)?;
/// let loaded = load_grain(&path)?;
/// assert_eq!(loaded.place(&Vector3::x()), grain.place(&Vector3::x()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`SaveError`]; then nothing was written, and an older file of that name is as it was.
pub fn save_grain(path: &Path, grain: &Grain) -> Result<(), SaveError> {
    let text = grain_to_json(grain);
    write_atomically(path, |writer| Ok(writeln!(writer, "{text}")?))
}
