//! Meshes whose large faces close something, and others.

use super::*;
use crate::measure::mesh_properties;
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Rotation3};

/// An ellipsoid between rings of vertices, cut off at a share `height` of its first semi-axis; triangles from one vertex of
/// the rim close the cut.
fn cut(semi_axes: Vector3<f64>, height: f64) -> Mesh {
    let (rings, around) = (60, 120_u32);
    let mut mesh = Mesh::default();
    let angle = |ring: u32| PI - (PI - height.acos()) * f64::from(ring + 1) / f64::from(rings);
    for ring in 0..rings {
        let (sin, cos) = angle(ring).sin_cos();
        mesh.vertices.extend((0..around).map(|at| {
            let (v, u) = (2.0 * PI * f64::from(at) / f64::from(around)).sin_cos();
            Point3::from(Vector3::new(cos, sin * u, sin * v).component_mul(&semi_axes))
        }));
    }
    for ring in 1..rings {
        let [below, above] = [ring - 1, ring].map(|ring| ring * around);
        for at in 0..around {
            let next = (at + 1) % around;
            let [a, b, c, d] = [below + at, below + next, above + next, above + at];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let rim = (rings - 1) * around;
    let fan = 1..around - 1;
    mesh.triangles
        .extend(fan.map(|at| [rim, rim + at, rim + at + 1]));
    mesh
}

#[test]
fn the_faces_that_close_a_cut_tip_are_large_and_no_others() {
    let semi_axes = Vector3::new(3.0, 1.0, 0.8);
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    let frame = Frame {
        centre: Point3::new(5.0, 6.0, -7.0),
        axes: *turn.matrix(),
    };
    let mut mesh = cut(semi_axes, 0.993);
    for vertex in &mut mesh.vertices {
        *vertex = frame.to_scan(&vertex.coords);
    }
    let OnFaces {
        points,
        are_coarse,
        closing,
    } = on_large_faces(&mesh, &seen(&mesh, &frame, &semi_axes), &frame, &semi_axes);
    assert!(!are_coarse);
    // Of an ellipse between an ellipsoid's ends.
    let cut = PI * semi_axes.y * semi_axes.z * (1.0 - 0.993 * 0.993);
    let area = mesh_properties(&mesh).unwrap().area;
    let Some(FitWarning::Closing { share }) = closing else {
        panic!("{closing:?}");
    };
    assert_relative_eq!(share, cut / area, max_relative = 0.05);
    assert_eq!(
        closed_by_faces(&mesh, &seen(&mesh, &frame, &semi_axes)),
        closing
    );
    assert!(points.len() > 12, "{}", points.len());
    for point in &points {
        assert_relative_eq!(frame.to_local(point).x, 0.993 * 3.0, max_relative = 1e-9);
    }
    let local: Vec<Vector3<f64>> = points.iter().map(|point| frame.to_local(point)).collect();
    let widest = local.iter().map(|place| place.y.abs()).fold(0.0, f64::max);
    assert!(widest > 0.09, "{widest}");
}

/// Between a ring of so many vertices and one of a sixth of them.
fn row_between(fine: u32, from: u32, coarse: u32) -> Vec<[u32; 3]> {
    let part = |at: u32| {
        let next = (at + 1) % (fine / 6);
        let below = move |i: u32| from + (6 * at + i) % fine;
        let fan = (0..6).map(move |i| [below(i), below(i + 1), coarse + at]);
        fan.chain([[below(6), coarse + next, coarse + at]])
    };
    (0..fine / 6).flat_map(part).collect()
}

/// The points on large faces of a mesh in its own frame.
fn on_large(mesh: &Mesh, semi_axes: &Vector3<f64>) -> Vec<Point3<f64>> {
    let frame = Frame {
        centre: Point3::origin(),
        axes: Matrix3::identity(),
    };
    let seen = seen(mesh, &frame, semi_axes);
    on_large_faces(mesh, &seen, &frame, semi_axes).points
}

#[test]
fn coarse_faces_beside_fine_ones_are_not_large() {
    let semi_axes = Vector3::repeat(1.0);
    let mut mesh = Mesh::default();
    for (around, angle) in [(240_u32, 1.526_f64), (240, 1.5), (40, 1.35), (40, 1.2)] {
        mesh.vertices.extend((0..around).map(|at| {
            let (v, u) = (2.0 * PI * f64::from(at) / f64::from(around)).sin_cos();
            Point3::new(angle.sin() * u, angle.sin() * v, angle.cos())
        }));
    }
    let band = |around: u32, below: u32, above: u32| {
        (0..around).flat_map(move |at| {
            let next = (at + 1) % around;
            let [a, b, c, d] = [below + at, below + next, above + next, above + at];
            [[a, b, c], [a, c, d]]
        })
    };
    mesh.triangles = row_between(240, 240, 480);
    mesh.triangles
        .extend(band(240, 0, 240).chain(band(40, 480, 520)));
    assert!(on_large(&mesh, &semi_axes).is_empty());
}

#[test]
fn fine_even_faces_are_not_large() {
    let semi_axes = Vector3::new(3.0, 1.0, 0.8);
    let mesh = Mesh::radial(16, |n| 1.0 / n.component_div(&semi_axes).norm());
    assert!(on_large(&mesh, &semi_axes).is_empty());
}

#[test]
fn straight_walls_between_round_ends_close_nothing() {
    // Rings of a capsule, with long faces between the two at its waist.
    let (rings, around) = (20_u32, 60_u32);
    let mut mesh = Mesh::default();
    for ring in 0..2 * rings {
        let north = ring >= rings;
        let angle = PI - PI * f64::from(ring - u32::from(north) + 1) / f64::from(2 * rings);
        let height = if north { 1.0 } else { -1.0 };
        mesh.vertices.extend((0..around).map(|at| {
            let (v, u) = (2.0 * PI * f64::from(at) / f64::from(around)).sin_cos();
            Point3::new(angle.sin() * u, angle.sin() * v, angle.cos() + height)
        }));
    }
    for (ring, at) in (1..2 * rings).flat_map(|ring| (0..around).map(move |at| (ring, at))) {
        let [below, above] = [ring - 1, ring].map(|ring| ring * around);
        let next = (at + 1) % around;
        let [a, b, c, d] = [below + at, below + next, above + next, above + at];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    let seen = mesh.vertices.iter().map(|vertex| vertex.coords.normalize());
    let parts = closing(&mesh.triangles, &seen.collect::<Vec<_>>());
    assert_eq!(parts.iter().flatten().count() as u32, 2 * around);
    assert_eq!(told(&mesh, &parts), None);
}
