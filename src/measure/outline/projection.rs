//! The outline of a closed mesh projected along an axis.

use super::silhouette::Silhouette;
use crate::Mesh;
use crate::measure::Outline;
use nalgebra::{Point3, Vector3};
use thiserror::Error;

/// Share of an outline's area that holes may have, as rounding leaves them.
const LARGEST_HOLE: f64 = 1e-6;

/// Why a mesh has no outline.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    MissingVertex {
        /// Position of the triangle in the mesh.
        triangle: usize,
    },
    /// The axis has no direction, or a coordinate is not finite, or the outline has no area.
    #[error("the projection has no area, or a coordinate is not finite")]
    NoArea,
    /// Seen along the axis, the body has a hole.
    #[error("{:.2} % of its outline would be hollow: it has a hole, seen from there", 100.0 * share)]
    Hole {
        /// Share of the area that the outline would have and the body does not cover.
        share: f64,
    },
}

/// The outline of a closed mesh projected along `axis`, seen from its tip, about `centre`: the border of
/// what all its triangles cover together, to rounding.
///
/// # Errors
///
/// See [`ProjectionError`].
pub fn project(
    mesh: &Mesh,
    axis: &Vector3<f64>,
    centre: &Point3<f64>,
) -> Result<Outline, ProjectionError> {
    let is_missing = |corner: &u32| *corner as usize >= mesh.vertices.len();
    let is_broken = |corners: &[u32; 3]| corners.iter().any(is_missing);
    if let Some(triangle) = mesh.triangles.iter().position(is_broken) {
        return Err(ProjectionError::MissingVertex { triangle });
    }
    let axis = axis.try_normalize(0.0).ok_or(ProjectionError::NoArea)?;
    let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0));
    let u = across.try_normalize(0.0).ok_or(ProjectionError::NoArea)?;
    let v = axis.cross(&u);
    let seen = mesh.vertices.iter().map(|vertex| vertex - centre);
    let seen: Vec<Vector3<f64>> = seen
        .map(|ray| Vector3::new(u.dot(&ray), v.dot(&ray), axis.dot(&ray)))
        .collect();
    // In units of the farthest, which neither overflow nor vanish.
    let size = seen.iter().map(|place| place.amax()).fold(0.0, f64::max);
    let places: Vec<Vector3<f64>> = seen.iter().map(|place| place / size).collect();
    if !places
        .iter()
        .all(|place| place.iter().all(|x| x.is_finite()))
    {
        return Err(ProjectionError::NoArea);
    }
    let found = Silhouette::new(&places, &mesh.triangles).ok_or(ProjectionError::NoArea)?;
    let border = found.border.iter().map(|corner| corner * size).collect();
    let outline = Outline::of(border).ok_or(ProjectionError::NoArea)?;
    let share = found.holes / (outline.area / size / size);
    match share > LARGEST_HOLE {
        true => Err(ProjectionError::Hole { share }),
        false => Ok(outline),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::trial::cubes;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Rotation3};
    use proptest::prelude::*;
    use std::f64::consts::{PI, TAU};

    /// Square columns of these heights in a row.
    fn columns(heights: &[i32]) -> Mesh {
        let height = |x: i32| usize::try_from(x).ok().and_then(|x| heights.get(x));
        cubes(5, |[x, y, z]| {
            y == 0 && z >= 0 && height(x).is_some_and(|top| z < *top)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(36))]
        #[test]
        fn the_outline_of_an_ellipsoid_is_an_ellipse(direction in prop::array::uniform3(-1.0..1.0_f64)) {
            let semi_axes = Vector3::new(2.0, 1.5, 1.0);
            let axis = (Vector3::from(direction) + Vector3::z() * 1e-3).normalize();
            let body = Body::Ellipsoid.with_axes(semi_axes).unwrap();
            let found = project(&Mesh::radial(64, |n| body.radius(n)), &axis, &Point3::new(0.1, 0.2, -0.1)).unwrap();
            // The half width along a unit vector w is sqrt(w.S w), S = diag(a²); its largest and least
            // values across the axis are the semi-axes.
            let u = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
            let v = axis.cross(&u);
            let squares = Matrix3::from_diagonal(&semi_axes.component_mul(&semi_axes));
            let [uu, uv, vv] = [u.dot(&(squares * u)), u.dot(&(squares * v)), v.dot(&(squares * v))];
            let spread = ((uu - vv) / 2.0).hypot(uv);
            let [long, short] = [1.0, -1.0].map(|sign| ((uu + vv) / 2.0 + sign * spread).sqrt());
            // The mesh itself is inside by up to 4e-4.
            assert_relative_eq!(found.area, PI * long * short, max_relative = 1e-3);
            assert_relative_eq!(found.largest_feret, 2.0 * long, max_relative = 1e-3);
            assert_relative_eq!(found.smallest_feret, 2.0 * short, max_relative = 1e-3);
            assert_relative_eq!(found.inscribed_diameter, 2.0 * short, max_relative = 2e-3);
            assert_relative_eq!(found.enclosing_diameter, 2.0 * long, max_relative = 1e-3);
        }

        #[test]
        fn walls_seen_edge_on_leave_no_slits(
            angles in prop::array::uniform3(-3.0..3.0_f64), cells in 1..9_usize, shift in 0.0..50.0_f64,
        ) {
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let mut cube = Mesh::radial(cells, |n| 1.0 / n.amax());
            for vertex in &mut cube.vertices {
                // As a file of 32 bits has it.
                *vertex = (turn * *vertex + Vector3::repeat(shift)).map(|x| f64::from(x as f32));
            }
            for axis in [Vector3::z(), Vector3::new(1.0, 1.0, 0.0)] {
                let found = project(&cube, &(turn * axis), &Point3::origin()).unwrap();
                assert_relative_eq!(found.convexity(), 1.0, epsilon = 1e-4);
                assert_relative_eq!(found.area, 4.0 * axis.norm(), max_relative = 1e-4);
            }
        }

        #[test]
        fn teeth_seen_from_above_are_one_body(angles in prop::array::uniform3(-3.0..3.0_f64)) {
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let mut comb = columns(&[3, 1, 3, 1, 2]);
            for vertex in &mut comb.vertices {
                // As a file of 32 bits has it.
                *vertex = (turn * *vertex).map(|x| f64::from(x as f32));
            }
            let found = project(&comb, &(turn * Vector3::z()), &Point3::origin()).unwrap();
            assert_relative_eq!(found.area, 5.0, max_relative = 1e-5);
            assert_relative_eq!(found.perimeter, 12.0, max_relative = 1e-4);
        }

        #[test]
        fn the_outline_of_a_needle_reaches_its_tips(angles in prop::array::uniform3(-3.0..3.0_f64)) {
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            for semi_axes in [Vector3::new(1.0, 1.0, 100.0), Vector3::new(100.0, 100.0, 1.0)] {
                let mut mesh = Mesh::radial(64, |_| 1.0);
                for vertex in &mut mesh.vertices {
                    *vertex = turn * Point3::from(vertex.coords.component_mul(&semi_axes));
                }
                let found = project(&mesh, &(turn * Vector3::x()), &Point3::origin()).unwrap();
                let [short, long] = [semi_axes.y.min(semi_axes.z), semi_axes.y.max(semi_axes.z)];
                assert_relative_eq!(found.area, PI * long * short, max_relative = 1e-3);
                assert_relative_eq!(found.largest_feret, 2.0 * long, max_relative = 1e-9);
                assert_relative_eq!(found.smallest_feret, 2.0 * short, max_relative = 1e-6);
            }
        }

        #[test]
        fn outlines_move_with_the_body(
            angles in prop::array::uniform3(-3.0..3.0_f64), size in -9..9_i32,
        ) {
            let maize = Body::Maize.surface();
            let mesh = Mesh::radial(16, |n| maize.radius(n));
            let axis = Vector3::new(0.3, 0.2, 0.8);
            let found = project(&mesh, &axis, &Point3::origin()).unwrap();
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let scale = 10.0_f64.powi(size);
            let place = |p: &Point3<f64>| (turn * p + Vector3::new(1.0, 2.0, 3.0)) * scale;
            let moved = Mesh { vertices: mesh.vertices.iter().map(place).collect(), ..mesh };
            let other = project(&moved, &(turn * axis), &place(&Point3::origin())).unwrap();
            assert_relative_eq!(other.area, found.area * scale * scale, max_relative = 1e-5);
            assert_relative_eq!(other.perimeter, found.perimeter * scale, max_relative = 1e-5);
            assert_relative_eq!(other.largest_feret, found.largest_feret * scale, max_relative = 1e-5);
            assert_relative_eq!(other.roundness, found.roundness, max_relative = 1e-2);
        }
    }

    #[test]
    fn a_cube_projects_to_a_square_and_to_a_hexagon() {
        let cube = Mesh::radial(3, |n| 1.0 / n.amax());
        let square = project(&cube, &Vector3::z(), &Point3::new(0.3, 0.1, 0.0)).unwrap();
        assert_relative_eq!(square.area, 4.0, max_relative = 1e-9);
        assert_relative_eq!(square.perimeter, 8.0, max_relative = 1e-9);
        let hexagon = project(&cube, &Vector3::repeat(1.0), &Point3::origin()).unwrap();
        assert_relative_eq!(hexagon.area, 48.0_f64.sqrt(), max_relative = 1e-9);
        assert_relative_eq!(
            hexagon.largest_feret,
            2.0 * (8.0_f64 / 3.0).sqrt(),
            max_relative = 1e-9
        );
    }

    /// A plate with this outline, of height one, over a fan about its first corner where that sees all others.
    fn plate(corners: &[[f64; 2]], caps: &[[u32; 3]]) -> Mesh {
        let count = corners.len() as u32;
        let at = |z: f64| corners.iter().map(move |[x, y]| Point3::new(*x, *y, z));
        let below = caps.iter().map(|&[a, b, c]| [a, c, b]);
        let above = caps
            .iter()
            .map(|corners| corners.map(|corner| corner + count));
        let walls = (0..count).flat_map(|from| {
            let to = (from + 1) % count;
            [[from, to, to + count], [from, to + count, from + count]]
        });
        Mesh {
            vertices: at(0.0).chain(at(1.0)).collect(),
            triangles: below.chain(above).chain(walls).collect(),
        }
    }

    #[test]
    fn outlines_that_bend_back_are_those_of_the_body() {
        // A U whose arms are 1 wide, 4 long and 1 apart: its centroid lies beside it.
        let corners = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 4.0],
            [2.0, 4.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 4.0],
            [0.0, 4.0],
        ];
        let caps = [
            [0, 1, 4],
            [0, 4, 5],
            [1, 2, 3],
            [1, 3, 4],
            [0, 5, 7],
            [5, 6, 7],
        ];
        let mesh = plate(&corners, &caps);
        let centre = Point3::new(1.5, 1.7, 0.5);
        let above = project(&mesh, &Vector3::z(), &centre).unwrap();
        assert_relative_eq!(above.area, 9.0, max_relative = 1e-12);
        assert_relative_eq!(above.perimeter, 20.0, max_relative = 1e-12);
        assert_relative_eq!(above.hull_area, 12.0, max_relative = 1e-12);
        // In a corner of the bend, where it touches both outer sides and the inner corner.
        let radius = 2.0 - 2.0_f64.sqrt();
        assert_relative_eq!(above.inscribed_diameter, 2.0 * radius, max_relative = 1e-6);
        let beside = project(&mesh, &Vector3::x(), &centre).unwrap();
        assert_relative_eq!(beside.area, 4.0, max_relative = 1e-12);
        assert_relative_eq!(beside.perimeter, 10.0, max_relative = 1e-12);
    }

    #[test]
    fn holes_are_refused_where_they_are_seen() {
        let ring = |i: u32, j: u32| {
            let angle = |part: u32| TAU * f64::from(part % 24) / 24.0;
            let ((sin, cos), (up, out)) = (angle(i).sin_cos(), angle(j).sin_cos());
            Point3::new((3.0 + out) * cos, (3.0 + out) * sin, up)
        };
        let at = |i: u32, j: u32| (i % 24) * 24 + j % 24;
        let cell = |i: u32, j: u32| {
            [
                [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
            ]
        };
        let all = || (0..24).flat_map(|i| (0..24).map(move |j| (i, j)));
        let torus = Mesh {
            vertices: all().map(|(i, j)| ring(i, j)).collect(),
            triangles: all().flat_map(|(i, j)| cell(i, j)).collect(),
        };
        let Err(ProjectionError::Hole { share }) =
            project(&torus, &Vector3::z(), &Point3::origin())
        else {
            panic!("a hole");
        };
        assert_relative_eq!(share, 0.25, epsilon = 1e-9);
        // Of a stadium, by the polygon of 24 corners.
        let side = project(&torus, &Vector3::x(), &Point3::origin()).unwrap();
        let half = 12.0 * (TAU / 24.0).sin();
        assert_relative_eq!(side.area, 12.0 + half, max_relative = 1e-9);
    }

    #[test]
    fn broken_meshes_and_axes_are_refused() {
        let mut mesh = Mesh::radial(2, |_| 1.0);
        let centre = Point3::origin();
        for axis in [
            Vector3::zeros(),
            Vector3::repeat(f64::NAN),
            Vector3::repeat(f64::INFINITY),
        ] {
            assert_eq!(project(&mesh, &axis, &centre), Err(ProjectionError::NoArea));
        }
        assert_eq!(
            project(&Mesh::default(), &Vector3::z(), &centre),
            Err(ProjectionError::NoArea)
        );
        let flat = Mesh {
            vertices: vec![Point3::new(1.0, 2.0, 3.0); 26],
            ..mesh.clone()
        };
        assert_eq!(
            project(&flat, &Vector3::z(), &centre),
            Err(ProjectionError::NoArea)
        );
        mesh.triangles[5][2] = 99;
        let missing = ProjectionError::MissingVertex { triangle: 5 };
        assert_eq!(project(&mesh, &Vector3::z(), &centre), Err(missing));
        mesh.triangles[5][2] = 0;
        mesh.vertices[3].x = f64::NAN;
        assert_eq!(
            project(&mesh, &Vector3::z(), &centre),
            Err(ProjectionError::NoArea)
        );
    }
}
