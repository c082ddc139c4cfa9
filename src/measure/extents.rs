//! Extents along axes.

use super::OrientedBox;
use super::minimum_box::oriented;
use super::support::support_near;
use crate::Mesh;
use crate::model::StarSurface;
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

/// Length, width and thickness of a surface about `origin`: its extents along three unit axes, the columns,
/// in descending order. They are those between the planes across an axis that it touches, found from the
/// vertices of a `mesh` of it that reach farthest. Error: rounding where it is smooth, 1e-12 on edges.
pub(crate) fn dimensions_of_surface(
    surface: &(impl StarSurface + ?Sized),
    origin: &Point3<f64>,
    mesh: &Mesh,
    axes: &Matrix3<f64>,
) -> Vector3<f64> {
    let [low, high] = bounds_of_surface(surface, origin, mesh, axes);
    sorted(high - low)
}

/// Extents in descending order.
pub(super) fn sorted(extents: Vector3<f64>) -> Vector3<f64> {
    let mut sorted: [f64; 3] = extents.into();
    sorted.sort_by(|one, other| other.total_cmp(one));
    sorted.into()
}

/// The smallest box with these axes that holds a surface, likewise.
pub(super) fn hold(
    surface: &(impl StarSurface + ?Sized),
    origin: &Point3<f64>,
    mesh: &Mesh,
    axes: &Matrix3<f64>,
) -> OrientedBox {
    oriented(bounds_of_surface(surface, origin, mesh, axes), axes)
}

fn bounds_of_surface(
    surface: &(impl StarSurface + ?Sized),
    origin: &Point3<f64>,
    mesh: &Mesh,
    axes: &Matrix3<f64>,
) -> [Vector3<f64>; 2] {
    let reach = |towards: Vector3<f64>| {
        let farthest = mesh.vertices.iter().fold(*origin, |farthest, vertex| {
            match (vertex - farthest).dot(&towards) > 0.0 {
                true => *vertex,
                false => farthest,
            }
        });
        let start = (farthest - origin).try_normalize(0.0).unwrap_or(towards);
        let touched = support_near(surface, &towards, &start).point.dot(&towards);
        origin.coords.dot(&towards) + touched.max((farthest - origin).dot(&towards))
    };
    let axis = |i: usize| axes.column(i).into_owned();
    [
        Vector3::from_fn(|i, _| -reach(-axis(i))),
        Vector3::from_fn(|i, _| reach(axis(i))),
    ]
}
