//! Frames in the tangent plane.

use nalgebra::Vector3;

/// Two unit tangents of the sphere at the unit vector `n`, a and b with a x b = n. They jump where |n.x| is 0.6.
pub(crate) fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let axis = match n.x.abs() < 0.6 {
        true => Vector3::x(),
        false => Vector3::y(),
    };
    let a = n.cross(&axis).normalize();
    [a, n.cross(&a)]
}

/// The same, seen from the axis that `n` is least along. Coefficients in files of mirrored models are told in these.
pub(crate) fn across(n: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let a = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
    [a, n.cross(&a)]
}
