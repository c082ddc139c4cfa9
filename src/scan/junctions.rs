//! Sides of coarse faces on which finer ones have corners (T-junctions), as programs leave them that refine a mesh in part: the
//! coarse faces are parted there, so that they share these corners.

use super::close_gaps::FARTHEST;
use super::topology::{after, open_sides};
use crate::mesh::{Bounds, BoundsTree};
use nalgebra::Point3;
use std::collections::HashMap;

/// A corner is on a side if it is no farther from it than this share of its length, nor than corners that are made one: what is wider is a
/// hole.
const ON_SIDE: f64 = 1e-2;

/// Sides that are compared with a corner, on an average, at most: of sides that all lie on each other nothing is parted.
const COMPARED: usize = 200;

/// For triangles with open sides on which others have corners, these corners, by the number of the side and from its start to its end.
/// Corners at one place have one number; `extent` is the longest side of the scan.
pub(super) fn junctions(
    points: &[Point3<f64>],
    triangles: &[[u32; 3]],
    extent: f64,
) -> HashMap<usize, Vec<u32>> {
    let corners = triangles.as_flattened();
    let open = open_sides(points.len(), triangles);
    let place = |corner: u32| points[corner as usize];
    let ends = |side: usize| [corners[side], corners[after(side)]];
    let reach = FARTHEST * extent;
    let boxes = open
        .iter()
        .map(|&side| Bounds::new(ends(side).map(place), reach));
    let tree = BoundsTree::new(boxes.collect());
    let mut rim: Vec<u32> = open.iter().flat_map(|&side| ends(side)).collect();
    rim.sort_unstable();
    rim.dedup();
    let mut left = COMPARED * rim.len();
    let mut found: HashMap<usize, Vec<(f64, u32)>> = HashMap::new();
    for corner in rim {
        tree.near(&place(corner), 0.0, |leaf| {
            left = left.saturating_sub(leaf.len());
            for &at in &tree.order()[leaf] {
                let side = open[at as usize];
                let is_own = corners[3 * (side / 3)..][..3].contains(&corner);
                let share = on_side(&place(corner), ends(side).map(place), reach);
                if let Some(share) = share.filter(|_| !is_own) {
                    found.entry(side).or_default().push((share, corner));
                }
            }
            // Nothing is nearer than what holds it.
            if left > 0 { 0.0 } else { -1.0 }
        });
    }
    if left == 0 {
        return HashMap::new();
    }
    let in_order = |mut on_side: Vec<(f64, u32)>| {
        on_side.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        on_side.into_iter().map(|(_, corner)| corner).collect()
    };
    found
        .into_iter()
        .map(|(side, corners)| (side, in_order(corners)))
        .collect()
}

/// Where between the ends of a side a place on it lies, as a share of its length.
fn on_side(place: &Point3<f64>, [start, end]: [Point3<f64>; 2], reach: f64) -> Option<f64> {
    let along = end - start;
    let length = along.norm();
    let share = (place - start).dot(&along) / length.powi(2);
    let off = (place - (start + along * share)).norm();
    let is_between = (reach..length - reach).contains(&(share * length));
    (is_between && off <= reach.min(ON_SIDE * length)).then_some(share)
}

/// A triangle parted by corners on its sides, which are given from the first corner on, the longest side first: all parts are wound as it
/// is.
pub(super) fn parted(
    points: &[Point3<f64>],
    corners: [u32; 3],
    on_sides: [&[u32]; 3],
) -> Vec<[u32; 3]> {
    let length = |&side: &usize| {
        let [from, to] =
            [corners[side], corners[(side + 1) % 3]].map(|corner| points[corner as usize]);
        (to - from).norm_squared()
    };
    let with_corners = (0..3).filter(|&side| !on_sides[side].is_empty());
    let Some(first) = with_corners.max_by(|one, other| length(one).total_cmp(&length(other)))
    else {
        return vec![corners];
    };
    let [a, b, c] = [0, 1, 2].map(|k| corners[(first + k) % 3]);
    let [own, next, last] = [0, 1, 2].map(|k| on_sides[(first + k) % 3]);
    let mut parts = Vec::new();
    let mut before = a;
    for &corner in own.iter().chain([&b]) {
        let to = if corner == b { next } else { &[] };
        let back = if before == a { last } else { &[] };
        parts.extend(parted(points, [before, corner, c], [&[], to, back]));
        before = corner;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::super::Scan;
    use super::super::inspect::inspect;
    use crate::mesh::{self, Mesh, is_above};
    use nalgebra::{Point3, Vector3};

    /// A ball of which the faces above some height are cut in four, with the new corners so far outside, as a share of the radius.
    fn refined(height: f64, outside: f64) -> Scan {
        let moved = |middle: Vector3<f64>| middle * (1.0 + outside);
        let ball = Mesh::radial(8, |_| 1.0);
        Scan::of_mesh(mesh::refined(&ball, is_above(height), moved))
    }

    #[test]
    fn faces_that_are_refined_in_part_close() {
        let mut whole = Scan::of_mesh(Mesh::radial(8, |_| 1.0));
        inspect(&mut whole);
        let whole = whole.topology().unwrap().volume;
        for (height, outside) in [(0.0, 0.0), (0.7, 0.0), (0.0, 1e-5)] {
            let mut scan = refined(height, outside);
            inspect(&mut scan);
            let topology = scan.topology().unwrap();
            assert!(
                topology.closed && topology.bodies == 1,
                "{height}, {outside}: {:?}",
                scan.warnings()
            );
            assert!(
                scan.warnings()[0].contains("T-junctions"),
                "{:?}",
                scan.warnings()
            );
            assert!((topology.volume / whole - 1.0).abs() < 1e-12 + 1.5 * outside);
            assert!(topology.volume >= (1.0 - 1e-12) * whole);
        }
    }

    #[test]
    fn holes_stay() {
        let mut scan = Scan::of_mesh(Mesh::radial(8, |_| 1.0));
        scan.triangles.remove(20);
        inspect(&mut scan);
        assert_eq!(scan.topology().unwrap().boundary_edges, 3);
        assert!(!scan.warnings()[0].contains("T-junctions"));
        // Corners that lie farther off leave slits, which are filled.
        let mut scan = refined(0.0, 1e-3);
        inspect(&mut scan);
        let told = scan.warnings();
        assert!(told.len() == 1 && told[0].contains("slits"), "{told:?}");
    }

    #[test]
    fn a_triangle_is_parted_by_corners_along_all_its_sides() {
        let corner = |x: f64, y: f64| Point3::new(x, y, 0.0);
        let points = [
            corner(0.0, 0.0),
            corner(3.0, 0.0),
            corner(0.0, 3.0),
            corner(1.0, 0.0),
            corner(2.0, 0.0),
            corner(1.5, 1.5),
            corner(0.0, 1.0),
        ];
        let parts = super::parted(&points, [0, 1, 2], [&[3, 4], &[5], &[6]]);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|corner| points[corner as usize]);
            (b - a).cross(&(c - a)).dot(&Vector3::z()) / 2.0
        };
        assert_eq!(parts.len(), 5);
        assert!(parts.iter().all(|part| area(part) > 0.0), "{parts:?}");
        assert!((parts.iter().map(area).sum::<f64>() - 4.5).abs() < 1e-12);
    }
}
