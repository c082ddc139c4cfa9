//! Places in the triangles of a mesh.

use crate::fit::points::neighbours::Neighbours;
use crate::mesh::Mesh;
use nalgebra::Vector3;

/// Vertices near a point whose triangles are looked at.
const NEAR: usize = 3;

/// A place in a triangle.
pub(super) struct OnMesh {
    pub(super) triangle: usize,
    pub(super) barycentric: [f64; 3],
}

impl OnMesh {
    /// The places nearest to points that are near a mesh of even triangles.
    pub(super) fn nearest(mesh: &Mesh, points: &[Vector3<f64>]) -> Vec<Self> {
        let mut around = vec![Vec::new(); mesh.vertices.len()];
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            for corner in corners {
                around[*corner as usize].push(triangle);
            }
        }
        let vertices: Vec<Vector3<f64>> = mesh.vertices.iter().map(|v| v.coords).collect();
        let near = Neighbours::new(&vertices);
        let nearest = |point: &Vector3<f64>| {
            let triangles = near
                .nearest(point, NEAR)
                .into_iter()
                .flat_map(|at| &around[at]);
            let places = triangles.map(|&triangle| {
                let corners = mesh.triangles[triangle].map(|corner| vertices[corner as usize]);
                let barycentric = projected(&corners, point);
                let place = Self {
                    triangle,
                    barycentric,
                };
                ((place.between(corners) - point).norm_squared(), place)
            });
            let least = places.min_by(|one, other| one.0.total_cmp(&other.0));
            least.map_or(
                Self {
                    triangle: 0,
                    barycentric: [1.0 / 3.0; 3],
                },
                |(_, place)| place,
            )
        };
        points.iter().map(nearest).collect()
    }

    /// What is known at the corners, at the place.
    pub(super) fn between(&self, [a, b, c]: [Vector3<f64>; 3]) -> Vector3<f64> {
        let [s, t, u] = self.barycentric;
        a * s + b * t + c * u
    }
}

/// Barycentric coordinates of a point's projection to a triangle, moved to its rim if they are outside.
fn projected([a, b, c]: &[Vector3<f64>; 3], point: &Vector3<f64>) -> [f64; 3] {
    let (along, across, off) = (b - a, c - a, point - a);
    let (aa, ab, bb) = (
        along.norm_squared(),
        along.dot(&across),
        across.norm_squared(),
    );
    let (pa, pb) = (along.dot(&off), across.dot(&off));
    let determinant = (aa * bb - ab * ab).max(f64::MIN_POSITIVE);
    let (t, u) = (
        (bb * pa - ab * pb) / determinant,
        (aa * pb - ab * pa) / determinant,
    );
    let inside = [1.0 - t - u, t, u].map(|share| share.clamp(0.0, 1.0));
    let sum: f64 = inside.iter().sum();
    inside.map(|share| share / sum)
}
