//! Meshes of bodies that are not star-shaped, with known medial figures.

use grainform::Mesh;
use nalgebra::{Point3, Vector3};
use std::f64::consts::{PI, TAU};

/// A closed mesh through rings of as many points each, with an apex before the first and one after the
/// last: counter-clockwise from outside if the rings turn counter-clockwise seen from the end.
pub(crate) fn rings(start: Point3<f64>, rings: &[Vec<Point3<f64>>], end: Point3<f64>) -> Mesh {
    let around = rings[0].len() as u32;
    let mut vertices = vec![start];
    vertices.extend(rings.iter().flatten());
    vertices.push(end);
    let last = vertices.len() as u32 - 1;
    let at = |ring: u32, i: u32| 1 + ring * around + i % around;
    let mut triangles = Vec::new();
    for i in 0..around {
        triangles.push([0, at(0, i + 1), at(0, i)]);
        for ring in 0..rings.len() as u32 - 1 {
            let [a, b, c, d] = [
                at(ring, i),
                at(ring, i + 1),
                at(ring + 1, i + 1),
                at(ring + 1, i),
            ];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([
            at(rings.len() as u32 - 1, i),
            at(rings.len() as u32 - 1, i + 1),
            last,
        ]);
    }
    Mesh {
        vertices,
        triangles,
    }
}

/// A torus about z: `along` the ring, `around` the tube.
pub(crate) fn torus(ring: f64, tube: f64, along: u32, around: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..along {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(along)).sin_cos();
        for j in 0..around {
            let (up, out) = (TAU * f64::from(j) / f64::from(around)).sin_cos();
            let r = ring + tube * out;
            mesh.vertices.push(Point3::new(r * cos, r * sin, tube * up));
        }
    }
    let at = |i: u32, j: u32| i % along * around + j % around;
    for i in 0..along {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// Spheres of the radii along an arc of a circle of radius `bend` about the origin, through `angle`: the
/// circles in which planes across the arc cut them, from tip to tip.
fn along_arc(
    bend: f64,
    angle: f64,
    steps: u32,
    around: u32,
    radius: impl Fn(f64) -> f64,
) -> Vec<Vec<Point3<f64>>> {
    let ring = |i: u32| {
        let s = f64::from(i) / f64::from(steps);
        let (sin, cos) = (angle * (s - 0.5)).sin_cos();
        let out = Vector3::new(cos, sin, 0.0);
        let point = |j: u32| {
            let (up, across) = (TAU * f64::from(j) / f64::from(around)).sin_cos();
            // Right-handed about the way along the arc.
            Point3::from(out * (bend + radius(s) * up) + Vector3::z() * (radius(s) * across))
        };
        (0..around).map(point).collect()
    };
    (1..steps).map(ring).collect()
}

/// A bent spindle, thickest in its middle, where its radius is `thickness`.
pub(crate) fn banana(bend: f64, angle: f64, thickness: f64) -> Mesh {
    let around = along_arc(bend, angle, 160, 96, |s| thickness * (PI * s).sin().sqrt());
    let tip = |side: f64| {
        let (sin, cos) = (side * angle / 2.0).sin_cos();
        Point3::new(bend * cos, bend * sin, 0.0)
    };
    rings(tip(-1.0), &around, tip(1.0))
}

/// A tube of constant radius in the shape of a U: two straight legs and half a circle, flat at its ends.
pub(crate) fn u_shape(bend: f64, leg: f64, thickness: f64) -> Mesh {
    let mut all: Vec<Vec<Point3<f64>>> = along_arc(bend, PI, 120, 96, |_| thickness);
    let moved = |points: &[Point3<f64>], angle: f64, by: f64| -> Vec<Point3<f64>> {
        // The ring at an end of the arc, from the first one turned back and moved along the leg.
        let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        points
            .iter()
            .map(|p| turn * p - Vector3::x() * by)
            .collect()
    };
    let step = PI / 120.0;
    let (first, last) = (all[0].clone(), all[all.len() - 1].clone());
    let start = moved(&first, -step, 0.0);
    let end = moved(&last, step, 0.0);
    all.insert(0, start.clone());
    all.insert(0, moved(&first, -step, leg));
    all.push(end.clone());
    all.push(moved(&last, step, leg));
    rings(
        Point3::new(-leg, -bend, 0.0),
        &all,
        Point3::new(-leg, bend, 0.0),
    )
}

/// A cup about z: outer radius and height, and how thick its wall and its bottom are.
pub(crate) fn cup(radius: f64, height: f64, wall: f64, bottom: f64) -> Mesh {
    let profile = [
        [radius, 0.0],
        [radius, height],
        [radius - wall, height],
        [radius - wall, bottom],
    ];
    let ring = |[r, z]: [f64; 2]| -> Vec<Point3<f64>> {
        let angles = (0..720).map(|i| TAU * f64::from(i) / 720.0);
        angles
            .map(|t| Point3::new(r * t.cos(), r * t.sin(), z))
            .collect()
    };
    rings(
        Point3::origin(),
        &profile.map(ring),
        Point3::new(0.0, 0.0, bottom),
    )
}
