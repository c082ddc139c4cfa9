//! Standard errors of the area and the volume of a superquadric, from those of its numbers.

use super::bodies::Body;
use super::form::Form;
use crate::measure::superquadric_properties;
use nalgebra::{DMatrix, Matrix2, Point3, Vector2};

/// By how much the logarithm of a number is changed to see what that does.
const STEP: f64 = 1e-4;

/// Standard errors of a fitted superquadric's solid: of how well the points tell the nearest superquadric, and not of how well
/// a superquadric suits them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SolidErrors {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
}

/// Those of a body in units of `size`, by the covariance of its parameters; `None` where that is not known.
pub(super) fn solid_errors(
    body: &Body,
    form: Form,
    size: f64,
    covariance: &DMatrix<f64>,
) -> Option<SolidErrors> {
    let solid = |step: &[f64]| {
        let (shape, _) = body.moved(form, step).told(size, &Point3::origin()).ok()?;
        let properties = superquadric_properties(&shape).properties;
        Some(Vector2::new(properties.area, properties.volume))
    };
    let slope = |number: usize| {
        let mut step = vec![0.0; form.parameters()];
        step[number] = STEP;
        let above = solid(&step)?;
        step[number] = -STEP;
        Some((above - solid(&step)?) / (2.0 * STEP))
    };
    let slopes: Vec<Vector2<f64>> = (0..form.numbers()).map(slope).collect::<Option<_>>()?;
    let mut variances = Matrix2::zeros();
    for (i, one) in slopes.iter().enumerate() {
        for (j, other) in slopes.iter().enumerate() {
            variances += one * other.transpose() * covariance[(i, j)];
        }
    }
    let [area, volume] = [0, 1].map(|i| variances[(i, i)].max(0.0).sqrt());
    (area.is_finite() && volume.is_finite()).then_some(SolidErrors { area, volume })
}
