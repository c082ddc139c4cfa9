//! Closing holes by triangles over their rims.

use crate::mesh::{LEAST_AREA_CORNERS, Mesh, edges, least_area, parts, undirected};
use nalgebra::{Point3, Vector3};
use std::collections::HashSet;

/// What closes the small holes of a scan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// Number of holes.
    pub holes: usize,
    /// Edges of their rims.
    pub edges: usize,
    /// Triangles that close them: the last of the mesh.
    pub triangles: usize,
    /// Area of the triangles that close them, in the unit squared. It is part of the area.
    pub area: f64,
}

/// The mesh with its holes closed, if that takes at most the `largest` share of the area of the part of the
/// mesh round each of them; else the mesh as it was, and the share.
pub(super) fn fill(
    mut mesh: Mesh,
    rims: &[Vec<u32>],
    largest: f64,
) -> Result<(Mesh, Fill), (Mesh, f64)> {
    let (vertices, triangles) = (mesh.vertices.len(), mesh.triangles.len());
    let mut known = edges_between(&mesh, rims);
    for rim in rims {
        close(&mut mesh, rim, &mut known);
    }
    let area = |triangle: usize| {
        let [a, b, c] = mesh.triangles[triangle].map(|corner| mesh.vertices[corner as usize]);
        (b - a).cross(&(c - a)).norm() / 2.0
    };
    let mut filled = 0.0;
    let mut most: f64 = 0.0;
    for part in parts(&mesh) {
        let (mut own, mut faces) = (0.0, 0.0);
        for triangle in part {
            match triangle < triangles {
                true => faces += area(triangle),
                false => own += area(triangle),
            }
        }
        filled += own;
        most = most.max(own / faces);
    }
    if most.is_nan() || most > largest {
        mesh.vertices.truncate(vertices);
        mesh.triangles.truncate(triangles);
        return Err((mesh, most));
    }
    let fill = Fill {
        holes: rims.len(),
        edges: rims.iter().map(Vec::len).sum(),
        triangles: mesh.triangles.len() - triangles,
        area: filled,
    };
    Ok((mesh, fill))
}

/// The edges of a mesh between vertices of some rims, whichever way.
fn edges_between(mesh: &Mesh, rims: &[Vec<u32>]) -> HashSet<[u32; 2]> {
    let mut is_on_rim = vec![false; mesh.vertices.len()];
    for vertex in rims.iter().flatten() {
        is_on_rim[*vertex as usize] = true;
    }
    let edges = mesh.triangles.iter().flat_map(edges);
    edges
        .filter(|ends| ends.iter().all(|end| is_on_rim[*end as usize]))
        .map(undirected)
        .collect()
}

/// Adds triangles over a rim, without edges across it that are `known`, for these have two triangles; nothing over a rim of two
/// corners, whose edges coincide.
fn close(mesh: &mut Mesh, rim: &[u32], known: &mut HashSet<[u32; 2]>) {
    let corners: Vec<Point3<f64>> = rim.iter().map(|&i| mesh.vertices[i as usize]).collect();
    let may_be = |i: usize, k: usize| !known.contains(&undirected([rim[i], rim[k]]));
    let is_small = corners.len() <= LEAST_AREA_CORNERS;
    if let Some(triangles) = is_small.then(|| least_area(&corners, may_be)).flatten() {
        let named = triangles
            .into_iter()
            .map(|triangle| triangle.map(|i| rim[i]));
        let named: Vec<[u32; 3]> = named.collect();
        known.extend(named.iter().flat_map(edges).map(undirected));
        mesh.triangles.extend(named);
        return;
    }
    let sum: Vector3<f64> = corners.iter().map(|corner| corner - corners[0]).sum();
    let middle = mesh.vertices.len() as u32;
    mesh.vertices.push(corners[0] + sum / corners.len() as f64);
    let edges = rim.iter().zip(rim.iter().cycle().skip(1));
    mesh.triangles
        .extend(edges.map(|(&from, &to)| [from, to, middle]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// The edges that a second triangle lacks, in its sense.
    fn open_edges(mesh: &Mesh) -> Vec<[u32; 2]> {
        let mut edges = Vec::new();
        crate::scan::each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
            match (edge.forward, edge.backward) {
                (1, 0) => edges.push([edge.ends[1], edge.ends[0]]),
                (0, 1) => edges.push(edge.ends),
                _ => {}
            }
        });
        edges
    }

    #[test]
    fn a_removed_patch_is_closed_by_a_fan_or_by_least_area() {
        for (parts, resolution) in [(2_u32, 12_u32), (40, 160)] {
            let full = Mesh::radial(resolution as usize, |n| 1.0 / n.amax());
            // A square patch in the middle of a face of the cube: flat, so the fill is what was there.
            let half = 1e-9 + (f64::from(parts) / f64::from(resolution) * PI / 4.0).tan();
            let is_kept = |corners: &[u32; 3]| {
                let outside = |i: &u32| {
                    let vertex = &full.vertices[*i as usize];
                    vertex.z < 0.999 || vertex.coords.xy().amax() > half
                };
                corners.iter().any(outside)
            };
            let mut open = full.clone();
            open.triangles.retain(is_kept);
            assert!(open.triangles.len() < full.triangles.len());
            let edges = open_edges(&open);
            let rims = super::super::rims::rims(&edges);
            assert_eq!(rims.len(), 1);
            assert_eq!(rims[0].len() > LEAST_AREA_CORNERS, parts > 2);
            let (closed, filled) = fill(open, &rims, 0.05).expect("a small hole");
            assert_eq!(filled.edges, edges.len());
            let found = mesh_properties(&closed).expect("a solid");
            assert_relative_eq!(found.area, 24.0, epsilon = 1e-9);
            assert_relative_eq!(found.volume, 8.0, epsilon = 1e-9);
        }
    }

    /// Of the triangles about a vertex that stands out one is left: the least area over the rest would be that triangle turned over,
    /// and the plane below.
    #[test]
    fn no_edge_is_made_that_the_mesh_has() {
        let mut mesh = Mesh::radial(6, |_| 1.0);
        let tip = mesh.triangles[40][0];
        mesh.vertices[tip as usize].coords *= 3.0;
        let of_tip: Vec<_> = mesh
            .triangles
            .iter()
            .filter(|t| t.contains(&tip))
            .copied()
            .collect();
        mesh.triangles.retain(|t| !of_tip[1..].contains(t));
        let edges = open_edges(&mesh);
        let rims = super::super::rims::rims(&edges);
        let (closed, filled) = fill(mesh, &rims, 0.5).expect("a small hole");
        assert_eq!(filled.triangles, edges.len() - 2);
        crate::scan::each_edge(closed.vertices.len(), &closed.triangles, |edge| {
            assert!(edge.pair().is_some(), "{:?}", edge.ends);
        });
    }
}
