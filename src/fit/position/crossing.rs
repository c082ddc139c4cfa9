//! Whether a surface goes through itself.

use crate::model::Position;
use crate::sphere::cube_grid;
use nalgebra::Vector3;
use robust::{Coord3D, orient3d};

/// Cells per edge of the cube of directions in which the surface is meshed: 13 826 vertices.
const RESOLUTION: usize = 48;

/// Pairs of triangles of the surface's mesh that cross without sharing a vertex.
pub(super) fn crossings(surface: &Position) -> usize {
    let (directions, triangles) = cube_grid(RESOLUTION);
    let points = surface.points_and_tangents(&directions);
    let mut sorted: Vec<Triangle> = triangles
        .into_iter()
        .map(|corners| Triangle::new(corners, corners.map(|corner| points[corner as usize].0)))
        .collect();
    sorted.sort_by(|one, other| one.low.x.total_cmp(&other.low.x));
    let mut count = 0;
    for (at, one) in sorted.iter().enumerate() {
        let beside = sorted[at + 1..]
            .iter()
            .take_while(|other| other.low.x <= one.high.x);
        count += beside.filter(|other| one.crosses(other)).count();
    }
    count
}

struct Triangle {
    corners: [u32; 3],
    points: [Vector3<f64>; 3],
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Triangle {
    fn new(corners: [u32; 3], points: [Vector3<f64>; 3]) -> Self {
        let [a, b, c] = &points;
        Self {
            corners,
            low: a.inf(b).inf(c),
            high: a.sup(b).sup(c),
            points,
        }
    }

    fn crosses(&self, other: &Self) -> bool {
        let is_apart = (0..3)
            .any(|axis| self.low[axis] > other.high[axis] || other.low[axis] > self.high[axis]);
        let is_joined = self
            .corners
            .iter()
            .any(|corner| other.corners.contains(corner));
        !is_apart && !is_joined && (self.is_pierced_by(other) || other.is_pierced_by(self))
    }

    /// Whether an edge of another triangle goes through this one.
    fn is_pierced_by(&self, other: &Self) -> bool {
        let [a, b, c] = self.points;
        let [p, q, r] = other.points;
        [(p, q), (q, r), (r, p)].into_iter().any(|(p, q)| {
            is_left([a, b, c], p) != is_left([a, b, c], q) && {
                let side = is_left([p, q, a], b);
                side == is_left([p, q, b], c) && side == is_left([p, q, c], a)
            }
        })
    }
}

/// The side of a plane on which a point lies; exact.
fn is_left(plane: [Vector3<f64>; 3], point: Vector3<f64>) -> bool {
    let coordinates = |v: Vector3<f64>| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    };
    let [a, b, c] = plane.map(coordinates);
    orient3d(a, b, c, coordinates(point)) > 0.0
}
