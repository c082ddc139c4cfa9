//! Convex bodies as the points x with F(x) <= 1.

use crate::model::Derivatives;
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};

/// Radius and surface gradient in the direction `n` of the body F(x) <= 1, F being positively
/// homogeneous of degree one, from the slope of F at `n`.
///
/// By Euler's theorem F(n) = n . slope; then r = 1/F and g = r n - r² slope. Where F has a crease,
/// the slope of either side will do.
pub(super) fn radius_and_gradient(n: &Vector3<f64>, slope: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let r = 1.0 / n.dot(slope);
    (r, n * r - slope * (r * r))
}

/// Radius and its derivatives in the direction `n` of the body F(x) <= 1, from those of F at `n`.
pub(super) fn derivatives(n: &Vector3<f64>, gauge: &Jet) -> Derivatives {
    Derivatives::on_sphere(n, &gauge.powf(-1.0))
}

/// The distance of `n` from the z axis as a function of space; on the axis, as if flat along x.
pub(super) fn distance_from_axis(n: &Vector3<f64>) -> Jet {
    let (distance, outwards) = from_axis(n);
    let around = Vector3::z().cross(&outwards);
    let curvature = if distance > 0.0 { 1.0 / distance } else { 0.0 };
    Jet {
        value: distance,
        gradient: outwards,
        hessian: Matrix3::from(around * around.transpose()) * curvature,
    }
}

/// Distance of `n` from the z axis and the unit vector away from the axis, on it that of x.
pub(super) fn from_axis(n: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let distance = n.x.hypot(n.y);
    match distance > 0.0 {
        true => (distance, Vector3::new(n.x / distance, n.y / distance, 0.0)),
        false => (0.0, Vector3::x()),
    }
}
