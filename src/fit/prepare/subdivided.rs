//! Vertices that subdivision put on edges. They lie on the flat faces of a coarser mesh, and tell nothing of the grain:
//! fitted like others they make faces of it. Of cement particles whose meshes of 2562 vertices were so subdivided the area was 2 %
//! too small, 20 to 40 standard errors; where a half or a third of the faces were, .6 to 1.2 %, 4 to 16.

use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, edges};
use nalgebra::Vector3;
use std::ops::RangeInclusive;

/// Vertices that are looked at first.
const LOOKED_AT: usize = 200;

/// The same where a part of the faces may be subdivided.
const LOOKED_AT_FOR_SOME: usize = 2000;

/// Share of them that must lie in the middle between neighbours: subdivided once, three of four do.
const MANY: f64 = 0.6;

/// So much of the distance between two neighbours a vertex in their middle may be off it, for rounding.
const ROUNDING: f64 = 1e-4;

/// Of a mesh with fewer corners these do not tell what body it is.
const FEWEST_CORNERS: usize = 500;

/// Vertices on edges, as a share of all, from which on they were put there: of scans next to none are.
const IN_PART: f64 = 0.01;

/// Neighbours of a vertex on an edge, at most.
const MOST_NEIGHBOURS: usize = 64;

/// The least angle, and the largest, between the coarse faces beside an edge on which vertices were put: the sides of a box are flat, and
/// its edges sharp.
const FOLDED: RangeInclusive<f64> = 1e-3..=0.5;

/// Sine of the angle from which on two edges of a coarse face run different ways: rulings of a cone differ by less than they are folded.
const ANOTHER_WAY: f64 = 0.5;

/// The vertices that subdivision made, ascending: of all faces, as often as may be, or of a part of them.
pub(super) fn made_by_subdivision(mesh: &Mesh) -> Vec<usize> {
    let of_all = made_of_all(mesh);
    match of_all.is_empty() {
        true => made_of_some(mesh),
        false => of_all,
    }
}

/// Those on the edges between two coarse faces, and within these; none where the former are few.
fn made_of_some(mesh: &Mesh) -> Vec<usize> {
    let all = mesh.vertices.len();
    let step = all.div_ceil(LOOKED_AT_FOR_SOME);
    let are_few = |found: usize, of: usize| (found as f64) < IN_PART * of as f64;
    let looked_at = among(mesh, |at| at.is_multiple_of(step), fold);
    if are_few(looked_at.len(), all.div_ceil(step)) {
        return Vec::new();
    }
    let folds = among(mesh, |_| true, fold);
    let round_faces = round_faces(mesh, &folds);
    if are_few(round_faces.len(), all) {
        return Vec::new();
    }
    let on_edges = folds.into_iter().map(|(at, _)| at);
    let in_planes = among(mesh, |_| true, in_plane).into_iter();
    let others = on_edges.chain(in_planes.map(|(at, ())| at));
    let made = with_those_beside(mesh, &round_faces, others);
    match all - made.len() < FEWEST_CORNERS {
        true => Vec::new(),
        false => made,
    }
}

/// Those on edges that lie beside one on another edge of the same coarse face, which runs another way. Rulings of a cone or cylinder are
/// folds too, and run beside each other.
fn round_faces(mesh: &Mesh, folds: &[(usize, Vector3<f64>)]) -> Vec<usize> {
    let mut lines = vec![None; mesh.vertices.len()];
    for &(at, line) in folds {
        lines[at] = Some(line);
    }
    let mut found = Vec::new();
    for ends in mesh.triangles.iter().flat_map(edges) {
        if let [Some(one), Some(other)] = ends.map(|end| lines[end as usize])
            && one.cross(&other).norm() > ANOTHER_WAY
        {
            found.extend(ends.map(|end| end as usize));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Some vertices with those of others that hang together with them, ascending: a second cut of a part puts some within a coarse face.
fn with_those_beside(
    mesh: &Mesh,
    some: &[usize],
    others: impl Iterator<Item = usize>,
) -> Vec<usize> {
    let all = mesh.vertices.len();
    let mut may_hang = vec![false; all];
    for at in some.iter().copied().chain(others) {
        may_hang[at] = true;
    }
    let mut sets = DisjointSets::new(all);
    for [one, other] in mesh.triangles.iter().flat_map(edges) {
        if may_hang[one as usize] && may_hang[other as usize] {
            sets.join(one, other);
        }
    }
    let mut hangs = vec![false; all];
    for &at in some {
        hangs[sets.of(at as u32) as usize] = true;
    }
    (0..all)
        .filter(|&at| hangs[sets.of(at as u32) as usize])
        .collect()
}

/// Whether a vertex lies in one plane with all its neighbours.
fn in_plane(own: Vector3<f64>, others: &[Vector3<f64>]) -> Option<()> {
    let towards = directions(own, others);
    let (first, rest) = towards.split_first()?;
    let across = rest.iter().map(|other| first.cross(other));
    let normal = across.max_by(|one, other| one.norm_squared().total_cmp(&other.norm_squared()))?;
    let normal = normal.try_normalize(ROUNDING)?;
    let is_in_plane = |one: &Vector3<f64>| normal.dot(one).abs() < ROUNDING;
    towards.iter().all(is_in_plane).then_some(())
}

/// The way of the line along which a vertex lies between two of its neighbours, where the others lie to either side of it in one plane
/// each, which are folded.
fn fold(own: Vector3<f64>, others: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let towards = directions(own, others);
    let mut pairs = (0..towards.len()).flat_map(|i| (i + 1..towards.len()).map(move |j| [i, j]));
    let [i, j] = pairs.find(|&[i, j]| (towards[i] + towards[j]).norm() < ROUNDING)?;
    let line = towards[i];
    let rest = (0..towards.len()).filter(|k| ![i, j].contains(k));
    let across = rest
        .map(|k| (towards[k] - line * line.dot(&towards[k])).try_normalize(ROUNDING))
        .collect::<Option<Vec<Vector3<f64>>>>()?;
    let one = across.first()?;
    let are_alike = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < ROUNDING;
    let mut beyond = across.iter().filter(|side| !are_alike(one, side));
    let other = beyond.next()?;
    let is_folded =
        beyond.all(|side| are_alike(other, side)) && FOLDED.contains(&(one + other).norm());
    is_folded.then_some(line)
}

/// The directions of others from a vertex.
fn directions(own: Vector3<f64>, others: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let towards = others.iter().map(|other| other - own);
    towards
        .filter_map(|towards| towards.try_normalize(0.0))
        .collect()
}

/// The vertices that subdivision of all faces made; none where the numbers of vertices are not those of a mesh of which all faces were
/// cut in four, as often as may be.
fn made_of_all(mesh: &Mesh) -> Vec<usize> {
    let (all, faces) = (mesh.vertices.len(), mesh.triangles.len());
    if !faces.is_multiple_of(4) {
        return Vec::new();
    }
    let step = all.div_ceil(LOOKED_AT);
    let looked_at = all.div_ceil(step);
    let found = in_middles(mesh, |at| at.is_multiple_of(step));
    if (found.len() as f64) < MANY * looked_at as f64 {
        return Vec::new();
    }
    let made = in_middles(mesh, |_| true);
    let corners = all - made.len();
    // Euler's number is the same of both meshes, and each cut makes four faces of one.
    let cuts = (1..).map(|cuts| 4_usize.pow(cuts));
    let mut coarse = cuts.take_while(|parts| faces.is_multiple_of(*parts));
    let is_of = |parts: usize| all + faces / parts / 2 == corners + faces / 2;
    match corners >= FEWEST_CORNERS && coarse.any(is_of) {
        true => made,
        false => Vec::new(),
    }
}

/// Those of some vertices that lie in the middle between two of their neighbours.
fn in_middles(mesh: &Mesh, is_looked_at: impl Fn(usize) -> bool) -> Vec<usize> {
    let found = among(mesh, is_looked_at, in_middle).into_iter();
    found.map(|(at, ())| at).collect()
}

/// Whether a vertex lies in the middle between two of its neighbours.
fn in_middle(own: Vector3<f64>, others: &[Vector3<f64>]) -> Option<()> {
    let mut ones = others.iter().enumerate();
    let is_in_middle = ones.any(|(i, one)| {
        let one = one - own;
        let mut rest = others[i + 1..].iter().map(|other| other - own);
        rest.any(|other| (one + other).norm() < ROUNDING * (one - other).norm())
    });
    is_in_middle.then_some(())
}

/// What some vertices are beside their neighbours, by their numbers, of those that are it.
fn among<T>(
    mesh: &Mesh,
    is_looked_at: impl Fn(usize) -> bool,
    what: impl Fn(Vector3<f64>, &[Vector3<f64>]) -> Option<T>,
) -> Vec<(usize, T)> {
    let place = |at: u32| mesh.vertices[at as usize].coords;
    let mut neighbours: Vec<Vec<Vector3<f64>>> = vec![Vec::new(); mesh.vertices.len()];
    for &[a, b, c] in &mesh.triangles {
        for [own, next] in [[a, b], [b, c], [c, a]] {
            if is_looked_at(own as usize) {
                neighbours[own as usize].push(place(next));
            }
        }
    }
    let all = neighbours.iter().enumerate();
    let few = all.filter(|(_, others)| others.len() <= MOST_NEIGHBOURS);
    few.filter_map(|(own, others)| Some((own, what(place(own as u32), others)?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::surface::scanned_surface;
    use super::*;
    use crate::fit::warning::FitWarning;
    use crate::mesh::{is_above, refined};
    use crate::scan::Scan;
    use nalgebra::Point3;
    use std::f64::consts::TAU;

    /// Each face cut in four.
    fn cut(mesh: &Mesh) -> Mesh {
        refined(mesh, |_| true, |middle| middle)
    }

    #[test]
    fn what_is_cut_in_four_keeps_its_corners() {
        let egg =
            |resolution: usize| Mesh::radial(resolution, |n| 1.0 + 0.2 * n.x + 0.1 * n.y * n.z);
        let coarse = egg(10);
        let corners = coarse.vertices.len();
        let mut mesh = coarse;
        for _ in 0..3 {
            assert_eq!(
                made_by_subdivision(&mesh).len(),
                mesh.vertices.len() - corners
            );
            assert_eq!(
                made_by_subdivision(&mesh)
                    .first()
                    .copied()
                    .unwrap_or(corners),
                corners
            );
            mesh = cut(&mesh);
        }
        assert!(made_by_subdivision(&egg(40)).is_empty());
    }

    #[test]
    fn few_corners_and_the_flat_sides_of_a_box_keep_all() {
        let cube = |resolution: usize| Mesh::radial(resolution, |n| 1.0 / n.amax());
        assert!(made_by_subdivision(&cut(&cut(&cube(2)))).is_empty());
        assert!(made_by_subdivision(&cube(16)).is_empty());
    }

    /// Those above some height are cut in four, and the faces beside them in two.
    fn cut_in_part(mesh: &Mesh, height: f64) -> Mesh {
        let fine = refined(mesh, is_above(height), |middle| middle);
        let mut scan = Scan::from_mesh(fine).unwrap();
        Mesh {
            vertices: std::mem::take(&mut scan.points),
            triangles: std::mem::take(&mut scan.triangles),
        }
    }

    #[test]
    fn what_is_cut_in_part_keeps_its_corners() {
        let coarse = Mesh::radial(16, |n| 1.0 + 0.2 * n.x + 0.1 * n.y * n.z);
        let corners = coarse.vertices.len();
        for height in [0.0, 0.6] {
            let mesh = cut_in_part(&coarse, height);
            let made = made_by_subdivision(&mesh);
            assert!(made[0] >= corners, "{height}");
            // Some faces beside each other lie in one plane.
            assert!(made.len() as f64 > 0.95 * (mesh.vertices.len() - corners) as f64);
        }
        // Those of a box lie on its sides and edges.
        let cube = Mesh::radial(24, |n| 1.0 / n.amax());
        assert!(made_by_subdivision(&cut_in_part(&cube, 0.0)).is_empty());
    }

    /// A second cut puts some within coarse faces.
    #[test]
    fn what_is_cut_twice_in_part_keeps_its_corners() {
        let coarse = Mesh::radial(16, |n| 1.0 + 0.2 * n.x + 0.1 * n.y * n.z);
        let corners = coarse.vertices.len();
        let mesh = cut_in_part(&cut_in_part(&coarse, 0.0), 0.2);
        let made = made_by_subdivision(&mesh);
        assert!(made[0] >= corners);
        assert!(made.len() as f64 > 0.97 * (mesh.vertices.len() - corners) as f64);
    }

    /// Their rulings are straight, and the faces between two of them in one plane.
    #[test]
    fn the_rulings_of_a_cone_and_of_a_cylinder_keep_all() {
        let around = 300_u32;
        let rows = 12_u32;
        for widths in [[0.05, 1.0], [1.0, 1.0]] {
            let vertex = |row: u32, at: u32| {
                let (share, turn) = (
                    f64::from(row) / f64::from(rows),
                    TAU * f64::from(at) / f64::from(around),
                );
                let width = widths[0] + share * (widths[1] - widths[0]);
                Point3::new(width * turn.cos(), width * turn.sin(), 3.0 * share)
            };
            let places = (0..=rows).flat_map(|row| (0..around).map(move |at| (row, at)));
            let mut vertices: Vec<_> = places.map(|(row, at)| vertex(row, at)).collect();
            let ends = vertices.len() as u32;
            vertices.extend([Point3::origin(), Point3::new(0.0, 0.0, 3.0)]);
            let corner = |row: u32, at: u32| row * around + at % around;
            let quads = (0..rows).flat_map(|row| (0..around).map(move |at| (row, at)));
            let sides = quads.flat_map(|(row, at)| {
                let [a, b] = [corner(row, at), corner(row, at + 1)];
                let [c, d] = [corner(row + 1, at), corner(row + 1, at + 1)];
                [[a, b, d], [a, d, c]]
            });
            let lids = (0..around).flat_map(|at| {
                let low = [ends, corner(0, at + 1), corner(0, at)];
                [low, [ends + 1, corner(rows, at), corner(rows, at + 1)]]
            });
            let mesh = Mesh {
                triangles: sides.chain(lids).collect(),
                vertices,
            };
            assert_eq!(mesh.check_closed(), Ok(()));
            assert!(made_of_some(&mesh).is_empty(), "{widths:?}");
        }
    }

    #[test]
    fn a_vertex_is_within_a_face_where_all_its_neighbours_are() {
        let around = |off: f64| {
            let towards = [[1.0, 0.0, 0.0], [0.1, 2.0, 0.0], [-3.0, -1.0, off]];
            towards.map(|towards| Vector3::new(3.0, -2.0, 5.0) + Vector3::from(towards))
        };
        let own = Vector3::new(3.0, -2.0, 5.0);
        assert!(in_plane(own, &around(0.0)).is_some() && in_plane(own, &around(0.01)).is_none());
        assert!(in_plane(own, &[own + Vector3::x()]).is_none());
    }

    #[test]
    fn a_vertex_is_on_an_edge_where_both_sides_are_plane_and_not_one() {
        let is_on_edge = |angle: f64, off: [f64; 2]| {
            let (sin, cos) = angle.sin_cos();
            let around = [
                Vector3::x(),
                -2.0 * Vector3::x(),
                Vector3::new(0.3, 1.0, 0.0),
                Vector3::new(-0.5, 0.7, off[0]),
                Vector3::new(0.2, -cos, sin),
                Vector3::new(-0.4, -2.0 * cos, 2.0 * sin + off[1]),
            ];
            let own = Vector3::new(3.0, -2.0, 5.0);
            fold(own, &around.map(|other| own + other)).is_some()
        };
        assert!(is_on_edge(0.01, [0.0; 2]) && is_on_edge(0.4, [0.0; 2]));
        assert!(!is_on_edge(0.0, [0.0; 2]) && !is_on_edge(1.0, [0.0; 2]));
        assert!(!is_on_edge(0.1, [0.01, 0.0]) && !is_on_edge(0.1, [0.0, 0.01]));
    }

    #[test]
    fn what_was_made_is_left_out_beside_a_hole_too() {
        let coarse = Mesh::radial(16, |n| 1.0 + 0.2 * n.x + 0.1 * n.y * n.z);
        let mut mesh = cut_in_part(&coarse, 0.0);
        mesh.triangles.drain(..2);
        let scan = Scan::from_mesh(mesh).unwrap();
        let surface = scanned_surface(&scan).unwrap();
        let corners = coarse.vertices.len();
        assert!((corners..corners + corners / 30).contains(&surface.points.len()));
        let told = |warning: &FitWarning| matches!(warning, FitWarning::Subdivided { .. });
        assert!(surface.warnings.iter().any(told));
    }
}
