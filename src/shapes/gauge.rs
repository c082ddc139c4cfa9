//! Convex bodies as the points x with F(x) <= 1.

use nalgebra::Vector3;

/// Radius and surface gradient in the direction `n` of the body F(x) <= 1, F being positively
/// homogeneous of degree one, from the slope of F at `n`.
///
/// By Euler's theorem F(n) = n . slope; then r = 1/F and g = r n - r² slope. Where F has a crease,
/// the slope of either side will do.
pub(super) fn radius_and_gradient(n: &Vector3<f64>, slope: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let r = 1.0 / n.dot(slope);
    (r, n * r - slope * (r * r))
}

/// Distance of `n` from the z axis and the unit vector away from the axis, on it that of x.
pub(super) fn from_axis(n: &Vector3<f64>) -> (f64, Vector3<f64>) {
    let distance = n.x.hypot(n.y);
    match distance > 0.0 {
        true => (distance, Vector3::new(n.x / distance, n.y / distance, 0.0)),
        false => (0.0, Vector3::x()),
    }
}
