//! Where a mesh goes through itself.

use crate::Mesh;
use crate::mesh::{Bounds, BoundsTree};
use crate::predicates::orient3d;
use nalgebra::Point3;

/// The side of a plane on which a point lies, 1 or -1; 0 is no side.
type Side = fn([Point3<f64>; 3], Point3<f64>) -> i8;

/// The pairs of triangles of a mesh, by their indices, that go through one another and share no vertex. An edge that goes
/// exactly through another edge counts; so may what only touches. All triangles must name vertices that exist.
pub fn crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    pairs(mesh, |plane, point| match orient3d(plane, point) > 0.0 {
        true => 1,
        false => -1,
    })
}

/// The same without what touches, and without edges that go exactly through an edge.
pub(super) fn clear_crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    pairs(mesh, |plane, point| {
        let volume = orient3d(plane, point);
        i8::from(volume > 0.0) - i8::from(volume < 0.0)
    })
}

fn pairs(mesh: &Mesh, side: Side) -> Vec<[usize; 2]> {
    let points = |corners: &[u32; 3]| corners.map(|i| mesh.vertices[i as usize]);
    let triangles = mesh.triangles.iter().map(points);
    let boxes: Vec<Bounds> = triangles.map(|points| Bounds::new(points, 0.0)).collect();
    let tree = BoundsTree::new(boxes.clone());
    let mut found = Vec::new();
    for (one, bounds) in boxes.iter().enumerate() {
        let corners = &mesh.triangles[one];
        let crosses = |&two: &usize| {
            let others = &mesh.triangles[two];
            let is_joined = || corners.iter().any(|corner| others.contains(corner));
            let [own, other] = [corners, others].map(points);
            let is_crossed = || is_pierced(own, other, side) || is_pierced(other, own, side);
            one < two && !is_joined() && is_crossed()
        };
        let beside = tree.meeting(bounds).map(|two| two as usize);
        found.extend(beside.filter(crosses).map(|two| [one, two]));
    }
    found
}

/// Whether an edge of another triangle goes through a triangle, by exact sides.
fn is_pierced([a, b, c]: [Point3<f64>; 3], [p, q, r]: [Point3<f64>; 3], side: Side) -> bool {
    let sides = [p, q, r].map(|corner| side([a, b, c], corner));
    let edges = [(p, q), (q, r), (r, p)];
    (0..3).any(|edge| {
        let (p, q) = edges[edge];
        sides[edge] * sides[(edge + 1) % 3] < 0 && {
            let passed = side([p, q, a], b);
            passed != 0 && passed == side([p, q, b], c) && passed == side([p, q, c], a)
        }
    })
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

    /// A large triangle in the plane z = 0 and a small one, whose lowest corner is at this height.
    fn two_triangles(low: f64) -> Mesh {
        let corners = [
            [0.2, 0.2, low],
            [0.3, 0.2, 1.0],
            [0.2, 0.3, 1.0],
            [-5.0, -5.0, 0.0],
            [5.0, -5.0, 0.0],
            [0.0, 5.0, 0.0],
        ];
        Mesh {
            vertices: corners.map(Point3::from).into(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        }
    }

    #[test]
    fn a_triangle_that_pierces_another_crosses_it_whichever_is_first() {
        let mut mesh = two_triangles(-1.0);
        for _ in 0..2 {
            assert_eq!(crossings(&mesh), [[0, 1]]);
            assert_eq!(clear_crossings(&mesh), [[0, 1]]);
            mesh.triangles.reverse();
        }
    }

    #[test]
    fn what_touches_does_not_clearly_cross() {
        assert!(clear_crossings(&two_triangles(0.0)).is_empty());
    }

    #[test]
    fn what_does_not_cross_is_clean_and_nothing_crosses_nothing() {
        assert!(crossings(&Mesh::radial(16, |n| 1.0 + 0.5 * n.x)).is_empty());
        assert!(crossings(&Mesh::default()).is_empty());
    }
}
