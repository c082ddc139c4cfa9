//! A grain whose errors are known.

use crate::measure::{Scheme, Survey};
use crate::model::{Grain, LocalError, LocalErrors, StandardErrors, grain_from_json};
use crate::sphere::CubeCell;
use nalgebra::{Matrix3, Vector3};

/// An egg with errors of its sizes of so many percent: area, volume, length, width, thickness; of its principal moments, one, two and
/// three; and of all its surface. Its axes are known.
pub(super) fn egg(percent: [f64; 5], surface: f64) -> Grain {
    let text = r#"{"format": "grainform model", "version": 5, "centre": [1, 2, 3],
        "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "harmonics": [12, 0, 0, 0, 0, 0, 1, 0, 0.5]}"#;
    let grain = grain_from_json(text).unwrap();
    let survey = Survey::of_grain(&grain, Scheme::Exact);
    let moments = survey.principal().unwrap().moments;
    let [area, volume, length, width, thickness] = percent.map(|share| share / 100.0);
    let errors = StandardErrors {
        area: area * survey.area().unwrap(),
        volume: volume * survey.volume().unwrap(),
        moments: moments.component_mul(&Vector3::new(0.01, 0.02, 0.03)),
        inertia: Matrix3::zeros(),
        dimensions: survey
            .dimensions()
            .unwrap()
            .component_mul(&Vector3::new(length, width, thickness)),
        ..StandardErrors::ZERO
    };
    grain
        .with_standard_errors(Ok(errors))
        .with_local_errors(local_errors(|_| surface))
}

/// The same of which only the surface may be off, everywhere by so much, and its curvature.
pub(super) fn bent_egg(place: f64, curvature: f64) -> Grain {
    let error = LocalError { place, curvature };
    let cells = CubeCell::uniform(LocalErrors::PARTS).len();
    egg([0.0; 5], 0.0).with_local_errors(LocalErrors::new(vec![error; cells]))
}

/// Errors of a surface, which is so well known in a direction.
pub(super) fn local_errors(place: impl Fn(&Vector3<f64>) -> f64) -> Option<LocalErrors> {
    let cells = CubeCell::uniform(LocalErrors::PARTS);
    let error = |cell: &CubeCell| LocalError {
        place: place(&cell.middle()),
        curvature: 0.0,
    };
    LocalErrors::new(cells.iter().map(error).collect())
}
