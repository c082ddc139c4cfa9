//! A surface as many small vector areas, for integrals over it and over the directions from a point
//! within.

use crate::Mesh;
use crate::model::{Node, Surface};
use nalgebra::{Point3, Vector3};

/// Nodes on a mesh, as nearly as cutting all triangles alike comes to it.
const NODES: usize = 40_000;

/// A node of a quadrature over a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Element {
    /// Where it lies, from the point that was asked for.
    pub(crate) place: Vector3<f64>,
    /// Its area along its outward normal.
    pub(crate) area: Vector3<f64>,
}

impl Element {
    /// The direction in which it is seen, its distance, and the solid angle it fills: negative where
    /// the surface faces the observer.
    pub(crate) fn seen(&self) -> (Vector3<f64>, f64, f64) {
        let distance = self.place.norm();
        let direction = self.place / distance;
        let solid_angle = direction.dot(&self.area) / (distance * distance);
        (direction, distance, solid_angle)
    }
}

/// The elements of a surface, seen from a point `shift` before its centre, at the nodes of a quadrature over its
/// tiling.
pub(crate) fn surface_elements(
    surface: &(impl Surface + ?Sized),
    nodes: &[Node],
    shift: &Vector3<f64>,
) -> Vec<Element> {
    let axes = surface.frame().axes;
    let elements = surface.elements(nodes).into_iter();
    elements
        .map(|element| Element {
            place: axes * element.place + shift,
            area: axes * element.area,
        })
        .collect()
}

/// The elements of a mesh, seen from a point: three Gauss nodes, exact to degree two, on each of its
/// triangles or of the m² that it is cut into; of a mesh of very many triangles, their centroids.
pub(crate) fn mesh_elements(mesh: &Mesh, from: &Point3<f64>) -> Vec<Element> {
    let per_triangle = NODES as f64 / mesh.triangles.len().max(1) as f64;
    let parts = (per_triangle / 3.0).sqrt().round().max(1.0) as usize;
    let mut elements = Vec::new();
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - from);
        let (along, across) = ((b - a) / parts as f64, (c - a) / parts as f64);
        let area = along.cross(&across) / 2.0;
        if per_triangle < 1.0 {
            let place = (a + b + c) / 3.0;
            elements.push(Element { place, area });
            continue;
        }
        for i in 0..parts {
            for j in 0..parts - i {
                let corner = a + along * i as f64 + across * j as f64;
                let mut add = |corner: Vector3<f64>, sign: f64| {
                    for [s, t] in [[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]] {
                        elements.push(Element {
                            place: corner + (along * s + across * t) * (sign / 6.0),
                            area: area / 3.0,
                        });
                    }
                };
                add(corner, 1.0);
                if i + j + 1 < parts {
                    add(corner + along + across, -1.0);
                }
            }
        }
    }
    elements
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn the_elements_of_a_mesh_have_its_area_and_volume_and_fill_the_sphere() {
        for resolution in [1, 8, 100] {
            let surface = Body::Bean.surface();
            let mesh = Mesh::radial(resolution, |n| surface.radius(n));
            let exact = mesh_properties(&mesh).unwrap();
            let elements = mesh_elements(&mesh, &exact.centroid);
            assert!(elements.len() > NODES / 3);
            let area: f64 = elements.iter().map(|e| e.area.norm()).sum();
            let volume: f64 = elements.iter().map(|e| e.area.dot(&e.place) / 3.0).sum();
            let sphere: f64 = elements.iter().map(|e| e.seen().2).sum();
            assert_relative_eq!(area, exact.area, max_relative = 1e-12);
            assert_relative_eq!(volume, exact.volume, max_relative = 1e-12);
            assert_relative_eq!(sphere, 4.0 * PI, max_relative = 1e-4);
        }
    }
}
