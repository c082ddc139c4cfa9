//! Triangulation of directions on the sphere: the spherical Delaunay triangulation, which is the
//! convex hull of the unit vectors.
//!
//! One direction w serves as centre of a stereographic projection; circles map to circles, so the
//! planar Delaunay triangulation of the images (crate `spade`, exact predicates) is the spherical
//! one, and one fan of triangles round w closes it. Cost O(n log n): 3 ms for 6 000 directions.
//!
//! Assumes that every open hemisphere holds a direction: otherwise the surface is not closed round
//! the origin, and the fan bridges the gap.

use nalgebra::Vector3;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation, mitigate_underflow};

/// Why directions cannot be triangulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// Fewer than four distinct directions, or all on one circle.
    #[error("{distinct} distinct directions do not enclose a volume; at least 4 are needed")]
    TooFew {
        /// Number of distinct directions.
        distinct: usize,
    },
    /// A direction is not finite, or so near the projection centre that it cannot be told apart.
    #[error("a direction is not finite")]
    NotFinite,
}

struct Projected {
    position: Point2<f64>,
    index: u32,
}

impl HasPosition for Projected {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The closest angle between two directions that are told apart, in radians.
const RESOLUTION: f64 = 1e-7;

/// Triangles over `directions` (unit vectors), counter-clockwise when seen from outside. Directions
/// that coincide with an earlier one are left out.
///
/// # Errors
/// [`TriangulationError`] if fewer than four distinct directions are given.
pub fn triangulate_directions(
    directions: &[Vector3<f64>],
) -> Result<Vec<[u32; 3]>, TriangulationError> {
    let too_few = TriangulationError::TooFew {
        distinct: directions.len(),
    };
    let Some(w) = directions.first().copied() else {
        return Err(too_few);
    };
    let (u, v) = tangents(&w);
    let projected = directions
        .iter()
        .enumerate()
        .filter_map(|(index, q)| {
            let k = (w - q).norm_squared() / 2.0;
            (k > RESOLUTION * RESOLUTION).then(|| Projected {
                position: mitigate_underflow(Point2::new(u.dot(q) / k, v.dot(q) / k)),
                index: index as u32,
            })
        })
        .collect();
    let planar = DelaunayTriangulation::<Projected>::bulk_load(projected)
        .map_err(|_| TriangulationError::NotFinite)?;
    if planar.num_inner_faces() == 0 {
        return Err(too_few);
    }
    // The projection from w reverses the orientation as seen from outside: (u, v, w) is right
    // handed and the plane is seen from the side of w, through the sphere.
    let mut triangles: Vec<[u32; 3]> = planar
        .inner_faces()
        .map(|face| {
            let [a, b, c] = face.vertices().map(|vertex| vertex.data().index);
            [a, c, b]
        })
        .collect();
    triangles.extend(planar.convex_hull().map(|edge| {
        let (a, b) = (edge.from().data().index, edge.to().data().index);
        [0, b, a]
    }));
    Ok(triangles)
}

/// Two unit vectors that make a right-handed frame (u, v, w).
fn tangents(w: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let helper = if w.x.abs() < 0.6 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let u = helper.cross(w).normalize();
    (u, w.cross(&u))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use nalgebra::Point3;

    fn spiral(count: usize) -> Vec<Vector3<f64>> {
        (0..count)
            .map(|i| {
                let z = 1.0 - (2 * i + 1) as f64 / count as f64;
                let phi = 2.399_963_229_728_653 * i as f64;
                let s = (1.0 - z * z).sqrt();
                Vector3::new(s * phi.cos(), s * phi.sin(), z)
            })
            .collect()
    }

    #[test]
    fn the_triangulation_is_closed_and_faces_outwards() {
        let directions = spiral(500);
        let mesh = Mesh {
            triangles: triangulate_directions(&directions).expect("distinct directions"),
            vertices: directions.iter().map(|d| Point3::from(*d)).collect(),
        };
        mesh.check_closed().expect("closed");
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|i| directions[i as usize]);
            assert!((b - a).cross(&(c - a)).dot(&a) > 0.0);
        }
    }

    #[test]
    fn the_corners_of_an_octahedron_and_of_a_cube_are_triangulated() {
        let octahedron: Vec<_> = [Vector3::x(), Vector3::y(), Vector3::z()]
            .into_iter()
            .flat_map(|a| [a, -a])
            .collect();
        assert_eq!(triangulate_directions(&octahedron).map(|t| t.len()), Ok(8));
        let cube: Vec<_> = (0..8)
            .map(|i| Vector3::from_fn(|axis, _| if i >> axis & 1 == 0 { 1.0 } else { -1.0 }))
            .map(|v: Vector3<f64>| v.normalize())
            .collect();
        assert_eq!(triangulate_directions(&cube).map(|t| t.len()), Ok(12));
    }

    #[test]
    fn too_few_directions_are_refused() {
        assert!(triangulate_directions(&[]).is_err());
        assert!(triangulate_directions(&[Vector3::x(), Vector3::y(), Vector3::x()]).is_err());
    }
}
