//! Points on large faces: of a coarse mesh the vertices alone do not say where the surface is.

use crate::mesh::Mesh;
use crate::model::Frame;
use crate::sphere::cube_grid;
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// A face is large when two of its corners are seen at more than this angle, in radians: so far apart are the
/// farthest neighbours among a thousand even points.
const LARGE: f64 = 0.25;

/// Cells per edge of the cube of directions in which faces are met: 6146 directions.
const CELLS: usize = 32;

/// How far beyond its edges a face is met, relative to the radius: an edge between two faces belongs to one at least.
const RIM: f64 = 1e-12;

/// A face in the grain's own frame, and the cap of directions that holds it.
struct Face {
    corners: [Vector3<f64>; 3],
    is_large: bool,
    middle: Vector3<f64>,
    /// The cap's angle, in radians.
    angle: f64,
}

impl Face {
    /// `None` of a face with the centre in its plane, which is not seen.
    fn new(corners: [Vector3<f64>; 3]) -> Option<Self> {
        let seen = corners.map(|corner| corner.normalize());
        let [a, b, c] = seen;
        let middle = (a + b + c).try_normalize(0.0)?;
        let cosine = seen.iter().map(|corner| corner.dot(&middle));
        let cosines = [a.dot(&b), b.dot(&c), c.dot(&a)];
        Some(Self {
            corners,
            is_large: cosines.iter().any(|cosine| *cosine < LARGE.cos()),
            middle,
            angle: cosine.fold(1.0, f64::min).acos() + RIM,
        })
    }

    /// The radius in a direction, if the face is met there.
    fn radius(&self, n: &Vector3<f64>) -> Option<f64> {
        let [a, b, c] = &self.corners;
        let normal = (b - a).cross(&(c - a));
        let facing = normal.dot(n);
        let radius = normal.dot(a) / facing;
        let is_inside = |from: &Vector3<f64>, to: &Vector3<f64>| {
            n.dot(&from.cross(to)) * facing.signum() >= -RIM * from.norm() * to.norm()
        };
        let is_met = is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
        (is_met && radius > 0.0 && radius.is_finite()).then_some(radius)
    }

    /// The heights (z) between which the cap lies.
    fn heights(&self) -> [f64; 2] {
        let theta = self.middle.z.clamp(-1.0, 1.0).acos();
        let from = (theta + self.angle).min(PI).cos();
        let to = (theta - self.angle).max(0.0).cos();
        [from - RIM, to + RIM]
    }
}

/// Points on the large faces of a mesh, in the mesh's own frame: even directions in a space in which the ellipsoid of
/// equal second moments is a ball. They depend on no order of faces or corners.
pub(super) fn on_large_faces(
    mesh: &Mesh,
    frame: &Frame,
    semi_axes: &Vector3<f64>,
) -> Vec<Point3<f64>> {
    let local = |corner: u32| frame.to_local(&mesh.vertices[corner as usize]);
    let faces = mesh.triangles.iter();
    let faces: Vec<Face> = faces
        .filter_map(|corners| Face::new(corners.map(local)))
        .collect();
    if !faces.iter().any(|face| face.is_large) {
        return Vec::new();
    }
    let (directions, _) = cube_grid(CELLS);
    let mut directions: Vec<Vector3<f64>> = directions
        .iter()
        .map(|n| n.component_mul(semi_axes).normalize())
        .collect();
    directions.sort_by(|a, b| a.z.total_cmp(&b.z));
    // The farthest face in each direction, for what is within is not seen.
    let mut farthest = vec![(0.0, false); directions.len()];
    for face in &faces {
        let [from, to] = face.heights();
        let first = directions.partition_point(|n| n.z < from);
        for (n, found) in directions.iter().zip(&mut farthest).skip(first) {
            if n.z > to {
                break;
            }
            if let Some(radius) = face.radius(n)
                && radius > found.0
            {
                *found = (radius, face.is_large);
            }
        }
    }
    let met = directions.iter().zip(farthest);
    met.filter(|(_, (_, is_large))| *is_large)
        .map(|(n, (radius, _))| frame.centre + frame.axes * n * radius)
        .collect()
}
