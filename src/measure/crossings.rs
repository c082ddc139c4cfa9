//! Where a mesh goes through itself.

use crate::Mesh;
use crate::mesh::{Bounds, BoundsTree};
use crate::predicates::orient3d;
use nalgebra::Point3;
use thiserror::Error;

/// The side of a plane on which a point lies, 1 or -1; 0 is no side.
type Side = fn([Point3<f64>; 3], Point3<f64>) -> i8;

/// The corners of a triangle.
type Corners = [Point3<f64>; 3];

/// A triangle names a vertex that does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("triangle {triangle} names a vertex that does not exist")]
pub struct MissingVertex {
    /// Position of the triangle in the mesh.
    pub triangle: usize,
}

/// The pairs of triangles of a mesh, by their indices, that go through one another and share no vertex. An edge that goes
/// exactly through another edge counts; so may what only touches.
///
/// # Errors
///
/// [`MissingVertex`] if a triangle names a vertex that does not exist.
pub fn crossings(mesh: &Mesh) -> Result<Vec<[usize; 2]>, MissingVertex> {
    let is_broken = |corners: &[u32; 3]| {
        let mut corners = corners.iter();
        corners.any(|&corner| corner as usize >= mesh.vertices.len())
    };
    match mesh.triangles.iter().position(is_broken) {
        Some(triangle) => Err(MissingVertex { triangle }),
        None => Ok(sound_crossings(mesh)),
    }
}

/// The same of a mesh whose vertices all exist.
pub(crate) fn sound_crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    pairs(mesh, any_side, |_, _| false)
}

/// The same without what touches, and without edges that go exactly through an edge; all vertices must exist.
pub(super) fn clear_crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    pairs(mesh, clear_side, |_, _| false)
}

/// The same as [`crossings`], with triangles that share one vertex and clearly go through one another.
pub(super) fn all_crossings(mesh: &Mesh) -> Vec<[usize; 2]> {
    pairs(mesh, any_side, |[a, b, c], [_, q, r]| {
        is_passed([a, b, c], [q, r]) || is_passed([a, q, r], [b, c])
    })
}

/// Whether two triangles go through one another, and do not only touch.
pub(super) fn is_clear(one: Corners, other: Corners) -> bool {
    are_crossing(one, other, clear_side)
}

fn any_side(plane: Corners, point: Point3<f64>) -> i8 {
    match orient3d(plane, point) > 0.0 {
        true => 1,
        false => -1,
    }
}

fn clear_side(plane: Corners, point: Point3<f64>) -> i8 {
    let volume = orient3d(plane, point);
    i8::from(volume > 0.0) - i8::from(volume < 0.0)
}

/// The pairs that cross by these sides; of two that share one vertex, the first of each, `joined` tells it.
fn pairs(
    mesh: &Mesh,
    side: Side,
    joined: impl Fn(Corners, Corners) -> bool + Sync,
) -> Vec<[usize; 2]> {
    let points = |corners: &[u32; 3]| corners.map(|i| mesh.vertices[i as usize]);
    let triangles = mesh.triangles.iter().map(points);
    let boxes = triangles.map(|points| Bounds::new(points, 0.0));
    let crosses = |pair: [u32; 2]| {
        let [own, others] = pair.map(|at| mesh.triangles[at as usize]);
        let mut shared = own.into_iter().filter(|corner| others.contains(corner));
        match (shared.next(), shared.next()) {
            (None, _) => are_crossing(points(&own), points(&others), side),
            (Some(first), None) => joined(
                points(&rotated(own, first)),
                points(&rotated(others, first)),
            ),
            _ => false,
        }
    };
    let found = BoundsTree::new(boxes.collect()).own_pairs(crosses);
    let wide = found.into_iter().map(|pair| pair.map(|at| at as usize));
    wide.collect()
}

/// The corners of a triangle from one of them on.
fn rotated([a, b, c]: [u32; 3], first: u32) -> [u32; 3] {
    match first {
        _ if first == b => [b, c, a],
        _ if first == c => [c, a, b],
        _ => [a, b, c],
    }
}

fn are_crossing(one: Corners, other: Corners, side: Side) -> bool {
    let sides = |plane: Corners, corners: Corners| corners.map(|corner| side(plane, corner));
    let is_beside = |[a, b, c]: [i8; 3]| a != 0 && a == b && b == c;
    let of_other = sides(one, other);
    !is_beside(of_other) && {
        let of_one = sides(other, one);
        is_pierced(one, other, of_other, side) || is_pierced(other, one, of_one, side)
    }
}

/// Whether an edge of another triangle, whose corners lie on these sides, goes through a triangle.
fn is_pierced(triangle: Corners, [p, q, r]: Corners, sides: [i8; 3], side: Side) -> bool {
    let edges = [[p, q], [q, r], [r, p]];
    (0..3).any(|edge| {
        sides[edge] * sides[(edge + 1) % 3] < 0 && is_within(triangle, edges[edge], side)
    })
}

/// Whether an edge clearly goes through a triangle.
fn is_passed(triangle: Corners, edge: [Point3<f64>; 2]) -> bool {
    let [before, after] = edge.map(|end| clear_side(triangle, end));
    before * after < 0 && is_within(triangle, edge, clear_side)
}

/// Whether the line of an edge goes through a triangle.
fn is_within([a, b, c]: Corners, [p, q]: [Point3<f64>; 2], side: Side) -> bool {
    let passed = side([p, q, a], b);
    passed != 0 && passed == side([p, q, b], c) && passed == side([p, q, c], a)
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
        assert!(crossings(&tube(5.0, 0.0)).unwrap().is_empty());
        let met = tube(7.5, 0.0);
        let pairs = crossings(&met).unwrap();
        assert!(!pairs.is_empty());
        for triangle in pairs.into_iter().flatten() {
            // Opposite of its middle, which lies along +x.
            let corner = met.vertices[met.triangles[triangle][0] as usize];
            assert!(corner.x < -0.5, "{corner}");
        }
        // A helix passes over itself.
        assert!(crossings(&tube(7.5, 0.5)).unwrap().is_empty());
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
            assert_eq!(crossings(&mesh), Ok(vec![[0, 1]]));
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
        assert_eq!(
            crossings(&Mesh::radial(16, |n| 1.0 + 0.5 * n.x)),
            Ok(vec![])
        );
        assert_eq!(crossings(&Mesh::default()), Ok(vec![]));
    }

    #[test]
    fn a_vertex_that_does_not_exist_is_named_by_its_triangle() {
        let mut mesh = two_triangles(-1.0);
        mesh.triangles.push([0, 6, 1]);
        assert_eq!(crossings(&mesh), Err(MissingVertex { triangle: 2 }));
    }
}
