//! Bodies that are not star-shaped, open, hollow or several: each figure is right or is not told.

mod bodies;

use bodies::{banana, cup, torus, u_shape};
use grainform::Mesh;
use grainform::measure::{Survey, inscribed_ball, mesh_properties};
use std::f64::consts::PI;

/// Distance from a point to the nearest vertex or middle of an edge, and the share of the full sphere
/// that the mesh fills as seen from there.
fn seen(mesh: &Mesh, from: &nalgebra::Point3<f64>) -> f64 {
    let angles = mesh.triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - from);
        let [la, lb, lc] = [a, b, c].map(|v| v.norm());
        let across = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
        2.0 * a.dot(&b.cross(&c)).atan2(across)
    });
    angles.sum::<f64>() / (4.0 * PI)
}

#[test]
fn bodies_that_bend_hold_their_medial_ball() {
    let (wall, bottom): (f64, f64) = (1.0, 0.7);
    let corner = wall + bottom - (2.0 * wall * bottom).sqrt();
    for (name, mesh, exact, tolerance) in [
        ("torus", torus(3.0, 1.0, 200, 100), 1.0, 1e-3),
        ("thin torus", torus(10.0, 0.3, 400, 60), 0.3, 2e-3),
        ("banana", banana(6.0, 2.5, 1.2), 1.2, 2e-3),
        ("U", u_shape(3.0, 5.0, 0.8), 0.8, 1e-3),
        // It rests in the corner of bottom and wall and touches the edge inside.
        ("cup", cup(5.0, 8.0, wall, bottom), corner, 1e-4),
    ] {
        let solid = mesh_properties(&mesh).expect("a solid");
        assert!(solid.volume > 0.0, "{name}");
        let ball = inscribed_ball(&mesh).expect("a ball");
        let error = ball.radius / exact - 1.0;
        assert!(
            error.abs() < tolerance,
            "{name}: {} for {exact}",
            ball.radius
        );
        assert!((seen(&mesh, &ball.centre) - 1.0).abs() < 1e-9, "{name}");
        let nearest = mesh
            .vertices
            .iter()
            .map(|v| (v - ball.centre).norm())
            .fold(f64::MAX, f64::min);
        assert!(nearest >= ball.radius * (1.0 - 1e-12), "{name}");
        let survey = Survey::of_mesh(&mesh).expect("a solid");
        let inscribed = survey.inscribed().expect("a ball").radius;
        assert_eq!(inscribed, ball.radius, "{name}");
        let ratio = survey.sphericity().expect("spheres").inscribed_enclosing;
        assert!(ratio > 0.0 && ratio < 0.6, "{name}: {ratio}");
    }
}
