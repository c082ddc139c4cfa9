//! Slits of three edges between coarse faces and finer ones, as programs leave them that refine a mesh in part and move the new corners
//! onto a curved surface. Where one ends the next begins, so that without what fills them the faces fall apart.

use super::topology::{after, open_sides};
use nalgebra::Point3;
use std::collections::{HashMap, HashSet};

/// What is higher than this share of its longest edge is a hole.
const NARROW: f64 = 0.1;

/// Slits that meet in a corner, at most.
const MEET: usize = 16;

/// Triangles that fill such slits, wound as the faces about them are. Corners at one place have one number.
pub(super) fn slits(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let corners = triangles.as_flattened();
    let mut rims: HashMap<u32, Vec<u32>> = HashMap::new();
    for side in open_sides(points.len(), triangles) {
        let next = rims.entry(corners[after(side)]).or_default();
        next.push(corners[side]);
    }
    let none = Vec::new();
    let next = |corner: u32| {
        let next = rims.get(&corner).unwrap_or(&none);
        if next.len() <= MEET { next } else { &none }
    };
    let mut starts: Vec<u32> = rims.keys().copied().collect();
    starts.sort_unstable();
    let mut taken = HashSet::new();
    let mut found = Vec::new();
    for a in starts {
        for &b in next(a) {
            for &c in next(b) {
                let do_others_meet = [a, b, c].iter().any(|corner| next(*corner).len() > 1);
                let is_slit = do_others_meet && next(c).contains(&a);
                if !is_slit || !is_narrow([a, b, c].map(|corner| points[corner as usize])) {
                    continue;
                }
                let edges = [[a, b], [b, c], [c, a]];
                if edges.iter().all(|edge| !taken.contains(edge)) {
                    taken.extend(edges);
                    found.push([a, b, c]);
                }
            }
        }
    }
    found
}

fn is_narrow([a, b, c]: [Point3<f64>; 3]) -> bool {
    let longest = [b - a, c - b, a - c]
        .iter()
        .fold(0.0_f64, |most, edge| most.max(edge.norm_squared()));
    (b - a).cross(&(c - a)).norm() <= NARROW * longest
}

#[cfg(test)]
mod tests {
    use super::super::Scan;
    use super::*;
    use crate::mesh::{Mesh, is_above, refined};
    use std::f64::consts::PI;

    /// A ball of which the upper half is cut in four, with new corners on the ball.
    fn ball() -> Mesh {
        let ball = Mesh::radial(8, |_| 1.0);
        refined(&ball, is_above(0.0), |middle| middle.normalize())
    }

    #[test]
    fn slits_along_a_seam_close_and_are_told() {
        let scan = Scan::from_mesh(ball()).unwrap();
        let topology = scan.topology().unwrap();
        assert!(
            topology.closed && topology.bodies == 1,
            "{:?}",
            scan.warnings()
        );
        let share = topology.volume / (4.0 / 3.0 * PI);
        assert!((0.97..1.0).contains(&share), "{share}");
        let told = &scan.warnings()[0];
        assert!(
            told.starts_with("Filled 32 slits between coarse faces and finer ones: "),
            "{told}"
        );
    }

    #[test]
    fn what_is_wider_or_meets_no_other_is_a_hole() {
        // One of three parts of a face, which has a corner near one of its edges.
        let mut mesh = Mesh::radial(8, |_| 1.0);
        let [a, b, c] = mesh.triangles.swap_remove(0);
        let place = |corner: u32| mesh.vertices[corner as usize].coords;
        let beside = 0.49 * (place(a) + place(b)) + 0.02 * place(c);
        let corner = mesh.vertices.len() as u32;
        mesh.vertices.push(beside.into());
        mesh.triangles.extend([[b, c, corner], [c, a, corner]]);
        let scan = Scan::from_mesh(mesh).unwrap();
        assert_eq!(scan.topology().unwrap().boundary_edges, 3);
        let corner = |x: f64, y: f64| Point3::new(x, y, 0.0);
        assert!(is_narrow([
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(0.5, 0.09)
        ]));
        assert!(!is_narrow([
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(0.5, 0.11)
        ]));
    }
}
