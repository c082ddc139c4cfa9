use super::*;
use crate::model::StarSurface;
use crate::shapes::{Cuboid, Ellipsoid, Solid};
use approx::assert_relative_eq;
use nalgebra::Vector3;

#[test]
fn the_mean_radius_is_that_over_all_directions_from_the_centre() {
    let ellipsoid = Ellipsoid {
        semi_axes: Vector3::new(3.0, 2.0, 1.0),
    };
    let mut mesh = Mesh::radial(48, |n| ellipsoid.radius(n));
    let centre = Point3::new(5.0, -7.0, 2.0);
    for vertex in &mut mesh.vertices {
        *vertex += centre.coords;
    }
    let found = mean_radius(&mesh, &centre, ReferenceKind::Faces);
    let exact = ellipsoid.integrals().mean_radius;
    assert_relative_eq!(found, exact, max_relative = 1e-3);
    let of_points = mean_radius(&mesh, &centre, ReferenceKind::Directions);
    assert_relative_eq!(of_points, exact, max_relative = 1e-3);
    let scan = Scan::from_mesh(mesh).unwrap();
    let prepared = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
    assert_relative_eq!(prepared.mean_radius, found, max_relative = 1e-6);
    let ascending = Vector3::new(1.0, 2.0, 3.0);
    assert_relative_eq!(prepared.semi_axes, ascending, max_relative = 1e-2);
}

#[test]
fn the_mean_radius_of_large_facets_is_that_over_them() {
    let [a, b, c] = [4.0, 1.0, 0.5];
    let half_edges = Vector3::new(a, b, c);
    let exact = Cuboid { half_edges }.integrals().mean_radius;
    let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2].map(|side| 2.0 * side as f64 - 1.0);
    let vertices = (0..8).map(|i| Vector3::from(corner(i)).component_mul(&half_edges).into());
    let mesh = Mesh {
        vertices: vertices.collect(),
        triangles: vec![
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
        ],
    };
    assert_eq!(mesh.check_closed(), Ok(()));
    let found = mean_radius(&mesh, &Point3::origin(), ReferenceKind::Faces);
    assert_relative_eq!(found, exact, max_relative = 1e-2);
}

#[test]
fn a_facet_beside_the_centre_does_not_change_the_mean_radius() {
    let mut mesh = Mesh::radial(12, |_| 2.0);
    let exact = mean_radius(&mesh, &Point3::origin(), ReferenceKind::Directions);
    assert_relative_eq!(exact, 2.0, max_relative = 1e-12);
    // A pit that ends beside the centre, and beyond it.
    for (end, least) in [(1e-3, 1.9), (-1e-3, 0.5)] {
        mesh.vertices[40] = Point3::from(mesh.vertices[40].coords.normalize() * end);
        let found = mean_radius(&mesh, &Point3::origin(), ReferenceKind::Faces);
        assert!((least..2.0).contains(&found), "{found}");
    }
}

#[test]
fn points_may_have_dust_beside_them_and_faces_none() {
    let radius = |n: &Vector3<f64>| 1.0 + 0.2 * n.x;
    let origin = |scan: Scan| PreparedScan::new(&scan, Symmetry::NONE).unwrap().origin();
    let mesh = Mesh::radial(16, radius);
    let points = Scan::from_points(mesh.vertices.clone());
    assert_eq!(origin(points), Origin::Points);
    assert_eq!(origin(Scan::from_mesh(mesh).unwrap()), Origin::Faces);
    let coarse = Scan::from_mesh(Mesh::radial(3, radius)).unwrap();
    assert_eq!(origin(coarse), Origin::LargeFaces);
}
