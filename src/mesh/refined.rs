//! Meshes that are refined in part, as programs leave them.

use super::{Mesh, edges, undirected};
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// The mesh with some of its faces cut in four at the middles of their edges, each of which is moved.
pub(crate) fn refined(
    mesh: &Mesh,
    is_cut: impl Fn([Point3<f64>; 3]) -> bool,
    moved: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> Mesh {
    let place = |corner: u32| mesh.vertices[corner as usize];
    let mut vertices = mesh.vertices.clone();
    let mut made = HashMap::new();
    let mut triangles = Vec::new();
    for face in &mesh.triangles {
        if !is_cut(face.map(place)) {
            triangles.push(*face);
            continue;
        }
        let middles = edges(face).map(|ends| {
            *made.entry(undirected(ends)).or_insert_with(|| {
                let [a, b] = ends.map(|end| place(end).coords);
                vertices.push(moved((a + b) / 2.0).into());
                vertices.len() as u32 - 1
            })
        });
        let ([a, b, c], [ab, bc, ca]) = (*face, middles);
        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    Mesh {
        vertices,
        triangles,
    }
}

/// Whether the mean of a face's corners is above some height.
pub(crate) fn is_above(height: f64) -> impl Fn([Point3<f64>; 3]) -> bool {
    move |face| face.iter().map(|corner| corner.z).sum::<f64>() >= 3.0 * height
}
