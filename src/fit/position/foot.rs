//! Foot points: the places of a surface nearest to given points.

use crate::sphere::tangents;
use nalgebra::{Matrix3, Vector3};

/// Longest step of a direction to its foot point, in radians.
const LONGEST_STEP: f64 = 0.05;

/// Relative damping of the step.
const DAMPING: f64 = 1e-3;

/// The step of a direction that brings the surface's point nearest, to first order.
pub(super) fn foot_step(
    n: &Vector3<f64>,
    lacking: &Vector3<f64>,
    slopes: &Matrix3<f64>,
) -> Vector3<f64> {
    let [a, b] = tangents(n);
    let (along_a, along_b) = (slopes * a, slopes * b);
    let (aa, ab, bb) = (
        along_a.norm_squared(),
        along_a.dot(&along_b),
        along_b.norm_squared(),
    );
    let damping = DAMPING * (aa + bb);
    let (aa, bb) = (aa + damping, bb + damping);
    let (ga, gb) = (along_a.dot(lacking), along_b.dot(lacking));
    let step = (a * (bb * ga - ab * gb) + b * (aa * gb - ab * ga)) / (aa * bb - ab * ab);
    match step.norm() {
        length if length > LONGEST_STEP => step * (LONGEST_STEP / length),
        length if length.is_finite() => step,
        _ => Vector3::zeros(),
    }
}
