//! The centre from which a closed mesh is star-shaped, and how far it is from being so.
//!
//! A point c sees the whole surface if and only if it lies on the inner side of every facet's plane:
//! n.(p - c) > 0. All such c form a convex set, the kernel, and the c that is deepest inside it
//! solves a linear programme in four unknowns: maximise t subject to n_i.(p_i - c) >= t.

use crate::mesh::Mesh;
use crate::planes::{Plane, deepest_below};
use nalgebra::Point3;

/// Share of the surface's area whose outer side faces `centre`.
pub(crate) fn facing_away_share(mesh: &Mesh, centre: &Point3<f64>) -> f64 {
    let (mut away, mut total) = (0.0, 0.0);
    for (plane, area) in facets(mesh, centre, 1.0) {
        total += area;
        if plane.height <= 0.0 {
            away += area;
        }
    }
    if total > 0.0 { away / total } else { 1.0 }
}

/// The centre deepest inside the kernel of the mesh, or the one that violates its facets least where
/// the kernel is empty.
pub(crate) fn deepest_centre(mesh: &Mesh, start: &Point3<f64>) -> Point3<f64> {
    let distances = mesh.vertices.iter().map(|p| (p - start).norm());
    let size = distances.fold(0.0, f64::max);
    let facets = facets(mesh, start, 1.0 / size);
    let planes: Vec<Plane> = facets.map(|(plane, _)| plane).collect();
    start + deepest_below(&planes, 1.0).0 * size
}

/// Planes of the facets of a mesh that is moved and scaled, and their areas.
fn facets(mesh: &Mesh, from: &Point3<f64>, scale: f64) -> impl Iterator<Item = (Plane, f64)> {
    mesh.triangles.iter().filter_map(move |corners| {
        let [a, b, c] = corners.map(|i| (mesh.vertices[i as usize] - from) * scale);
        let cross = (b - a).cross(&(c - a));
        let twice_area = cross.norm();
        let plane = || Plane {
            normal: cross / twice_area,
            height: cross.dot(&a) / twice_area,
        };
        (twice_area > 0.0).then(|| (plane(), 0.5 * twice_area))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use crate::sphere::triangulate_directions;

    /// A ball of unit radius whose triangulation is pushed out on one side, seen from far off centre.
    fn cup(dent: f64) -> Mesh {
        let directions = Sampling::Fibonacci
            .directions(400, 0)
            .expect("enough directions");
        Mesh {
            triangles: triangulate_directions(&directions).expect("400 directions"),
            vertices: directions
                .iter()
                .map(|d| Point3::from(d * (1.0 - dent * (8.0 * (d.z - 1.0)).exp())))
                .collect(),
        }
    }

    #[test]
    fn a_ball_is_seen_whole_from_inside_and_its_centre_is_deepest() {
        let ball = cup(0.0);
        assert_eq!(facing_away_share(&ball, &Point3::new(0.5, 0.0, 0.0)), 0.0);
        assert!(facing_away_share(&ball, &Point3::new(0.0, 1.5, 0.0)) > 0.1);
        let centre = deepest_centre(&ball, &Point3::new(0.6, 0.1, 0.0));
        assert!(centre.coords.norm() < 0.05, "{centre}");
    }

    #[test]
    fn a_dented_ball_is_star_shaped_from_below_the_dent_only() {
        let dented = cup(0.6);
        let above = Point3::new(0.0, 0.0, 0.5);
        assert!(facing_away_share(&dented, &above) > 0.0);
        let centre = deepest_centre(&dented, &above);
        assert_eq!(facing_away_share(&dented, &centre), 0.0);
    }
}
