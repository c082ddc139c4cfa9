//! Corners of loose triangles that nearly coincide, as those that were computed anew for every triangle, are made one.

use super::Scan;
use super::topology::{after, open_sides};
use super::weld::first_at_same_place;
use crate::digits::plural;
use crate::disjoint_sets::DisjointSets;
use crate::mesh::edges;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::{Point3, Vector3};
use std::num::NonZero;

/// Corners of open rims are one where they are nearer than this share of every edge that ends at them, ...
const OF_EDGES: f64 = 0.25;

/// ... and of the longest side of the scan. Corners that were rounded to 32 bits differ by some 2e-7 of it; two thin sheets that are
/// open along their rims may be 3e-4 apart.
pub(super) const FARTHEST: f64 = 3e-5;

/// Nearest corners that each is compared with: through these it reaches all that meet at a place.
const COMPARED: NonZero<usize> = NonZero::new(16).unwrap();

/// Places of corners per triangle from which on triangles are loose: a closed surface has half a place for each, and triangles that
/// share none have three.
const LOOSE: f64 = 1.5;

/// Whether the triangles of a scan share few corners.
pub(super) fn are_loose(scan: &Scan) -> bool {
    let are_too_many = |places: usize| places as f64 > LOOSE * scan.triangles.len() as f64;
    if scan.triangles.is_empty() || !are_too_many(scan.points.len()) {
        return false;
    }
    let same = first_at_same_place(&scan.points);
    let corners = scan.triangles.as_flattened().iter();
    let mut places: Vec<u32> = corners.map(|&corner| same[corner as usize]).collect();
    places.sort_unstable();
    places.dedup();
    are_too_many(places.len())
}

/// Makes one, in their middle, of the corners along open rims that nearly coincide, whatever their order, and says so in a warning.
pub(super) fn close_gaps(scan: &mut Scan, extent: f64) {
    let same = nearly_same(scan, extent);
    let mut shifts = vec![(Vector3::zeros(), 0.0); scan.points.len()];
    for (point, &first) in scan.points.iter().zip(&same) {
        let (sum, count) = &mut shifts[first as usize];
        *sum += point - scan.points[first as usize];
        *count += 1.0;
    }
    let mut kept: Vec<Point3<f64>> = Vec::with_capacity(scan.points.len());
    let mut numbers: Vec<u32> = Vec::with_capacity(scan.points.len());
    let mut farthest = 0.0_f64;
    for (point, (own, &first)) in scan.points.iter().zip(same.iter().enumerate()) {
        let (sum, count) = shifts[first as usize];
        let middle = scan.points[first as usize] + sum / count;
        farthest = farthest.max((point - middle).norm());
        if first as usize == own {
            numbers.push(kept.len() as u32);
            kept.push(middle);
        } else {
            numbers.push(numbers[first as usize]);
        }
    }
    let merged = scan.points.len() - kept.len();
    if merged == 0 {
        return;
    }
    scan.warnings.push(format!(
        "Merged {} along open rims with others: none was moved by more than {farthest:.1e}.",
        plural(merged, "corner"),
    ));
    scan.points = kept;
    for corner in scan.triangles.as_flattened_mut() {
        *corner = numbers[*corner as usize];
    }
}

/// For each corner the first of those that it is to be one with: those that hang together by pairs within reach, unless a face would
/// lose a corner.
fn nearly_same(scan: &Scan, extent: f64) -> Vec<u32> {
    let mut sets = DisjointSets::new(scan.points.len());
    for [one, other] in pairs(scan, extent) {
        sets.join(one, other);
    }
    let first: Vec<u32> = (0..scan.points.len() as u32)
        .map(|own| sets.of(own))
        .collect();
    let mut are_apart = vec![false; scan.points.len()];
    for [from, to] in sides(scan) {
        are_apart[first[from as usize] as usize] |= first[from as usize] == first[to as usize];
    }
    let own = (0..).zip(first);
    own.map(|(own, first)| match are_apart[first as usize] {
        true => own,
        false => first,
    })
    .collect()
}

/// Pairs of corners along open rims that are near each other.
fn pairs(scan: &Scan, extent: f64) -> Vec<[u32; 2]> {
    let rim = rim(scan);
    let place = |corner: u32| (scan.points[corner as usize] - scan.points[0]) / extent;
    let places: Vec<[f64; 3]> = rim.iter().map(|&corner| place(corner).into()).collect();
    let tree = ImmutableKdTree::<f64, 3>::new_from_slice(&places);
    let Some(tree) = tree.ok().filter(|_| !places.is_empty()) else {
        return Vec::new();
    };
    let mut reach = vec![FARTHEST; scan.points.len()];
    for ends in sides(scan) {
        let edge = (place(ends[1]) - place(ends[0])).norm();
        for end in ends {
            reach[end as usize] = reach[end as usize].min(OF_EDGES * edge);
        }
    }
    let near = rim.iter().zip(&places).flat_map(|(&own, place)| {
        let near = tree
            .query(place)
            .nearest_n::<SquaredEuclidean<f64>>(COMPARED);
        let near = near.execute().into_iter();
        near.map(|hit| (hit.distance.sqrt(), [own, rim[hit.item as usize]]))
            .collect::<Vec<_>>()
    });
    near.filter(|(apart, ends)| ends.iter().all(|&end| *apart <= reach[end as usize]))
        .map(|(_, ends)| ends)
        .collect()
}

/// The sides of the triangles, from corner to corner, without those that have no length.
fn sides(scan: &Scan) -> impl Iterator<Item = [u32; 2]> {
    let sides = scan.triangles.iter().flat_map(edges);
    sides.filter(|[from, to]| from != to)
}

/// The corners along open rims, in order.
fn rim(scan: &Scan) -> Vec<u32> {
    let corners = scan.triangles.as_flattened();
    let open = open_sides(scan.points.len(), &scan.triangles).into_iter();
    let ends = open.flat_map(|side| [corners[side], corners[after(side)]]);
    let mut rim: Vec<u32> = ends.collect();
    rim.sort_unstable();
    rim.dedup();
    rim
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// The faces of a mesh, each with corners of its own, moved by so much whichever way.
    fn loose(mesh: &Mesh, step: f64) -> Scan {
        let mut scan = Scan::default();
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            step * ((seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0)
        };
        for corners in &mesh.triangles {
            for &corner in corners {
                let shift = Vector3::from_fn(|_, _| random());
                scan.points.push(mesh.vertices[corner as usize] + shift);
            }
            let first = 3 * scan.triangles.len() as u32;
            scan.triangles.push([first, first + 1, first + 2]);
        }
        scan
    }

    fn ball() -> Mesh {
        Mesh::radial(8, |_| 0.5)
    }

    #[test]
    fn triangles_with_corners_of_their_own_are_loose() {
        let ball = Mesh::radial(6, |_| 1.0);
        assert!(are_loose(&loose(&ball, 1e-6)));
        assert!(!are_loose(&loose(&ball, 0.0)));
        let mut beside = Scan::of_mesh(ball);
        assert!(!are_loose(&beside));
        // Points of no triangle are no corners.
        let points = beside.points.clone();
        beside
            .points
            .extend((1..9).flat_map(|k| points.iter().map(move |p| p * f64::from(k + 1))));
        assert!(!are_loose(&beside));
    }

    #[test]
    fn corners_within_reach_are_merged_and_reported() {
        for step in [0.0, 1e-7, 1e-6, 5e-6] {
            let mut scan = loose(&ball(), step);
            let corners = scan.points.len();
            close_gaps(&mut scan, 1.0);
            let mesh = Mesh {
                vertices: scan.points.clone(),
                triangles: scan.triangles.clone(),
            };
            assert_eq!(mesh.check_closed(), Ok(()), "{step}");
            assert_eq!(scan.points.len(), ball().vertices.len());
            let merged = corners - scan.points.len();
            let told = format!("Merged {merged} corners along open rims with others: ");
            assert!(scan.warnings[0].starts_with(&told), "{:?}", scan.warnings);
        }
    }

    /// Places beside the borders of any cells are no different, and neither is the order.
    #[test]
    fn the_order_does_not_matter() {
        let mut scan = loose(&ball(), 1e-6);
        let mut reversed = scan.clone();
        reversed.points.reverse();
        let last = scan.points.len() as u32 - 1;
        for corner in reversed.triangles.as_flattened_mut() {
            *corner = last - *corner;
        }
        close_gaps(&mut scan, 1.0);
        close_gaps(&mut reversed, 1.0);
        assert_eq!(scan.warnings, reversed.warnings);
        for (one, other) in scan.triangles.iter().zip(&reversed.triangles) {
            for (one, other) in one.iter().zip(other) {
                let apart = scan.points[*one as usize] - reversed.points[*other as usize];
                assert!(apart.norm() < 1e-15);
            }
        }
    }

    #[test]
    fn corners_farther_apart_stay() {
        let mut scan = loose(&ball(), 0.01);
        close_gaps(&mut scan, 1.0);
        assert_eq!(scan, loose(&ball(), 0.01));
    }

    /// Between two corners of a narrow face there are corners of others, each near the next.
    #[test]
    fn no_face_loses_a_corner() {
        let face = |tip: f64, z: f64| [[tip, 0.0, 0.0], [0.5, -1.0, z], [1.0, -0.5, z]];
        let mut faces = vec![[[0.0, 0.0, 0.0], [1e-4, 0.0, 0.0], [0.0, 1.0, 0.0]]];
        faces.extend((1..5).map(|at| face(2e-5 * f64::from(at), 0.1 * f64::from(at))));
        let scan = Scan {
            points: faces.as_flattened().iter().map(|&c| c.into()).collect(),
            triangles: (0..5)
                .map(|face| [0, 1, 2].map(|corner| 3 * face + corner))
                .collect(),
            ..Scan::default()
        };
        let mut merged = scan.clone();
        close_gaps(&mut merged, 1.0);
        assert_eq!(merged, scan);
        // Without that face they are one.
        merged.triangles.remove(0);
        close_gaps(&mut merged, 1.0);
        assert_eq!(merged.points.len(), scan.points.len() - 3);
    }
}
