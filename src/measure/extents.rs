//! Extents along axes.

use super::oriented_box::{OrientedBox, oriented};
use super::support::support_near;
use crate::Mesh;
use crate::model::Surface;
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
pub(super) struct Extents {
    pub(super) dimensions: Vector3<f64>,
    /// In the columns.
    pub(super) axes: Matrix3<f64>,
}

impl Extents {
    /// Of the extents along three axes, the columns.
    pub(super) fn descending(along: &Vector3<f64>, axes: &Matrix3<f64>) -> Self {
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| along[j].total_cmp(&along[i]));
        Self {
            dimensions: Vector3::from(order.map(|i| along[i])),
            axes: Matrix3::from_columns(&order.map(|i| axes.column(i).into_owned())),
        }
    }
}

/// A surface with places all over it.
pub(super) struct Reach<'a> {
    pub(super) surface: &'a dyn Surface,
    /// Its mesh of the resolution [`RESOLUTION`], seen from its centre.
    pub(super) mesh: &'a Mesh,
}

/// Cells per edge of the cube of directions of a mesh on which hull, spheres and outlines are found:
/// 24 578 vertices. They lie on the surface, and what is between them is cut off by at most 1e-4 of
/// the radius of curvature.
pub(super) const RESOLUTION: usize = 64;

impl Reach<'_> {
    /// Extents along three unit axes, the columns: between the planes across an axis that the surface touches, found from the
    /// vertices of its mesh that reach farthest. Error: rounding where it is smooth, 1e-12 on edges.
    pub(super) fn extents(&self, axes: &Matrix3<f64>) -> Vector3<f64> {
        let [low, high] = self.bounds(axes);
        high - low
    }

    /// The smallest box with these axes that holds the surface, likewise.
    pub(super) fn hold(&self, axes: &Matrix3<f64>) -> OrientedBox {
        oriented(self.bounds(axes), axes)
    }

    fn bounds(&self, axes: &Matrix3<f64>) -> [Vector3<f64>; 2] {
        let (directions, _) = self.surface.grid(RESOLUTION);
        let centre = self.surface.frame().centre;
        let reach = |towards: Vector3<f64>| {
            let heights = self
                .mesh
                .vertices
                .iter()
                .map(|vertex| (vertex - centre).dot(&towards));
            let higher = |best: (f64, usize), (i, height): (usize, f64)| match height > best.0 {
                true => (height, i),
                false => best,
            };
            let (height, farthest) = heights.enumerate().fold((f64::NEG_INFINITY, 0), higher);
            let touched = support_near(self.surface, &towards, &directions[farthest])
                .point
                .dot(&towards);
            centre.coords.dot(&towards) + touched.max(height)
        };
        let axis = |i: usize| axes.column(i).into_owned();
        [
            Vector3::from_fn(|i, _| -reach(-axis(i))),
            Vector3::from_fn(|i, _| reach(axis(i))),
        ]
    }
}
