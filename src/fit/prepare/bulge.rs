//! What a smooth surface through the corners of a mesh holds beyond its faces.

use crate::mesh::Mesh;
use crate::scan::each_edge;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_4;

/// Bend at an edge, in radians, from which on the body has an edge there.
const SHARPEST: f64 = FRAC_PI_4;

/// Volume between the faces and a smooth surface through their corners: the root of the squares of what is beyond the faces,
/// and of what is within where they bend inwards, for the walls of a cup are not made up for by its inside. Where faces of
/// heights h and k bend by an angle a along an edge of length e it is a e (h² + k²) / 24: so much lies beyond the faces of a
/// cylinder, and beyond even triangles of a ball, to first order in a. Sharp bends are edges of the body.
pub(super) fn bulge(mesh: &Mesh) -> f64 {
    let corner = |at: u32| mesh.vertices[at as usize].coords;
    // Its length is twice the area.
    let normal = |triangle: usize| -> Vector3<f64> {
        let [a, b, c] = mesh.triangles[triangle].map(corner);
        (b - a).cross(&(c - a))
    };
    let middle = |triangle: usize| {
        mesh.triangles[triangle]
            .map(corner)
            .iter()
            .sum::<Vector3<f64>>()
            / 3.0
    };
    let [mut beyond, mut within] = [0.0; 2];
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        let Some([one, other]) = edge.pair() else {
            return;
        };
        let [from, to] = edge.ends.map(corner);
        let length = (to - from).norm();
        let (n, m) = (normal(one), normal(other));
        let bend = n.angle(&m);
        // Triangles that close a gap may have edges without length.
        if bend < SHARPEST && length > 0.0 {
            let is_inwards = n.dot(&(middle(other) - middle(one))) > 0.0;
            let heights = (n.norm_squared() + m.norm_squared()) / length;
            let sum = if is_inwards { &mut within } else { &mut beyond };
            *sum += bend * heights / 24.0;
        }
    });
    beyond.hypot(within)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use approx::assert_relative_eq;
    use nalgebra::Point3;
    use std::f64::consts::PI;

    #[test]
    fn a_ball_bulges_beyond_its_faces() {
        for resolution in [6, 12] {
            let ball = Mesh::radial(resolution, |_| 2.0);
            let exact = 4.0 / 3.0 * PI * 8.0 - mesh_properties(&ball).unwrap().volume;
            assert_relative_eq!(bulge(&ball), exact, max_relative = 0.03);
            let mut hollow = ball.clone();
            for corners in &mut hollow.triangles {
                corners.reverse();
            }
            assert_relative_eq!(bulge(&hollow), exact, max_relative = 0.03);
            // The wall of a bowl, seen from a wall away: both bulge, and do not make up for each other.
            let offset = ball.vertices.len() as u32;
            let inner = hollow
                .triangles
                .iter()
                .map(|corners| corners.map(|at| at + offset));
            let both = Mesh {
                triangles: ball.triangles.iter().copied().chain(inner).collect(),
                vertices: [&ball.vertices[..], &hollow.vertices].concat(),
            };
            assert_relative_eq!(bulge(&both), 2.0_f64.sqrt() * exact, max_relative = 0.06);
        }
    }

    /// A corner put in twice, with a triangle without area between.
    #[test]
    fn an_edge_without_length_bulges_nowhere() {
        let mut ball = Mesh::radial(8, |_| 1.0);
        let smooth = bulge(&ball);
        let twin = ball.vertices.len() as u32;
        let [a, b, c] = ball.triangles[0];
        ball.vertices.push(ball.vertices[a as usize]);
        ball.triangles[0] = [twin, b, c];
        ball.triangles.extend([[a, b, twin], [a, twin, c]]);
        assert_relative_eq!(bulge(&ball), smooth, max_relative = 0.01);
    }

    #[test]
    fn a_tube_bulges_and_a_box_does_not() {
        let ring =
            |sides: u32| (0..sides).map(move |at| 2.0 * PI * f64::from(at) / f64::from(sides));
        let tube = |sides: u32| Mesh {
            vertices: ring(sides)
                .flat_map(|a| [0.0, 5.0].map(|z| Point3::new(a.cos(), a.sin(), z)))
                .collect(),
            triangles: (0..sides)
                .flat_map(|at| {
                    let (a, b) = (2 * at, 2 * ((at + 1) % sides));
                    [[a, b, a + 1], [b, b + 1, a + 1]]
                })
                .collect(),
        };
        let sides = 16.0;
        let polygon = 0.5 * sides * (2.0 * PI / sides).sin();
        assert_relative_eq!(bulge(&tube(16)), 5.0 * (PI - polygon), max_relative = 0.02);
        assert!(bulge(&tube(4)).abs() < 1e-6);
    }
}
