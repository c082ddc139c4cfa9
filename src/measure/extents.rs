//! Extents along axes.

use crate::Mesh;
use nalgebra::{Matrix3, Vector3};

/// Extents of a mesh along three unit axes (columns of `axes`): the sides of the smallest box with
/// these axes that holds all vertices.
pub fn extents(mesh: &Mesh, axes: &Matrix3<f64>) -> Vector3<f64> {
    let (mut low, mut high) = (Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN));
    for vertex in &mesh.vertices {
        let place = axes.tr_mul(&vertex.coords);
        low = low.inf(&place);
        high = high.sup(&place);
    }
    high - low
}
