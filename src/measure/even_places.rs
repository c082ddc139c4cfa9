//! Places all over a mesh, equal areas apart.

use crate::Mesh;
use nalgebra::Vector3;

/// A place of a surface, and the way out of the body there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EvenPlace {
    pub(crate) place: Vector3<f64>,
    /// Unit normal of the triangle.
    pub(crate) outward: Vector3<f64>,
}

/// At most so many places, each of which stands for the same area: in the order of the triangles, one after each
/// such area, across a triangle by steps of the golden ratio. Every triangle must name vertices that exist.
pub(crate) fn even_places(mesh: &Mesh, count: usize) -> Vec<EvenPlace> {
    let corners: Vec<[Vector3<f64>; 3]> = mesh
        .triangles
        .iter()
        .map(|corners| corners.map(|corner| mesh.vertices[corner as usize].coords))
        .collect();
    let doubles: Vec<Vector3<f64>> = corners
        .iter()
        .map(|[a, b, c]| (b - a).cross(&(c - a)))
        .collect();
    let step = doubles.iter().map(Vector3::norm).sum::<f64>() / count as f64;
    let (mut passed, mut places) = (0.0, Vec::with_capacity(count));
    for ([a, b, c], double) in corners.iter().zip(&doubles) {
        while let Some(outward) = double.try_normalize(0.0)
            && let along = ((places.len() as f64 + 0.5) * step - passed) / double.norm()
            && along < 1.0
            && places.len() < count
        {
            let across = (places.len() as f64 * 0.618_033_988_749_895).fract();
            let place = a + (b + (c - b) * across - a) * along.max(0.0).sqrt();
            places.push(EvenPlace { place, outward });
        }
        passed += double.norm();
    }
    places
}
