//! A grain as JSON: versioned, exact to the last bit, and refused where it is not sound.

use super::{Frame, Grain, InvalidGrain};
use crate::sphere::AngularPartition;
use nalgebra::{Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// The version of the file format that this library writes and reads.
const VERSION: u32 = 1;

/// The text that tells a model file from any other JSON.
const FORMAT: &str = "grainform model";

/// Parts per angle beyond which a file is refused.
const LARGEST_PARTITION: usize = 1024;

/// The file: every number in the scan's unit and frame.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GrainFile {
    format: String,
    version: u32,
    /// Position of the centre in the scan.
    centre: [f64; 3],
    /// The grain's x, y and z axes in the scan.
    axes: [[f64; 3]; 3],
    /// Parts per angle: n_s is its square.
    parts_per_angle: usize,
    /// Per segment, row by row from the +z pole: coefficients of the cap basis by degree.
    segments: Vec<Vec<f64>>,
}

/// Why a model file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// Not JSON of the expected form.
    #[error("not a grainform model: {0}; write one with `grainform fit SCAN -o MODEL.json`")]
    Form(#[from] serde_json::Error),
    /// JSON of some other program.
    #[error("not a grainform model: its format is {found:?}, not {FORMAT:?}")]
    Format {
        /// The format named in the file.
        found: String,
    },
    /// A version that this library does not know.
    #[error("version {found} of the model format; this program reads version {VERSION}: update it")]
    Version {
        /// The version named in the file.
        found: u32,
    },
    /// More segments than any fit makes.
    #[error("{found} parts per angle; at most {LARGEST_PARTITION} are read")]
    Partition {
        /// Parts per angle named in the file.
        found: usize,
    },
    /// The parts do not make a grain.
    #[error("the model is not sound: {0}")]
    Invalid(#[from] InvalidGrain),
}

/// The JSON text of a grain.
pub fn save_grain(grain: &Grain) -> String {
    let Frame { centre, axes } = grain.frame();
    let file = GrainFile {
        format: FORMAT.into(),
        version: VERSION,
        centre: centre.coords.into(),
        axes: [0, 1, 2].map(|i| axes.column(i).into_owned().into()),
        parts_per_angle: grain.partition().per_angle(),
        segments: (0..grain.partition().segments())
            .map(|segment| grain.coefficients(segment).to_vec())
            .collect(),
    };
    serde_json::to_string_pretty(&file).expect("a record of numbers and strings is valid JSON")
}

/// The grain that a JSON text describes.
///
/// # Errors
/// [`LoadError`] if the text is not a model of this version, or is not sound.
pub fn parse_grain(text: &str) -> Result<Grain, LoadError> {
    let file: GrainFile = serde_json::from_str(text)?;
    if file.format != FORMAT {
        return Err(LoadError::Format { found: file.format });
    }
    if file.version != VERSION {
        return Err(LoadError::Version {
            found: file.version,
        });
    }
    if file.parts_per_angle > LARGEST_PARTITION {
        return Err(LoadError::Partition {
            found: file.parts_per_angle,
        });
    }
    let frame = Frame {
        centre: Point3::from(file.centre),
        axes: Matrix3::from_columns(&file.axes.map(Vector3::from)),
    };
    let partition = AngularPartition::new(file.parts_per_angle);
    Ok(Grain::new(frame, partition, file.segments)?)
}
