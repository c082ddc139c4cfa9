//! The largest ball inside a closed surface.

use super::Ball;
use super::clearance::{self, Obstacles};
use crate::Mesh;
use nalgebra::{Point3, Vector3};
use thiserror::Error;

/// Why no ball was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum InscribedBallError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    MissingVertex {
        /// Position of the triangle in the mesh.
        triangle: usize,
    },
    /// There are no triangles, or a coordinate is not finite.
    #[error("there is no surface, or a coordinate is not finite")]
    NoSurface,
}

/// A ball inside the closed surface of which no small shift makes room for a larger one: found from
/// `start`, which must be inside (the centroid, say; this is not checked).
///
/// The radius is the distance from the centre to the nearest triangle, in its interior, on an edge or at
/// a corner. The distance r_i(c) to one triangle is convex in c, so its linearisation at the present
/// centre is never too large, and neither is the distance to its plane: the shift s that makes the least
/// of r_i + g_i . s largest, a linear programme in four unknowns, never makes the ball smaller. Of the
/// thousands of triangles only those nearby can bind, and of these a few dozen do.
///
/// Of a convex body the ball is the largest there is (its centre is the Chebyshev centre of the
/// facets). Of others it is a local maximum, or, in the middle of a neck between two equal lobes, a
/// saddle. Error of the radius: 1e-9 of itself for polyhedra of large facets, 1e-6 on fine meshes of
/// smooth bodies.
///
/// # Errors
///
/// See [`InscribedBallError`].
pub fn inscribed_ball(mesh: &Mesh, start: &Point3<f64>) -> Result<Ball, InscribedBallError> {
    let vertex = |index: u32| mesh.vertices.get(index as usize);
    let is_broken = |corners: &[u32; 3]| corners.iter().any(|&corner| vertex(corner).is_none());
    if let Some(triangle) = mesh.triangles.iter().position(is_broken) {
        return Err(InscribedBallError::MissingVertex { triangle });
    }
    clearance::largest(mesh, start).ok_or(InscribedBallError::NoSurface)
}

/// Every triangle must name vertices that exist.
impl Obstacles for Mesh {
    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn nearest(&self, index: usize, place: &Vector3<f64>) -> Vector3<f64> {
        nearest(&corners(self, index), place)
    }

    fn normal(&self, index: usize) -> Vector3<f64> {
        let [a, b, c] = corners(self, index);
        (b - a).cross(&(c - a))
    }
}

fn corners(mesh: &Mesh, triangle: usize) -> [Vector3<f64>; 3] {
    mesh.triangles[triangle].map(|corner| mesh.vertices[corner as usize].coords)
}

/// The point of a triangle nearest to p (Ericson 2005, section 5.1.5).
fn nearest([a, b, c]: &[Vector3<f64>; 3], p: &Vector3<f64>) -> Vector3<f64> {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    // In the interior: along the normal, which loses fewer digits than the barycentric weights.
    let normal = ab.cross(&ac);
    p - normal * (normal.dot(&ap) / normal.norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{convex_hull, mesh_properties};
    use crate::shapes::{Body, Sampling};
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    #[test]
    fn a_cube_holds_the_ball_of_half_its_edge_from_any_start() {
        let cube = Mesh::radial(4, |n| 1.0 / n.amax());
        for start in [[0.0; 3], [0.9, 0.9, 0.9], [0.5, -0.7, 0.1]] {
            let ball = inscribed_ball(&cube, &Point3::from(start)).unwrap();
            assert_relative_eq!(ball.radius, 1.0, max_relative = 1e-9);
            assert_relative_eq!(ball.centre, Point3::origin(), epsilon = 1e-8);
        }
    }

    #[test]
    fn a_tetrahedron_holds_the_ball_of_three_volumes_by_its_area() {
        let corners =
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]].map(Point3::from);
        let hull = convex_hull(&corners).unwrap();
        let solid = mesh_properties(&hull).unwrap();
        let ball = inscribed_ball(&hull, &solid.centroid).unwrap();
        assert_relative_eq!(
            ball.radius,
            3.0 * solid.volume / solid.area,
            max_relative = 1e-9
        );
    }

    #[test]
    fn an_ellipsoid_holds_the_ball_of_its_least_semi_axis() {
        let body = Body::Ellipsoid
            .with_axes(Vector3::new(3.0, 2.0, 1.0))
            .unwrap();
        let mesh = Mesh::radial(32, |n| body.radius(n));
        for start in [[0.0; 3], [1.5, 0.5, 0.2], [-2.0, 0.3, -0.3]] {
            let ball = inscribed_ball(&mesh, &Point3::from(start)).unwrap();
            // Facets lie inside by up to (edge)²/8 times the curvature.
            assert_relative_eq!(ball.radius, 1.0, epsilon = 2e-3);
        }
    }

    #[test]
    fn a_dent_pushes_the_ball_aside() {
        let dent = |n: &Vector3<f64>| 1.0 - 0.6 * (8.0 * (n.z - 1.0)).exp();
        let dented = Mesh::radial(24, dent);
        let ball = inscribed_ball(&dented, &Point3::origin()).unwrap();
        // On the axis a ball touches the bottom (0, 0, -1) and the dent's edge or bottom (0, 0, 0.4).
        assert!(ball.radius > 0.69 && ball.centre.z < -0.2, "{ball:?}");
        let nearest = |p: &Point3<f64>| {
            let corners = dented
                .triangles
                .iter()
                .map(|t| t.map(|i| dented.vertices[i as usize].coords));
            corners
                .map(|t| (nearest(&t, &p.coords) - p.coords).norm())
                .fold(f64::MAX, f64::min)
        };
        assert_relative_eq!(nearest(&ball.centre), ball.radius, max_relative = 1e-12);
        for n in Sampling::Fibonacci.directions(100, 0).unwrap() {
            for step in [1e-3, 1e-2, 0.1] {
                assert!(nearest(&(ball.centre + n * step)) <= ball.radius * (1.0 + 1e-7));
            }
        }
    }

    #[test]
    fn the_point_nearest_is_that_of_a_dense_sample() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0]].map(Vector3::from);
        let [a, b, c] = corners;
        for n in Sampling::Fibonacci.directions(200, 0).unwrap() {
            let p = Vector3::new(0.8, 0.3, 0.0) + n * 1.5;
            let found = (nearest(&corners, &p) - p).norm();
            let weights = (0..=60).flat_map(|i| (0..=60 - i).map(move |j| (i, j)));
            let sampled = weights
                .map(|(i, j)| a + (b - a) * (f64::from(i) / 60.0) + (c - a) * (f64::from(j) / 60.0))
                .map(|q| (q - p).norm())
                .fold(f64::MAX, f64::min);
            assert!(found <= sampled + 1e-12 && found > sampled - 0.01);
        }
    }

    #[test]
    fn broken_meshes_are_refused() {
        let mut mesh = Mesh::radial(2, |_| 1.0);
        let start = Point3::origin();
        assert_eq!(
            inscribed_ball(&Mesh::default(), &start),
            Err(InscribedBallError::NoSurface)
        );
        assert_eq!(
            inscribed_ball(&mesh, &Point3::new(f64::NAN, 0.0, 0.0)),
            Err(InscribedBallError::NoSurface)
        );
        mesh.triangles[5][2] = 99;
        assert_eq!(
            inscribed_ball(&mesh, &start),
            Err(InscribedBallError::MissingVertex { triangle: 5 })
        );
        mesh.triangles[5][2] = 0;
        mesh.vertices[3].x = f64::NAN;
        assert_eq!(
            inscribed_ball(&mesh, &start),
            Err(InscribedBallError::NoSurface)
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]
        #[test]
        fn balls_move_with_the_body(
            angles in prop::array::uniform3(-3.0..3.0_f64), size in -9..9_i32,
        ) {
            let maize = Body::Maize.surface();
            let mesh = Mesh::radial(10, |n| maize.radius(n));
            let found = inscribed_ball(&mesh, &Point3::new(0.3, 0.2, 0.1)).unwrap();
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let scale = 10.0_f64.powi(size);
            let place = |p: &Point3<f64>| (turn * p + Vector3::new(1.0, 2.0, 3.0)) * scale;
            let moved = Mesh { vertices: mesh.vertices.iter().map(place).collect(), ..mesh };
            let other = inscribed_ball(&moved, &place(&Point3::new(0.3, 0.2, 0.1))).unwrap();
            assert_relative_eq!(other.radius, found.radius * scale, max_relative = 1e-6);
        }
    }
}
