//! Where a mesh goes through itself.

use crate::Mesh;
use nalgebra::Point3;
use robust::{Coord3D, orient3d};

/// The pairs of triangles of a mesh, by their indices, that go through one another and share no vertex. What only
/// touches does not count. All triangles must name vertices that exist.
pub fn crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    let triangles = mesh.triangles.iter().enumerate();
    let mut sorted: Vec<Triangle> = triangles
        .map(|(index, corners)| {
            Triangle::new(index, *corners, corners.map(|i| mesh.vertices[i as usize]))
        })
        .collect();
    sorted.sort_by(|one, other| one.low.x.total_cmp(&other.low.x));
    let mut found = Vec::new();
    for (at, one) in sorted.iter().enumerate() {
        let beside = sorted[at + 1..]
            .iter()
            .take_while(|other| other.low.x <= one.high.x);
        let crossed = beside.filter(|other| one.crosses(other));
        found.extend(crossed.map(|other| [one.index, other.index]));
    }
    found
}

struct Triangle {
    index: usize,
    corners: [u32; 3],
    points: [Point3<f64>; 3],
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Triangle {
    fn new(index: usize, corners: [u32; 3], points: [Point3<f64>; 3]) -> Self {
        let [a, b, c] = &points;
        Self {
            index,
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
fn is_left(plane: [Point3<f64>; 3], point: Point3<f64>) -> bool {
    let coordinates = |v: Point3<f64>| Coord3D {
        x: v.x,
        y: v.y,
        z: v.z,
    };
    let [a, b, c] = plane.map(coordinates);
    orient3d(a, b, c, coordinates(point)) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tube bent round the z axis by `turn` radians at radius 1, flat ends drawn to points.
    fn tube(turn: f64, rise: f64) -> Mesh {
        let mut mesh = Mesh::radial(24, |_| 1.0);
        for vertex in &mut mesh.vertices {
            let (along, across) = (0.5 * turn * vertex.x, [0.2 * vertex.y, 0.2 * vertex.z]);
            let (sin, cos) = along.sin_cos();
            let out = 1.0 + across[0];
            *vertex = Point3::new(out * cos, out * sin, across[1] + rise * vertex.x);
        }
        mesh
    }

    #[test]
    fn a_bent_tube_crosses_itself_where_its_ends_meet() {
        assert!(crossings(&tube(5.0, 0.0)).is_empty());
        let met = tube(7.5, 0.0);
        let pairs = crossings(&met);
        assert!(!pairs.is_empty());
        for triangle in pairs.into_iter().flatten() {
            // Opposite of its middle, which lies along +x.
            let corner = met.vertices[met.triangles[triangle][0] as usize];
            assert!(corner.x < -0.5, "{corner}");
        }
        // A helix passes over itself.
        assert!(crossings(&tube(7.5, 0.5)).is_empty());
    }

    #[test]
    fn what_does_not_cross_is_clean_and_nothing_crosses_nothing() {
        assert!(crossings(&Mesh::radial(16, |n| 1.0 + 0.5 * n.x)).is_empty());
        assert!(crossings(&Mesh::default()).is_empty());
    }
}
