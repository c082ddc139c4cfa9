//! Corners along open rims that nearly coincide, as those that were computed anew for every triangle or patch, are made one.

use super::Scan;
use super::topology::{after, joined, open_sides};
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

/// Makes one, in their middle, of the corners along open rims that nearly coincide, whatever their order, and says so in a warning.
/// `same` has for each point the first one at the same place; `extent` is the longest side of the scan. Whether there were such.
pub(super) fn close_gaps(scan: &mut Scan, same: &[u32], extent: f64) -> bool {
    let first = nearly_same(scan, same, extent);
    let mut shifts = vec![(Vector3::zeros(), 0.0); scan.points.len()];
    for (point, &first) in scan.points.iter().zip(&first) {
        let (sum, count) = &mut shifts[first as usize];
        *sum += point - scan.points[first as usize];
        *count += 1.0;
    }
    let mut kept: Vec<Point3<f64>> = Vec::with_capacity(scan.points.len());
    let mut numbers: Vec<u32> = Vec::with_capacity(scan.points.len());
    let mut farthest = 0.0_f64;
    for (point, (own, &first)) in scan.points.iter().zip(first.iter().enumerate()) {
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
        return false;
    }
    scan.warnings.push(format!(
        "Merged {} along open rims with others: none was moved by more than {farthest:.1e}.",
        plural(merged, "corner"),
    ));
    scan.points = kept;
    for corner in scan.triangles.as_flattened_mut() {
        *corner = numbers[*corner as usize];
    }
    true
}

/// For each point the first of those that it is to be one with: those whose places hang together by pairs within reach, unless a face
/// would lose a corner.
fn nearly_same(scan: &Scan, same: &[u32], extent: f64) -> Vec<u32> {
    let triangles = joined(&scan.triangles, same);
    let mut sets = DisjointSets::new(scan.points.len());
    let mut stays = vec![true; scan.points.len()];
    for [one, other] in pairs(&scan.points, &triangles, extent) {
        sets.join(one, other);
        stays[one as usize] = false;
        stays[other as usize] = false;
    }
    for ends in sides(&triangles) {
        let [from, to] = ends.map(|end| sets.of(end));
        if from == to {
            stays[from as usize] = true;
        }
    }
    let first = |(own, &place): (u32, &u32)| {
        let first = sets.of(place);
        if stays[first as usize] { own } else { first }
    };
    (0..).zip(same).map(first).collect()
}

/// Pairs of places along open rims that are near each other.
fn pairs(points: &[Point3<f64>], triangles: &[[u32; 3]], extent: f64) -> Vec<[u32; 2]> {
    let rim = rim(points.len(), triangles);
    let place = |corner: u32| (points[corner as usize] - points[0]) / extent;
    let places: Vec<[f64; 3]> = rim.iter().map(|&corner| place(corner).into()).collect();
    let tree = ImmutableKdTree::<f64, 3>::new_from_slice(&places);
    let Some(tree) = tree.ok().filter(|_| !places.is_empty()) else {
        return Vec::new();
    };
    let mut reach = vec![FARTHEST; points.len()];
    for ends in sides(triangles) {
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
    near.filter(|(apart, [one, other])| {
        one != other
            && [one, other]
                .iter()
                .all(|&&end| *apart <= reach[end as usize])
    })
    .map(|(_, ends)| ends)
    .collect()
}

/// The sides of the triangles, from corner to corner, without those that have no length.
fn sides(triangles: &[[u32; 3]]) -> impl Iterator<Item = [u32; 2]> {
    let sides = triangles.iter().flat_map(edges);
    sides.filter(|[from, to]| from != to)
}

/// The places along open rims, in order.
fn rim(points: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let corners = triangles.as_flattened();
    let open = open_sides(points, triangles).into_iter();
    let ends = open.flat_map(|side| [corners[side], corners[after(side)]]);
    let mut rim: Vec<u32> = ends.collect();
    rim.sort_unstable();
    rim.dedup();
    rim
}

#[cfg(test)]
mod tests {
    use super::super::weld::first_at_same_place;
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

    fn closed(scan: &mut Scan) {
        let same = first_at_same_place(&scan.points);
        close_gaps(scan, &same, 1.0);
    }

    fn ball() -> Mesh {
        Mesh::radial(8, |_| 0.5)
    }

    #[test]
    fn corners_within_reach_are_merged_and_reported() {
        for step in [1e-7, 1e-6, 5e-6] {
            let mut scan = loose(&ball(), step);
            let corners = scan.points.len();
            closed(&mut scan);
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
        closed(&mut scan);
        closed(&mut reversed);
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
        closed(&mut scan);
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
        closed(&mut merged);
        assert_eq!(merged, scan);
        // Without that face they are one.
        merged.triangles.remove(0);
        closed(&mut merged);
        assert_eq!(merged.points.len(), scan.points.len() - 3);
    }

    /// Two halves of a ball, each with a rim of its own, of which one has every corner twice, as texture has it.
    #[test]
    fn patches_that_are_apart_by_rounding_are_joined() {
        let ball = ball();
        let is_upper = |corners: &&[u32; 3]| {
            let heights = corners.map(|corner| ball.vertices[corner as usize].z);
            heights.iter().sum::<f64>() > 0.0
        };
        let (upper, lower): (Vec<_>, Vec<_>) = ball.triangles.iter().partition(is_upper);
        let mut scan = Scan::of_mesh(ball.clone());
        let count = scan.points.len() as u32;
        let rounded = |p: &Point3<f64>| p.map(|x| f64::from((x + 0.3) as f32) - 0.3);
        scan.points.extend(ball.vertices.iter().map(rounded));
        scan.points.extend_from_within(count as usize..);
        scan.triangles = upper;
        let others = (0_u32..).zip(lower);
        scan.triangles
            .extend(others.map(|(at, face)| face.map(|corner| corner + count * (1 + at % 2))));
        crate::scan::inspect::inspect(&mut scan);
        let topology = scan.topology().unwrap();
        assert!(topology.closed && topology.bodies == 1, "{topology:?}");
        assert!(scan.warnings()[0].starts_with("Merged "));
    }
}
