//! Vertices that subdivision put on edges. They lie on the flat faces of a coarser mesh, and tell nothing of the grain:
//! fitted like others they make faces of it. Of cement particles whose meshes of 2562 vertices were so subdivided the area was 2 %
//! too small, 20 to 40 standard errors; where a half or a third of the faces were, .6 to 1.2 %, 4 to 16.

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
    let looked_at = among(mesh, |at| at.is_multiple_of(step), is_folded);
    if are_few(looked_at.len(), all.div_ceil(step)) {
        return Vec::new();
    }
    let on_edges = among(mesh, |_| true, is_folded);
    if are_few(on_edges.len(), all) {
        return Vec::new();
    }
    let made = with_those_within(mesh, on_edges);
    match all - made.len() < FEWEST_CORNERS {
        true => Vec::new(),
        false => made,
    }
}

/// Beside those on edges the vertices that hang together with them over flat faces: a second cut of a part puts them within a coarse face.
fn with_those_within(mesh: &Mesh, on_edges: Vec<usize>) -> Vec<usize> {
    let mut is_flat = vec![false; mesh.vertices.len()];
    for at in among(mesh, |_| true, is_in_plane) {
        is_flat[at] = true;
    }
    let mut beside: Vec<Vec<u32>> = vec![Vec::new(); mesh.vertices.len()];
    for [one, other] in mesh.triangles.iter().flat_map(edges) {
        if is_flat[other as usize] {
            beside[one as usize].push(other);
        }
    }
    let mut made = on_edges;
    let mut at = 0;
    while at < made.len() {
        for &other in &beside[made[at]] {
            if std::mem::take(&mut is_flat[other as usize]) {
                made.push(other as usize);
            }
        }
        at += 1;
    }
    made.sort_unstable();
    made
}

/// Whether a vertex lies in one plane with all its neighbours.
fn is_in_plane(own: Vector3<f64>, others: &[Vector3<f64>]) -> bool {
    let towards: Vec<Vector3<f64>> = others
        .iter()
        .filter_map(|other| (other - own).try_normalize(0.0))
        .collect();
    let Some((first, rest)) = towards.split_first() else {
        return false;
    };
    let across = rest.iter().map(|other| first.cross(other));
    let normal = across.max_by(|one, other| one.norm_squared().total_cmp(&other.norm_squared()));
    let normal = normal.and_then(|normal| normal.try_normalize(ROUNDING));
    normal.is_some_and(|normal| towards.iter().all(|one| normal.dot(one).abs() < ROUNDING))
}

/// Whether a vertex lies between two of its neighbours, and the others to either side of that line in one plane each, which are folded.
fn is_folded(own: Vector3<f64>, others: &[Vector3<f64>]) -> bool {
    let towards: Vec<Vector3<f64>> = others
        .iter()
        .filter_map(|other| (other - own).try_normalize(0.0))
        .collect();
    let mut pairs = (0..towards.len()).flat_map(|i| (i + 1..towards.len()).map(move |j| [i, j]));
    let Some([i, j]) = pairs.find(|&[i, j]| (towards[i] + towards[j]).norm() < ROUNDING) else {
        return false;
    };
    let line = towards[i];
    let rest = (0..towards.len()).filter(|k| ![i, j].contains(k));
    let across: Option<Vec<Vector3<f64>>> = rest
        .map(|k| (towards[k] - line * line.dot(&towards[k])).try_normalize(ROUNDING))
        .collect();
    let Some(across) = across else {
        return false;
    };
    let Some(one) = across.first() else {
        return false;
    };
    let are_alike = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < ROUNDING;
    let mut beyond = across.iter().filter(|side| !are_alike(one, side));
    let Some(other) = beyond.next() else {
        return false;
    };
    beyond.all(|side| are_alike(other, side)) && FOLDED.contains(&(one + other).norm())
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
    among(mesh, is_looked_at, |own, others| {
        others.iter().enumerate().any(|(i, one)| {
            let one = one - own;
            let mut rest = others[i + 1..].iter().map(|other| other - own);
            rest.any(|other| (one + other).norm() < ROUNDING * (one - other).norm())
        })
    })
}

/// Those of some vertices that are so beside their neighbours.
fn among(
    mesh: &Mesh,
    is_looked_at: impl Fn(usize) -> bool,
    is_so: impl Fn(Vector3<f64>, &[Vector3<f64>]) -> bool,
) -> Vec<usize> {
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
    let found = few.filter(|(own, others)| is_so(place(*own as u32), others));
    found.map(|(own, _)| own).collect()
}

#[cfg(test)]
mod tests {
    use super::super::surface::scanned_surface;
    use super::*;
    use crate::fit::warning::FitWarning;
    use crate::mesh::{is_above, refined};
    use crate::scan::Scan;

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

    #[test]
    fn a_vertex_is_within_a_face_where_all_its_neighbours_are() {
        let around = |off: f64| {
            let towards = [[1.0, 0.0, 0.0], [0.1, 2.0, 0.0], [-3.0, -1.0, off]];
            towards.map(|towards| Vector3::new(3.0, -2.0, 5.0) + Vector3::from(towards))
        };
        let own = Vector3::new(3.0, -2.0, 5.0);
        assert!(is_in_plane(own, &around(0.0)) && !is_in_plane(own, &around(0.01)));
        assert!(!is_in_plane(own, &[own + Vector3::x()]));
    }

    #[test]
    fn a_vertex_is_on_an_edge_where_both_sides_are_plane_and_not_one() {
        let is_on_edge = |fold: f64, off: f64| {
            let (sin, cos) = fold.sin_cos();
            let around = [
                Vector3::x(),
                -2.0 * Vector3::x(),
                Vector3::new(0.3, 1.0, 0.0),
                Vector3::new(-0.5, 0.7, off),
                Vector3::new(0.2, -cos, sin),
                Vector3::new(-0.4, -2.0 * cos, 2.0 * sin),
            ];
            let own = Vector3::new(3.0, -2.0, 5.0);
            is_folded(own, &around.map(|other| own + other))
        };
        assert!(is_on_edge(0.01, 0.0) && is_on_edge(0.4, 0.0));
        assert!(!is_on_edge(0.0, 0.0) && !is_on_edge(1.0, 0.0));
        assert!(!is_on_edge(0.1, 0.01));
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
