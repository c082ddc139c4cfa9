//! What is read as a model, and why a text is none.

use super::InvalidGrain;
use crate::sphere::CoverError;

/// The version of the file format that this library writes.
pub(super) const VERSION: u32 = 9;

/// The text that tells a model file from any other JSON.
pub(super) const FORMAT: &str = "grainform model";

/// Parts per angle beyond which a file is refused.
pub(super) const LARGEST_PARTITION: usize = 1024;

/// Why a text is not a grain.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// Not JSON of the expected form.
    #[error("not a grainform model: {0}; write one with `grainform fit SCAN -o MODEL.json`")]
    Form(#[from] serde_json::Error),
    /// JSON that nowhere says that it is a model.
    #[error(
        "not a grainform model, but other JSON; write one with `grainform fit SCAN -o MODEL.json`"
    )]
    Foreign,
    /// JSON of some other program.
    #[error("not a grainform model: its format is {found:?}, not {FORMAT:?}")]
    Format {
        /// The format named in the file.
        found: String,
    },
    /// A version that this library does not know.
    #[error(
        "version {found} of the model format; this program reads up to version {VERSION}: update it"
    )]
    Version {
        /// The version named in the file.
        found: u32,
    },
    /// No segments, or more than any fit makes.
    #[error("{found} parts per angle; from 1 to {LARGEST_PARTITION} are read")]
    Partition {
        /// Parts per angle named in the file.
        found: usize,
    },
    /// No surface, or several.
    #[error(
        "the model is not sound: it must hold either `cells`, or `parts_per_angle` and `segments`, \
         or `symmetry` and `coefficients`, or `harmonics`, or `position` with `cells` or `harmonics`, or `superquadrics`"
    )]
    Surface,
    /// The errors of the surface are none.
    #[error(
        "the model is not sound: `local_errors` must hold 864 numbers of `place` and of `curvature`, none below zero"
    )]
    LocalErrors,
    /// The standard errors are none.
    #[error(
        "the model is not sound: it must hold either `standard_errors`, finite numbers, none below zero, or \
         `no_standard_errors`, the reason why there are none, or neither"
    )]
    StandardErrors,
    /// What was not seen is none.
    #[error(
        "the model is not sound: `unseen` must hold a `hole` with a half-angle of 0 to pi, or what is `open`, with a share"
    )]
    Unseen,
    /// What faces contradict is none.
    #[error(
        "the model is not sound: `contradicted` must hold the shares by which `area` and `volume` are off, above -1"
    )]
    Contradicted,
    /// The cells do not tile the sphere.
    #[error("the model is not sound: {0}")]
    Cover(#[from] CoverError),
    /// The parts do not make a grain.
    #[error("the model is not sound: {0}")]
    Invalid(#[from] InvalidGrain),
}
