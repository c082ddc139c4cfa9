//! Extents along axes.

use super::oriented_box::{OrientedBox, oriented};
use crate::Mesh;
use nalgebra::{Matrix3, Point3, Vector3};

/// Extents of a mesh along three unit axes (columns of `axes`): the sides of the smallest box with
/// these axes that holds all vertices, which must be finite. Zero of a mesh without vertices.
pub fn extents(mesh: &Mesh, axes: &Matrix3<f64>) -> Vector3<f64> {
    extents_of_points(&mesh.vertices, axes)
}

/// The same of points.
pub(crate) fn extents_of_points(points: &[Point3<f64>], axes: &Matrix3<f64>) -> Vector3<f64> {
    if points.is_empty() {
        return Vector3::zeros();
    }
    let [low, high] = bounds(points, axes);
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

/// The smallest box with the given orthonormal axes (columns, in any order) that holds all points.
pub(crate) fn box_along(points: &[Point3<f64>], axes: &Matrix3<f64>) -> OrientedBox {
    oriented(bounds(points, axes), axes)
}

/// Length, width and thickness, and their axes.
#[derive(Clone)]
pub(in crate::measure) struct Extents {
    pub(in crate::measure) dimensions: Vector3<f64>,
    /// In the columns.
    pub(in crate::measure) axes: Matrix3<f64>,
}

impl Extents {
    /// Of the extents along three axes, the columns.
    pub(in crate::measure) fn descending(along: &Vector3<f64>, axes: &Matrix3<f64>) -> Self {
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| along[j].total_cmp(&along[i]));
        Self {
            dimensions: Vector3::from(order.map(|i| along[i])),
            axes: Matrix3::from_columns(&order.map(|i| axes.column(i).into_owned())),
        }
    }
}
