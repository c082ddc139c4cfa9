//! The largest ball inside a closed surface.

use super::clearance::largest_from;
use super::largest_ball::Obstacles;
use super::medial::{deepest, feet};
use crate::measure::Ball;
use crate::measure::even_places::even_places;
use crate::measure::triangle_tree::TriangleTree;
use crate::mesh::{Mesh, winding_number};
use nalgebra::Vector3;
use thiserror::Error;

/// Places of the surface from which balls of the medial axis are found, to begin with.
const FEET: usize = 1000;

/// Share of its radius by which a larger ball may be inside than the one that is told.
const TOLERANCE: f64 = 1e-3;

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
    /// No point is inside: the surface encloses nothing, or is wound inwards.
    #[error("no sphere was found inside the surface")]
    NoInside,
}

/// The largest ball inside a closed surface, wound counter-clockwise from outside.
///
/// From feet all over the surface, equal areas apart, balls of the medial axis are found along the inward
/// normals. The deepest of them that are inside by their winding number are moved until no small shift
/// makes room for a larger one; the largest of these, or a larger one that branch and bound finds between them, is
/// the answer. So the centre is inside, and the ball touches the surface and does not cross it.
///
/// The radius is the distance from the centre to the nearest triangle, in its interior, on an edge or at
/// a corner. The distance |c - p| to a point of the surface is convex in c, so its linearisation at the present
/// centre is never too large: the shift that makes the least of those of a few points largest, a linear programme in
/// four unknowns, never makes the ball smaller but for points not yet known, which are looked up where it leads. Some
/// 20 to 40 such steps do.
///
/// Of a convex body the ball is the largest there is (its centre is the Chebyshev centre of the
/// facets). Of others it is a local maximum than which none is larger by more than 1e-3; between flat walls n times as
/// wide as they are apart, about n² thousandths. Error of that maximum: 1e-9 of itself for polyhedra of large facets, 1e-7
/// on fine meshes of smooth bodies; of walls of even thickness, where many balls are nearly as large, 1e-4.
///
/// # Errors
///
/// See [`InscribedBallError`].
pub fn inscribed_ball(mesh: &Mesh) -> Result<Ball, InscribedBallError> {
    let vertex = |index: u32| mesh.vertices.get(index as usize);
    let is_broken = |corners: &[u32; 3]| corners.iter().any(|&corner| vertex(corner).is_none());
    if let Some(triangle) = mesh.triangles.iter().position(is_broken) {
        return Err(InscribedBallError::MissingVertex { triangle });
    }
    let is_finite = |corner: &u32| vertex(*corner).is_some_and(|v| v.iter().all(|x| x.is_finite()));
    if mesh.triangles.is_empty() || !mesh.triangles.iter().flatten().all(is_finite) {
        return Err(InscribedBallError::NoSurface);
    }
    let tree = TriangleTree::new(mesh);
    let nearest = |place: &Vector3<f64>, limit| tree.nearest(place, limit);
    let obstacles = Obstacles {
        nearest,
        is_outside: |place: &Vector3<f64>| tree.is_outside(place),
        is_inside: |ball: &Ball| winding_number(mesh, &ball.centre) > 0.5,
        is_flat: false,
        bounds: tree.corners(),
    };
    let feet = feet(&even_places(mesh, FEET), tree.size());
    let starts = deepest(feet, nearest, obstacles.is_inside);
    let found = largest_from(nearest, &starts).ok_or(InscribedBallError::NoInside)?;
    Ok(obstacles.largest(found, TOLERANCE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::triangle_tree::nearest_in_triangle;
    use crate::measure::{convex_hull, mesh_properties};
    use crate::shapes::{Body, Sampling};
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3};
    use proptest::prelude::*;

    #[test]
    fn a_cube_holds_the_ball_of_half_its_edge() {
        let cube = Mesh::radial(4, |n| 1.0 / n.amax());
        let ball = inscribed_ball(&cube).unwrap();
        assert_relative_eq!(ball.radius, 1.0, max_relative = 1e-9);
        assert_relative_eq!(ball.centre, Point3::origin(), epsilon = 1e-8);
    }

    #[test]
    fn a_tetrahedron_holds_the_ball_of_three_volumes_by_its_area() {
        let corners =
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]].map(Point3::from);
        let hull = convex_hull(&corners).unwrap();
        let solid = mesh_properties(&hull).unwrap();
        let ball = inscribed_ball(&hull).unwrap();
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
        let ball = inscribed_ball(&mesh).unwrap();
        // Facets lie inside by up to (edge)²/8 times the curvature.
        assert_relative_eq!(ball.radius, 1.0, epsilon = 2e-3);
    }

    #[test]
    fn a_dent_pushes_the_ball_aside() {
        let dent = |n: &Vector3<f64>| 1.0 - 0.6 * (8.0 * (n.z - 1.0)).exp();
        let dented = Mesh::radial(24, dent);
        let ball = inscribed_ball(&dented).unwrap();
        // On the axis a ball touches the bottom (0, 0, -1) and the dent's edge or bottom (0, 0, 0.4).
        assert!(ball.radius > 0.69 && ball.centre.z < -0.2, "{ball:?}");
        let nearest = |p: &Point3<f64>| {
            let corners = dented
                .triangles
                .iter()
                .map(|t| t.map(|i| dented.vertices[i as usize].coords));
            corners
                .map(|t| (nearest_in_triangle(&t, &p.coords) - p.coords).norm())
                .fold(f64::MAX, f64::min)
        };
        assert_relative_eq!(nearest(&ball.centre), ball.radius, max_relative = 1e-12);
        for n in Sampling::Fibonacci.directions(100, 0).unwrap() {
            for step in [1e-3, 1e-2, 0.1] {
                assert!(nearest(&(ball.centre + n * step)) <= ball.radius * (1.0 + 1e-7));
            }
        }
    }

    /// A body whose radius is that of the cross of three bars, 1 wide and of half the length `arm`.
    fn cross(arm: f64, resolution: usize) -> Mesh {
        let bar = |n: &Vector3<f64>, along: usize| {
            let sides = (0..3).map(|axis| if axis == along { arm } else { 0.5 } / n[axis].abs());
            sides.fold(f64::INFINITY, f64::min)
        };
        Mesh::radial(resolution, |n| {
            (0..3).map(|along| bar(n, along)).fold(0.0, f64::max)
        })
    }

    #[test]
    fn the_largest_ball_of_a_cross_is_in_its_middle() {
        // Inner edges are the nearest: at (0.5, 0.5, 0) from the middle. Steep walls cut them back by the mesh's width.
        let ball = inscribed_ball(&cross(6.0, 40)).unwrap();
        assert_relative_eq!(ball.radius, 0.5_f64.sqrt(), max_relative = 0.02);
    }

    #[test]
    fn broken_meshes_are_refused() {
        let mut mesh = Mesh::radial(2, |_| 1.0);
        assert_eq!(
            inscribed_ball(&Mesh::default()),
            Err(InscribedBallError::NoSurface)
        );
        mesh.triangles[5][2] = 99;
        assert_eq!(
            inscribed_ball(&mesh),
            Err(InscribedBallError::MissingVertex { triangle: 5 })
        );
        mesh.triangles[5][2] = 0;
        mesh.vertices[3].x = f64::NAN;
        assert_eq!(inscribed_ball(&mesh), Err(InscribedBallError::NoSurface));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]
        #[test]
        fn balls_move_with_the_body(
            angles in prop::array::uniform3(-3.0..3.0_f64), size in -9..9_i32,
        ) {
            let maize = Body::Maize.surface();
            let mesh = Mesh::radial(10, |n| maize.radius(n));
            let found = inscribed_ball(&mesh).unwrap();
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let scale = 10.0_f64.powi(size);
            let place = |p: &Point3<f64>| (turn * p + Vector3::new(1.0, 2.0, 3.0)) * scale;
            let moved = Mesh { vertices: mesh.vertices.iter().map(place).collect(), ..mesh };
            let other = inscribed_ball(&moved).unwrap();
            assert_relative_eq!(other.radius, found.radius * scale, max_relative = 1e-6);
        }
    }
}
