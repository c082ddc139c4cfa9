//! Two bodies beside each other and the frames of their contacts, as one mesh.

use super::Field;
use crate::mesh::Mesh;
use crate::model::Surface;
use crate::sphere::tangents;
use nalgebra::{Isometry3, Point3, Vector3};

/// Half the length of a frame's normal and of its other axes, and half their width, as shares of the first body's size.
const NORMAL: f64 = 0.12;
const ACROSS: f64 = 0.06;
const HALF_WIDTH: f64 = 0.008;

/// Where two bodies touch, and the normal there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFrame {
    /// The origin.
    pub point: Point3<f64>,
    /// The unit normal, from the first body to the second.
    pub normal: Vector3<f64>,
}

/// The meshes of two surfaces, the second moved by `pose`, and a cross of three bars for each contact, the longest along
/// its normal, all in the frame of the first; with the field `body`: 0 for the first, 1 for the second, 2 for the bars.
pub fn placed(
    surfaces: [&dyn Surface; 2],
    pose: &Isometry3<f64>,
    contacts: &[ContactFrame],
    resolution: usize,
) -> (Mesh, Field) {
    let [first, second] = surfaces.map(|surface| surface.mesh(resolution));
    let centre = surfaces[0].frame().centre;
    let far = first.vertices.iter().map(|vertex| (vertex - centre).norm());
    let size = far.fold(0.0, f64::max);
    let mut whole = Mesh::default();
    let mut bodies = Vec::new();
    let mut add = |mesh: &Mesh, body: f64, placed: &dyn Fn(&Point3<f64>) -> Point3<f64>| {
        let offset = whole.vertices.len() as u32;
        whole.vertices.extend(mesh.vertices.iter().map(placed));
        let corners = mesh.triangles.iter();
        whole
            .triangles
            .extend(corners.map(|corners| corners.map(|corner| offset + corner)));
        bodies.resize(whole.vertices.len(), body);
    };
    add(&first, 0.0, &|vertex| *vertex);
    add(&second, 1.0, &|vertex| pose * vertex);
    // The cube from -1 to 1.
    let bar = Mesh::radial(1, |_| 3_f64.sqrt());
    for contact in contacts {
        let [s, t] = tangents(&contact.normal);
        for (along, half) in [(contact.normal, NORMAL), (s, ACROSS), (t, ACROSS)] {
            let [u, v] = tangents(&along);
            add(&bar, 2.0, &|vertex| {
                let [x, y, z] = vertex.coords.into();
                contact.point + (along * (z * half) + (u * x + v * y) * HALF_WIDTH) * size
            });
        }
    }
    let body = Field {
        name: "body",
        values: bodies,
    };
    (whole, body)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use crate::model::Radial;
    use crate::shapes::Ellipsoid;
    use approx::assert_relative_eq;

    #[test]
    fn both_bodies_are_where_they_are_placed_and_every_part_is_closed() {
        let ball = Ellipsoid {
            semi_axes: Vector3::repeat(1.0),
        };
        let ball = Radial(&ball);
        let contact = ContactFrame {
            point: Point3::new(0.0, 0.0, 0.95),
            normal: Vector3::z(),
        };
        let pose = Isometry3::translation(0.0, 0.0, 1.9);
        let (mesh, body) = placed([&ball, &ball], &pose, &[contact], 8);
        assert_eq!(body.values.len(), mesh.vertices.len());
        let of = |wanted: f64| {
            let own = mesh.triangles.iter();
            let own = own.filter(|corners| body.values[corners[0] as usize] == wanted);
            let part = Mesh {
                vertices: mesh.vertices.clone(),
                triangles: own.copied().collect(),
            };
            mesh_properties(&part).unwrap()
        };
        assert_relative_eq!(of(0.0).centroid, Point3::origin(), epsilon = 1e-12);
        assert_relative_eq!(
            of(1.0).centroid,
            Point3::new(0.0, 0.0, 1.9),
            epsilon = 1e-12
        );
        assert_relative_eq!(of(2.0).centroid, contact.point, epsilon = 1e-12);
        assert!(of(2.0).volume > 0.0);
    }
}
