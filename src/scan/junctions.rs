//! Sides of coarse faces along which finer ones have corners (T-junctions), as programs leave them that refine a mesh in part: the
//! coarse faces are parted there, so that they share these corners.

use super::topology::{after, each_edge};
use nalgebra::Point3;
use std::collections::HashMap;

/// A corner lies along a side if it is no farther from it than this share of its length: what lies between them is no hole.
const ALONG: f64 = 0.05;

/// Corners along one side, at most.
const MOST: usize = 64;

/// An open side of a triangle: the end it goes to, and its number.
type OpenSide = (u32, usize);

/// For triangles with open sides along which those of others run, the corners of these others, by the number of the side and from
/// its start to its end.
pub(super) fn junctions(
    points: &[Point3<f64>],
    triangles: &[[u32; 3]],
) -> HashMap<usize, Vec<u32>> {
    let corners = triangles.as_flattened();
    let mut open: Vec<usize> = Vec::new();
    each_edge(points.len(), triangles, |edge| {
        if let [side] = edge.sides {
            open.push(*side);
        }
    });
    open.sort_unstable();
    let mut from: HashMap<u32, Vec<OpenSide>> = HashMap::new();
    for &side in &open {
        let leaving = from.entry(corners[side]).or_default();
        leaving.push((corners[after(side)], side));
    }
    let mut is_closed = vec![false; corners.len()];
    let mut found = HashMap::new();
    for side in open {
        let ends = [corners[side], corners[after(side)]];
        let opposite = corners[after(after(side))];
        let Some(along) = run_back(points, ends, opposite, &from) else {
            continue;
        };
        if along.iter().any(|(_, own)| is_closed[*own]) || is_closed[side] {
            continue;
        }
        for (_, own) in &along {
            is_closed[*own] = true;
        }
        is_closed[side] = true;
        let inner = along[..along.len() - 1].iter().rev();
        found.insert(side, inner.map(|(corner, _)| *corner).collect());
    }
    found
}

/// The open sides of others, two or more, that run back along one of a triangle, from its end to its start.
fn run_back(
    points: &[Point3<f64>],
    [start, end]: [u32; 2],
    opposite: u32,
    from: &HashMap<u32, Vec<OpenSide>>,
) -> Option<Vec<OpenSide>> {
    let place = |corner: u32| points[corner as usize];
    let side = place(end) - place(start);
    let share = |corner: u32| (place(corner) - place(start)).dot(&side) / side.norm_squared();
    let is_along = |corner: u32, before: f64| {
        let share = share(corner);
        let foot = place(start) + side * share;
        let off = (place(corner) - foot).norm();
        corner != opposite && share > 0.0 && share < before && off <= ALONG * side.norm()
    };
    from.get(&end)?.iter().find_map(|first| {
        let mut run = vec![*first];
        let mut before = 1.0;
        while let Some(&(corner, _)) = run.last() {
            if corner == start {
                return Some(run);
            }
            let [next] = from.get(&corner)?.as_slice() else {
                return None;
            };
            if run.len() > MOST || !is_along(corner, before) {
                return None;
            }
            before = share(corner);
            run.push(*next);
        }
        None
    })
}

/// A triangle parted by corners along its sides, which are given from the first corner on: all parts are wound as it is.
pub(super) fn parted(corners: [u32; 3], along: [&[u32]; 3]) -> Vec<[u32; 3]> {
    let Some(first) = along.iter().position(|inner| !inner.is_empty()) else {
        return vec![corners];
    };
    let [a, b, c] = [0, 1, 2].map(|k| corners[(first + k) % 3]);
    let [own, next, last] = [0, 1, 2].map(|k| along[(first + k) % 3]);
    let mut parts = Vec::new();
    let mut before = a;
    for &corner in own.iter().chain([&b]) {
        let to = if corner == b { next } else { &[] };
        let back = if before == a { last } else { &[] };
        parts.extend(parted([before, corner, c], [&[], to, back]));
        before = corner;
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::super::Scan;
    use super::super::inspect::inspect;
    use crate::mesh::Mesh;
    use nalgebra::{Point3, Vector3};
    use std::collections::HashMap;

    /// A ball of which the faces above some height are cut in four, with the new corners so far outside, as a share of the radius.
    fn refined(height: f64, outside: f64) -> Scan {
        let Mesh {
            mut vertices,
            triangles,
        } = Mesh::radial(8, |_| 1.0);
        let mut middles = HashMap::new();
        let mut fine = Vec::new();
        for corners in triangles {
            let places = corners.map(|corner| vertices[corner as usize]);
            if places.iter().map(|place| place.z).sum::<f64>() < 3.0 * height {
                fine.push(corners);
                continue;
            }
            let [x, y, z] = [0, 1, 2].map(|side| {
                let [a, b] = [corners[side], corners[(side + 1) % 3]];
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    let middle = nalgebra::center(&vertices[a as usize], &vertices[b as usize]);
                    vertices.push(middle + outside * middle.coords);
                    vertices.len() as u32 - 1
                })
            });
            let [a, b, c] = corners;
            fine.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]);
        }
        Scan {
            points: vertices,
            triangles: fine,
            ..Scan::default()
        }
    }

    #[test]
    fn faces_that_are_refined_in_part_close() {
        let mut whole = Scan::of_mesh(Mesh::radial(8, |_| 1.0));
        inspect(&mut whole);
        let whole = whole.topology().unwrap().volume;
        for (height, outside) in [(0.0, 0.0), (0.7, 0.0), (0.0, 0.005)] {
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
        // Corners that lie farther off than what is between faces may.
        let mut scan = refined(0.0, 0.05);
        inspect(&mut scan);
        assert!(!scan.topology().unwrap().closed);
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
        let parts = super::parted([0, 1, 2], [&[3, 4], &[5], &[6]]);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|corner| points[corner as usize]);
            (b - a).cross(&(c - a)).dot(&Vector3::z()) / 2.0
        };
        assert_eq!(parts.len(), 5);
        assert!(parts.iter().all(|part| area(part) > 0.0), "{parts:?}");
        assert!((parts.iter().map(area).sum::<f64>() - 4.5).abs() < 1e-12);
    }
}
