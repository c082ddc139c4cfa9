//! Whether a mesh goes through itself.

use crate::Mesh;
use nalgebra::{Point3, Vector3};
use robust::{Coord3D, orient3d};
use std::collections::HashMap;

/// Most cells of the grid that one triangle may lie in: slivers as long as the body lie in a row of them.
const MOST_CELLS: usize = 1 << 16;

/// The middle of a triangle of a mesh that another one, with which it shares no vertex, goes through; `None` where no
/// two do. What only touches does not count. All triangles must name vertices that exist.
pub fn self_crossing(mesh: &Mesh) -> Option<Point3<f64>> {
    let corners = |i: u32| mesh.triangles[i as usize].map(|v| mesh.vertices[v as usize]);
    let size = 2.0 * mean_side(mesh);
    let cell = |x: f64| (x / size).floor() as i64;
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for index in 0..mesh.triangles.len() as u32 {
        let [a, b, c] = corners(index).map(|corner| corner.coords);
        let (low, high) = (a.inf(&b).inf(&c).map(cell), a.sup(&b).sup(&c).map(cell));
        let counts = (high - low).map(|steps| steps as usize + 1);
        if counts.product() > MOST_CELLS {
            continue;
        }
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    cells.entry([x, y, z]).or_default().push(index);
                }
            }
        }
    }
    let crossed = cells.values().filter_map(|near| {
        let pairs = near
            .iter()
            .enumerate()
            .flat_map(|(at, &i)| near[at + 1..].iter().map(move |&j| (i, j)));
        let crossed = pairs.filter(|&(i, j)| {
            let [one, other] = [i, j].map(|i| mesh.triangles[i as usize]);
            !one.iter().any(|v| other.contains(v)) && cross(&corners(i), &corners(j))
        });
        crossed.map(|(i, _)| i).min()
    });
    let [a, b, c] = corners(crossed.min()?).map(|corner| corner.coords);
    Some(Point3::from((a + b + c) / 3.0))
}

/// Mean of the longest sides of the triangles' boxes.
fn mean_side(mesh: &Mesh) -> f64 {
    let sides = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|v| mesh.vertices[v as usize].coords);
        (a.sup(&b).sup(&c) - a.inf(&b).inf(&c)).amax()
    });
    sides.sum::<f64>() / mesh.triangles.len().max(1) as f64
}

/// Whether an edge of one triangle goes through the other.
fn cross(one: &[Point3<f64>; 3], other: &[Point3<f64>; 3]) -> bool {
    if !boxes_meet(one, other) {
        return false;
    }
    let edges = |[a, b, c]: &[Point3<f64>; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    edges(one).iter().any(|edge| goes_through(edge, other))
        || edges(other).iter().any(|edge| goes_through(edge, one))
}

fn boxes_meet(one: &[Point3<f64>; 3], other: &[Point3<f64>; 3]) -> bool {
    let bounds = |[a, b, c]: &[Point3<f64>; 3]| -> [Vector3<f64>; 2] {
        let (a, b, c) = (&a.coords, &b.coords, &c.coords);
        [a.inf(b).inf(c), a.sup(b).sup(c)]
    };
    let ([low, high], [other_low, other_high]) = (bounds(one), bounds(other));
    (0..3).all(|axis| low[axis] <= other_high[axis] && other_low[axis] <= high[axis])
}

fn goes_through([p, q]: &[Point3<f64>; 2], [a, b, c]: &[Point3<f64>; 3]) -> bool {
    let (from, to) = (side(a, b, c, p), side(a, b, c, q));
    let past = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
    from * to < 0.0 && (past.iter().all(|s| *s > 0.0) || past.iter().all(|s| *s < 0.0))
}

/// Exact sign of the volume of a tetrahedron.
fn side(a: &Point3<f64>, b: &Point3<f64>, c: &Point3<f64>, d: &Point3<f64>) -> f64 {
    let coord = |p: &Point3<f64>| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    };
    orient3d(coord(a), coord(b), coord(c), coord(d)).signum()
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
        assert_eq!(self_crossing(&tube(5.0, 0.0)), None);
        let met = self_crossing(&tube(7.5, 0.0)).expect("ends in one another");
        // Opposite of its middle, which lies along +x.
        assert!(met.x < -0.5, "{met}");
        // A helix passes over itself.
        assert_eq!(self_crossing(&tube(7.5, 0.5)), None);
    }

    #[test]
    fn what_does_not_cross_is_clean_and_nothing_crosses_nothing() {
        assert_eq!(self_crossing(&Mesh::radial(16, |n| 1.0 + 0.5 * n.x)), None);
        assert_eq!(self_crossing(&Mesh::default()), None);
    }
}
