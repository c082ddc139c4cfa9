//! How far a mesh is off the surface that its vertices are on, and how fine it has to be.
//!
//! Over an edge of length L along which the normal turns by an angle t the surface bulges by t L / 8. Ripples of a rough
//! grain are lost between vertices that do for a smooth one: outlines of a stone were .1 % too small, and its perimeters .3 %.

use crate::mesh::Mesh;
use std::f64::consts::PI;

/// Mean bulge over all edges, as a share of the radius, that is small enough: of a ball of the resolution of 64 it is
/// half of this.
const ENOUGH: f64 = 1.8e-4;

/// Resolutions are multiples of this, up to the last, which takes as many times the work of 64 as six meshes.
const STEP: usize = 16;
const FINEST: usize = 160;

/// The resolution at which a surface bulges little between vertices, if that is more than the one of this mesh.
pub(in crate::measure) fn finer_resolution(mesh: &Mesh, resolution: usize) -> Option<usize> {
    // The bulge goes with the square of the distance of vertices.
    let times = (sag(mesh) / ENOUGH).sqrt();
    let finer = (resolution as f64 * times / STEP as f64).ceil() * STEP as f64;
    (times > 1.0).then(|| (finer as usize).min(FINEST))
}

/// The mean bulge over the edges, as a share of the radius of the ball of equal area.
fn sag(mesh: &Mesh) -> f64 {
    let normals = mesh.normals();
    let (mut sum, mut area) = (0.0, 0.0);
    for corners in &mesh.triangles {
        let corners = corners.map(|corner| corner as usize);
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner]);
        area += 0.5 * (b - a).cross(&(c - a)).norm();
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [corners[from], corners[to]];
            let turn = normals[to] - normals[from];
            let along = mesh.vertices[to] - mesh.vertices[from];
            sum += turn.norm() * along.norm() / 8.0;
        }
    }
    let edges = 3 * mesh.triangles.len();
    sum / edges as f64 / (area / (4.0 * PI)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_ball_bulges_as_arcs_do_over_chords_and_less_between_more_vertices() {
        let ball = |resolution| Mesh::radial(resolution, |_| 2.0);
        // Edges and diagonals of cells with sides of pi/2 over 64.
        let side = PI / 2.0 / 64.0;
        let expected = side * side / 8.0 * (1.0 + 1.0 + 2.0) / 3.0;
        assert_relative_eq!(sag(&ball(64)), expected, max_relative = 0.2);
        assert_relative_eq!(sag(&ball(32)) / sag(&ball(64)), 4.0, max_relative = 0.05);
        assert_eq!(finer_resolution(&ball(64), 64), None);
    }

    #[test]
    fn ripples_need_more_vertices() {
        let rippled = |depth: f64| {
            let mesh = Mesh::radial(64, |n| 1.0 + depth * (40.0 * n.z).sin());
            finer_resolution(&mesh, 64)
        };
        assert_eq!(rippled(1e-4), None);
        let found = rippled(0.01).unwrap();
        assert!((96..160).contains(&found), "{found}");
        assert_eq!(rippled(0.1), Some(FINEST));
    }
}
