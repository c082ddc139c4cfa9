//! Mass properties of a closed triangle mesh, by the divergence theorem.

use crate::Mesh;
use crate::measure::{MassProperties, Moments};
use nalgebra::{Point3, Vector3};
use thiserror::Error;

/// Why a mesh has no mass properties.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshIntegralError {
    /// A triangle names a vertex that is not there. The mesh is broken: read it again.
    #[error("triangle {triangle} names vertex {index}, but there are {vertices} vertices")]
    MissingVertex {
        /// Position of the triangle in the mesh.
        triangle: usize,
        /// The index it holds.
        index: u32,
        /// Number of vertices in the mesh.
        vertices: usize,
    },
    /// The mesh is empty or flat, or a coordinate is not finite: there is no centroid.
    #[error("the mesh encloses no volume ({volume})")]
    NoVolume {
        /// The volume found: zero or not finite, or where the winding matters below zero.
        volume: f64,
    },
}

/// Area, volume, centroid and inertia of the solid inside a closed mesh.
///
/// Sums signed tetrahedra over the triangles ([`Moments::add_triangle`]), from the mean of the
/// vertices and not from the frame's origin, so that a mesh far from the origin loses no digits
/// beyond those its coordinates have already lost. Cost: one pass.
///
/// The mesh must be closed and wound counter-clockwise from outside, which is not checked here: a
/// mesh wound the other way has a negative volume and inertia, and for an open one they depend on
/// the vertices' mean.
///
/// # Errors
///
/// See [`MeshIntegralError`].
pub fn mesh_properties(mesh: &Mesh) -> Result<MassProperties, MeshIntegralError> {
    let origin = vertex_mean(mesh);
    let mut moments = Moments::default();
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        let corner = |index: u32| {
            mesh.vertices
                .get(index as usize)
                .map(|vertex| vertex - origin)
                .ok_or(MeshIntegralError::MissingVertex {
                    triangle,
                    index,
                    vertices: mesh.vertices.len(),
                })
        };
        let [a, b, c] = *corners;
        moments.add_triangle(&corner(a)?, &corner(b)?, &corner(c)?);
    }
    let volume = moments.volume;
    if volume == 0.0 || !volume.is_finite() {
        return Err(MeshIntegralError::NoVolume { volume });
    }
    Ok(moments.about_centroid(&origin))
}

/// Mean of the vertices; the origin when there are none.
fn vertex_mean(mesh: &Mesh) -> Point3<f64> {
    let sum: Vector3<f64> = mesh.vertices.iter().map(|vertex| vertex.coords).sum();
    Point3::from(sum / mesh.vertices.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::integrate;
    use crate::model::StarSurface;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;
    use std::f64::consts::PI;

    /// An axis-parallel box, one corner at `at`.
    fn cuboid(at: Point3<f64>, size: Vector3<f64>) -> Mesh {
        let vertices = (0..8)
            .map(|i| Vector3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64))
            .map(|unit| at + unit.component_mul(&size))
            .collect();
        let quads: [[u32; 4]; 6] = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let triangles = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
        Mesh {
            vertices,
            triangles,
        }
    }

    #[test]
    fn a_box_has_its_closed_form() {
        let solid = mesh_properties(&cuboid(
            Point3::new(1.0, -2.0, 3.0),
            Vector3::new(2.0, 3.0, 4.0),
        ))
        .unwrap();
        assert_relative_eq!(solid.area, 52.0, epsilon = 1e-13);
        assert_relative_eq!(solid.volume, 24.0, epsilon = 1e-13);
        assert_relative_eq!(solid.centroid, Point3::new(2.0, -0.5, 5.0), epsilon = 1e-13);
        let inertia = Vector3::new(9.0 + 16.0, 4.0 + 16.0, 4.0 + 9.0) * 2.0;
        assert_relative_eq!(
            solid.inertia,
            Matrix3::from_diagonal(&inertia),
            epsilon = 1e-12
        );
    }

    #[test]
    fn an_offset_of_ten_million_costs_nothing() {
        let at = Point3::new(1e7, -1e7, 1e7);
        let size = Vector3::new(2.0, 3.0, 4.0);
        let near = mesh_properties(&cuboid(Point3::origin(), size)).unwrap();
        let far = mesh_properties(&cuboid(at, size)).unwrap();
        assert_relative_eq!(far.volume, near.volume, max_relative = 1e-14);
        assert_relative_eq!(far.inertia, near.inertia, epsilon = 1e-12);
        assert_relative_eq!(far.centroid, near.centroid + at.coords, epsilon = 1e-8);
    }

    #[test]
    fn a_tetrahedron_has_its_closed_form() {
        let mesh = Mesh {
            vertices: vec![
                Point3::origin(),
                Point3::new(1.0, 0.0, 0.0),
                Point3::new(0.0, 1.0, 0.0),
                Point3::new(0.0, 0.0, 1.0),
            ],
            triangles: vec![[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]],
        };
        let solid = mesh_properties(&mesh).unwrap();
        assert_relative_eq!(solid.area, 1.5 + 0.75_f64.sqrt(), epsilon = 1e-15);
        assert_relative_eq!(solid.volume, 1.0 / 6.0, epsilon = 1e-15);
        assert_relative_eq!(
            solid.centroid,
            Point3::new(0.25, 0.25, 0.25),
            epsilon = 1e-15
        );
        // ∫ x² = 1/60 and ∫ xy = 1/120 about the corner, less V/16 at the centroid.
        assert_relative_eq!(solid.inertia[(0, 0)], 1.0 / 80.0, epsilon = 1e-15);
        assert_relative_eq!(solid.inertia[(0, 1)], 1.0 / 480.0, epsilon = 1e-15);
    }

    #[test]
    fn broken_meshes_are_refused() {
        let mut mesh = cuboid(Point3::origin(), Vector3::new(1.0, 1.0, 1.0));
        mesh.triangles[3][1] = 8;
        assert_eq!(
            mesh_properties(&mesh),
            Err(MeshIntegralError::MissingVertex {
                triangle: 3,
                index: 8,
                vertices: 8
            })
        );
        assert_eq!(
            mesh_properties(&Mesh::default()),
            Err(MeshIntegralError::NoVolume { volume: 0.0 })
        );
    }

    /// A mesh of n x 2 n quadrilaterals in (polar angle, azimuth), triangles at the poles.
    fn latitude_mesh(surface: &dyn StarSurface, n: u32) -> Mesh {
        let vertices = (0..=n)
            .flat_map(|i| (0..2 * n).map(move |j| (i, j)))
            .map(|(i, j)| {
                let (theta, phi) = (PI * i as f64 / n as f64, PI * j as f64 / n as f64);
                let ring = Vector3::new(phi.cos(), phi.sin(), 0.0) * theta.sin();
                let direction = (ring + Vector3::z() * theta.cos()).normalize();
                Point3::from(direction * surface.radius(&direction))
            })
            .collect();
        let triangles = (0..n)
            .flat_map(|i| (0..2 * n).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                let at = |i: u32, j: u32| i * 2 * n + j % (2 * n);
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                [[a, b, c], [a, c, d]]
            })
            .collect();
        Mesh {
            vertices,
            triangles,
        }
    }

    #[test]
    fn meshes_converge_to_the_integrals_at_second_order() {
        for body in Body::SMOOTH {
            let surface = body.surface();
            let exact = integrate(surface.as_ref(), 1e-10).properties;
            let errors = [64, 128].map(|n| {
                let mesh = mesh_properties(&latitude_mesh(surface.as_ref(), n)).unwrap();
                [
                    (mesh.volume - exact.volume).abs() / exact.volume,
                    (mesh.area - exact.area).abs() / exact.area,
                    (mesh.inertia - exact.inertia).norm() / exact.inertia.norm(),
                ]
            });
            for (coarse, fine) in errors[0].iter().zip(errors[1]) {
                let order = (coarse / fine).log2();
                assert!((order - 2.0).abs() < 0.1, "{body}: order {order}");
                assert!(fine < 2e-3);
            }
        }
    }
}
