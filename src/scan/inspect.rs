//! Looks over the triangles of a scan: drops degenerate and repeated ones, mends what a few wrong ones break, turns the mesh right
//! side out, and warns of what a closed surface of one body would not have.

use super::Scan;
use super::close_gaps::close_gaps;
use super::junctions::{junctions, parted};
use super::mend::{flaps, repeats, wound_against};
use super::slits::slits;
use super::topology::{Topology, joined};
use super::weld::first_at_same_place;
use crate::digits::{plural, significant};
use crate::mesh::Bounds;
use nalgebra::Point3;

/// Fills in `topology` and the warnings. All indices must be in range.
pub(super) fn inspect(scan: &mut Scan) {
    drop_degenerate(scan);
    if scan.triangles.is_empty() {
        return;
    }
    let mut topology = Topology::of_own(&scan.points, &scan.triangles);
    if !topology.closed || topology.bodies > 1 {
        let extent = extent(&scan.points);
        let mut same = first_at_same_place(&scan.points);
        if !topology.closed && close_gaps(scan, &same, extent) {
            same = first_at_same_place(&scan.points);
            topology = Topology::of_own(&scan.points, &scan.triangles);
        }
        if drop_repeated(scan, &same) {
            topology = Topology::of_own(&scan.points, &scan.triangles);
        }
        if !topology.closed {
            topology = Topology::new(&scan.points, &scan.triangles, &same);
        }
        if topology.boundary_edges > 0 {
            topology = part_at_junctions(scan, &same, extent, topology);
            topology = fill_slits(scan, &same, topology);
        }
        if topology.branching_edges > 0 {
            topology = without_flaps(scan, &same, topology);
        }
        if topology.twisted_edges > 0 && turn(scan, &same) {
            topology = Topology::new(&scan.points, &scan.triangles, &same);
        }
    }
    if topology.volume < 0.0 && topology.twisted_edges == 0 {
        for [_, b, c] in &mut scan.triangles {
            std::mem::swap(b, c);
        }
        topology.volume = -topology.volume;
        let warning = "The triangles were wound inwards and have been turned outwards.";
        scan.warnings.push(warning.into());
    }
    scan.warnings.extend(warnings(&topology));
    scan.topology = Some(topology);
}

/// The longest side of the box round points.
fn extent(points: &[Point3<f64>]) -> f64 {
    let corners = Bounds::new(points.iter().copied(), 0.0).corners();
    (corners[1] - corners[0]).max()
}

fn drop_degenerate(scan: &mut Scan) {
    let before = scan.triangles.len();
    let points = &scan.points;
    scan.triangles.retain(|corners| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        a != b && b != c && c != a
    });
    if let dropped @ 1.. = before - scan.triangles.len() {
        let triangles = plural(dropped, "triangle");
        scan.warnings
            .push(format!("Dropped {triangles} with coinciding corners."));
    }
}

/// Drops triangles that [repeat](repeats) others.
fn drop_repeated(scan: &mut Scan, same: &[u32]) -> bool {
    let before = scan.triangles.len();
    let found = repeats(&joined(&scan.triangles, same));
    let mut is_kept = found.is_kept.into_iter();
    scan.triangles.retain(|_| is_kept.next().unwrap_or(true));
    let dropped = before - scan.triangles.len();
    if dropped > 0 {
        let triangles = plural(dropped, "triangle");
        scan.warnings.push(match found.are_both_ways {
            true => {
                "Each triangle was there in both senses: those that came first are kept.".into()
            }
            false => format!("Dropped {triangles} that repeat others."),
        });
    }
    dropped > 0
}

/// Parts triangles on whose sides others have [corners](junctions) if that leaves fewer edges open.
fn part_at_junctions(scan: &mut Scan, same: &[u32], extent: f64, before: Topology) -> Topology {
    let points = &scan.points;
    let found = junctions(points, &joined(&scan.triangles, same), extent);
    if found.is_empty() {
        return before;
    }
    let on_side = |side: usize| found.get(&side).map_or(&[][..], Vec::as_slice);
    let triangles = scan.triangles.iter().enumerate();
    let parts = triangles.flat_map(|(at, &corners)| {
        parted(
            points,
            corners,
            [0, 1, 2].map(|side| on_side(3 * at + side)),
        )
    });
    let parts: Vec<[u32; 3]> = parts.collect();
    let after = Topology::new(points, &parts, same);
    if after.boundary_edges >= before.boundary_edges {
        return before;
    }
    scan.triangles = parts;
    let sides = plural(found.len(), "side");
    scan.warnings.push(format!(
        "Parted {sides} of triangles at corners of others that lie on them (T-junctions)."
    ));
    after
}

/// Fills [slits] between coarse faces and finer ones.
fn fill_slits(scan: &mut Scan, same: &[u32], before: Topology) -> Topology {
    let found = slits(&scan.points, &joined(&scan.triangles, same));
    if found.is_empty() {
        return before;
    }
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| scan.points[corner as usize]);
        (b - a).cross(&(c - a)).norm() / 2.0
    };
    let filled: f64 = found.iter().map(area).sum();
    let share = filled / scan.triangles.iter().map(area).sum::<f64>();
    let slits = plural(found.len(), "slit");
    scan.warnings.push(format!(
        "Filled {slits} between coarse faces and finer ones: {} % of the area.",
        significant(100.0 * share, 2)
    ));
    scan.triangles.extend(found);
    Topology::new(&scan.points, &scan.triangles, same)
}

/// Drops flaps if that closes the surface.
fn without_flaps(scan: &mut Scan, same: &[u32], before: Topology) -> Topology {
    let flaps = flaps(scan.points.len(), &joined(&scan.triangles, same));
    let triangles = scan.triangles.iter().enumerate();
    let kept = triangles.filter(|(at, _)| flaps.binary_search(at).is_err());
    let kept: Vec<_> = kept.map(|(_, corners)| *corners).collect();
    let after = Topology::new(&scan.points, &kept, same);
    if flaps.is_empty() || after.boundary_edges + after.branching_edges > 0 {
        return before;
    }
    scan.triangles = kept;
    let triangles = plural(flaps.len(), "triangle");
    scan.warnings.push(format!(
        "Dropped {triangles} that hung on a closed surface by an edge."
    ));
    after
}

/// Turns triangles that are wound against their neighbours.
fn turn(scan: &mut Scan, same: &[u32]) -> bool {
    let found = wound_against(scan.points.len(), &joined(&scan.triangles, same));
    let Some(turned) = found else {
        return false;
    };
    for &at in &turned {
        let [_, b, c] = &mut scan.triangles[at];
        std::mem::swap(b, c);
    }
    scan.warnings.push(match turned.len() {
        1 => "Turned 1 triangle that was wound against its neighbours.".into(),
        count => format!("Turned {count} triangles that were wound against their neighbours."),
    });
    true
}

fn warnings(topology: &Topology) -> impl Iterator<Item = String> {
    let count = |number: usize, start: &str, noun: &str| {
        (number > 0).then(|| format!("{start} {}.", plural(number, noun)))
    };
    [
        count(
            topology.boundary_edges,
            "The surface is open: its holes have",
            "edge",
        ),
        count(
            topology.branching_edges,
            "More than two triangles meet at",
            "edge",
        ),
        count(
            topology.twisted_edges,
            "Triangles wound in opposite senses meet at",
            "edge",
        ),
        count(topology.unreferenced.len(), "No triangle uses", "point"),
        (topology.bodies > 1).then(|| {
            format!(
                "The scan holds {} separate surfaces: bodies, or hollows in them.",
                topology.bodies
            )
        }),
    ]
    .into_iter()
    .flatten()
}

#[cfg(test)]
mod tests {
    use nalgebra::point;

    use super::*;

    fn tetrahedron() -> Scan {
        Scan {
            points: vec![
                point![0.0, 0.0, 0.0],
                point![1.0, 0.0, 0.0],
                point![0.0, 1.0, 0.0],
                point![0.0, 0.0, 1.0],
            ],
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
            ..Scan::default()
        }
    }

    #[test]
    fn a_sound_mesh_has_no_warnings() {
        let mut scan = tetrahedron();
        inspect(&mut scan);
        assert_eq!(scan.warnings, [""; 0]);
        assert_eq!(scan.triangles, tetrahedron().triangles);
    }

    #[test]
    fn an_inside_out_mesh_is_turned() {
        let mut scan = tetrahedron();
        scan.triangles
            .iter_mut()
            .for_each(|corners| corners.reverse());
        inspect(&mut scan);
        assert!(scan.topology.unwrap().volume > 0.0);
        assert!(scan.warnings[0].contains("inwards"));
    }

    #[test]
    fn a_triangle_wound_against_its_neighbours_is_turned() {
        for turned in 0..4 {
            let mut scan = tetrahedron();
            scan.triangles[turned].swap(0, 1);
            inspect(&mut scan);
            assert!(scan.topology.as_ref().unwrap().closed);
            assert!((scan.topology.unwrap().volume - 1.0 / 6.0).abs() < 1e-15);
            let expected = "Turned 1 triangle that was wound against its neighbours.";
            assert_eq!(scan.warnings, [expected]);
        }
    }

    #[test]
    fn a_flap_is_dropped_unless_the_surface_is_open_all_the_same() {
        let with_flap = || {
            let mut scan = tetrahedron();
            scan.points.push(point![2.0, 2.0, 2.0]);
            scan.triangles.push([1, 2, 4]);
            scan
        };
        let mut scan = with_flap();
        inspect(&mut scan);
        assert_eq!(scan.triangles, tetrahedron().triangles);
        assert!(scan.topology.unwrap().closed);
        assert!(scan.warnings[0].starts_with("Dropped 1 triangle that hung"));
        let mut scan = with_flap();
        scan.triangles.remove(0);
        inspect(&mut scan);
        assert_eq!(scan.triangles.len(), 4);
    }

    /// As where vertices were merged: a flap without volume, of which one side was there already, and a mesh with a back side.
    #[test]
    fn triangles_that_undo_each_other_are_dropped_so_that_the_surface_stays_closed() {
        for [a, b, c] in tetrahedron().triangles {
            let mut scan = tetrahedron();
            scan.triangles.extend([[b, c, a], [b, a, c]]);
            inspect(&mut scan);
            assert_eq!(scan.triangles, tetrahedron().triangles);
            assert_eq!(scan.warnings, ["Dropped 2 triangles that repeat others."]);
        }

        let mut scan = tetrahedron();
        let back = scan
            .triangles
            .clone()
            .into_iter()
            .map(|[a, b, c]| [b, a, c]);
        scan.triangles.extend(back.collect::<Vec<_>>());
        inspect(&mut scan);
        assert_eq!(scan.triangles, tetrahedron().triangles);
        assert!(scan.topology.unwrap().closed);
        assert!(
            scan.warnings[0].contains("both senses"),
            "{:?}",
            scan.warnings
        );
    }

    #[test]
    fn repeated_points_do_not_open_a_mesh() {
        let mut scan = tetrahedron();
        scan.points.push(scan.points[0]);
        scan.triangles[3][0] = 4;
        inspect(&mut scan);
        assert!(scan.topology.unwrap().closed);
        assert_eq!(scan.warnings, [""; 0]);
    }

    #[test]
    fn triangles_that_repeat_others_are_dropped_with_points_of_their_own_or_not() {
        let mut scan = tetrahedron();
        scan.triangles.extend([[2, 1, 0], [1, 2, 3]]);
        inspect(&mut scan);
        assert_eq!(scan.triangles, tetrahedron().triangles);
        assert_eq!(scan.warnings, ["Dropped 2 triangles that repeat others."]);

        let mut scan = tetrahedron();
        scan.points.extend(tetrahedron().points);
        let again = tetrahedron().triangles.into_iter();
        scan.triangles
            .extend(again.map(|corners| corners.map(|corner| corner + 4)));
        inspect(&mut scan);
        let topology = scan.topology.unwrap();
        assert!(topology.closed && topology.bodies == 1);
        assert!((topology.volume - 1.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn degenerate_triangles_are_dropped() {
        let mut scan = tetrahedron();
        scan.triangles.push([1, 1, 2]);
        inspect(&mut scan);
        assert_eq!(scan.triangles.len(), 4);
        assert!(scan.warnings[0].starts_with("Dropped 1 triangle "));
    }
}
