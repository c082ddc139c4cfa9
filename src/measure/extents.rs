//! Extents along axes.

use crate::Mesh;
use nalgebra::{Matrix3, Point3, Vector3};

/// Extents of a mesh along three unit axes (columns of `axes`): the sides of the smallest box with
/// these axes that holds all vertices.
pub fn extents(mesh: &Mesh, axes: &Matrix3<f64>) -> Vector3<f64> {
    let [low, high] = bounds(&mesh.vertices, axes);
    high - low
}

/// Least and greatest coordinates of points along three unit axes (columns of `axes`).
pub(super) fn bounds(points: &[Point3<f64>], axes: &Matrix3<f64>) -> [Vector3<f64>; 2] {
    let (mut low, mut high) = (Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN));
    for point in points {
        let place = axes.tr_mul(&point.coords);
        low = low.inf(&place);
        high = high.sup(&place);
    }
    [low, high]
}
