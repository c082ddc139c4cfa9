//! The outline of a closed mesh projected along an axis.

use super::Outline;
use super::coverage::covered_area;
use crate::Mesh;
use nalgebra::{Matrix2, Point3, Vector2, Vector3};
use std::f64::consts::TAU;
use thiserror::Error;

/// Azimuths at which an outline is found, in a plane in which it is about round. Of an ellipse the area is low by
/// (2 pi / n)²/6, or 3e-6; the corner farthest out between two azimuths is added.
pub const OUTLINE_AZIMUTHS: usize = 1440;

/// Share of an outline's area that the body may leave open. Covered areas are found to 0.3 %.
const LARGEST_OVERHANG: f64 = 0.01;

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
    /// Seen along the axis, the centre is beside the body: a bent body, or a ring.
    #[error("its centroid lies beside it, seen from there")]
    CentreOutside,
    /// A ray from the centre leaves the outline and enters it again: what is between is not the body's.
    #[error("{:.1} % of its outline would be hollow: it bends back, or has a hole", 100.0 * share)]
    Overhang {
        /// Share of the area that the outline would have and the body does not cover.
        share: f64,
    },
}

/// The outline of a closed mesh projected along `axis`, seen from its tip, about `centre`, which must be
/// inside the outline.
///
/// The projection of a body that is star-shaped about the centre is star-shaped about the projected
/// centre, so in each of [`OUTLINE_AZIMUTHS`] equally spaced azimuths the outline is the farthest
/// intersection with a projected edge. Of other bodies what is between two places where a ray leaves the
/// projection is filled, up to 1 % of the area; with more there is no outline.
///
/// # Errors
///
/// See [`ProjectionError`].
pub fn project(
    mesh: &Mesh,
    axis: &Vector3<f64>,
    centre: &Point3<f64>,
) -> Result<Outline, ProjectionError> {
    let axis = axis.try_normalize(0.0).ok_or(ProjectionError::NoArea)?;
    let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0));
    let u = across.try_normalize(0.0).ok_or(ProjectionError::NoArea)?;
    let v = axis.cross(&u);
    let seen = mesh.vertices.iter().map(|vertex| vertex - centre);
    let seen: Vec<Vector2<f64>> = seen
        .map(|ray| Vector2::new(u.dot(&ray), v.dot(&ray)))
        .collect();
    let rounding = Rounding::of(&seen).ok_or(ProjectionError::NoArea)?;
    let places: Vec<Place> = seen
        .iter()
        .map(|place| Place::of(rounding.round * place))
        .collect();
    let directions: Vec<Vector2<f64>> = (0..OUTLINE_AZIMUTHS)
        .map(|azimuth| (TAU * azimuth as f64 / OUTLINE_AZIMUTHS as f64).sin_cos())
        .map(|(sin, cos)| Vector2::new(cos, sin))
        .collect();
    let mut radii = vec![0.0_f64; OUTLINE_AZIMUTHS];
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        let [Some(a), Some(b), Some(c)] = corners.map(|i| places.get(i as usize)) else {
            return Err(ProjectionError::MissingVertex { triangle });
        };
        // The outline of a closed mesh is made of edges of triangles that are seen from in front.
        if (b.position - a.position).perp(&(c.position - a.position)) <= 0.0 {
            continue;
        }
        for (from, to) in [(a, b), (b, c), (c, a)] {
            // Each edge of a closed mesh is walked both ways: once counter-clockwise.
            if let Some(span) = from.span_to(to) {
                for azimuth in span {
                    let azimuth = azimuth % OUTLINE_AZIMUTHS;
                    let radius = &mut radii[azimuth];
                    if from.distance.max(to.distance) > *radius {
                        *radius = radius.max(from.crossing(to, &directions[azimuth]));
                    }
                }
            }
        }
    }
    let rays = directions.iter().zip(&radii);
    let samples: Vec<Vector2<f64>> = rays
        .map(|(direction, radius)| direction * *radius)
        .collect();
    if radii.iter().all(|radius| *radius == 0.0) {
        return Err(ProjectionError::NoArea);
    }
    if radii.contains(&0.0) {
        return Err(ProjectionError::CentreOutside);
    }
    let corners = with_corners(&samples, &places).into_iter();
    let corners = corners.map(|corner| rounding.back * corner).collect();
    let outline = Outline::of(corners).ok_or(ProjectionError::NoArea)?;
    if is_star_shaped(mesh, centre) {
        return Ok(outline);
    }
    let share = 1.0 - covered_area(&seen, &mesh.triangles) / outline.area;
    match share > LARGEST_OVERHANG {
        true => Err(ProjectionError::Overhang { share }),
        false => Ok(outline),
    }
}

/// A linear map of the plane after which places scatter alike in all directions: of a slender outline equal azimuths would
/// miss the tips. It keeps what is star-shaped so.
struct Rounding {
    round: Matrix2<f64>,
    back: Matrix2<f64>,
}

impl Rounding {
    /// `None` where the places are not finite, or lie on one line.
    fn of(places: &[Vector2<f64>]) -> Option<Self> {
        // In units of the farthest, whose squares neither overflow nor vanish.
        let size = places.iter().map(|place| place.amax()).fold(0.0, f64::max);
        let squares = places.iter().map(|place| place / size);
        let moments: Matrix2<f64> = squares.map(|place| place * place.transpose()).sum();
        if !moments.iter().all(|moment| moment.is_finite()) {
            return None;
        }
        let scatter = (moments / places.len() as f64).symmetric_eigen();
        let mut widths = scatter
            .eigenvalues
            .map(|square| size * square.max(0.0).sqrt());
        let mut axes = scatter.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.swap_columns(0, 1);
            widths.swap_rows(0, 1);
        }
        (widths.min() > 0.0).then(|| Self {
            round: Matrix2::from_diagonal(&widths.map(f64::recip)) * axes.transpose(),
            back: axes * Matrix2::from_diagonal(&widths),
        })
    }
}

/// Whether the centre sees all triangles from inside.
fn is_star_shaped(mesh: &Mesh, centre: &Point3<f64>) -> bool {
    mesh.triangles.iter().all(|corners| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize] - centre);
        a.cross(&b).dot(&c) > 0.0
    })
}

/// A projected vertex.
struct Place {
    position: Vector2<f64>,
    /// From the centre.
    distance: f64,
    /// In steps of the azimuths, from 0 up to their number.
    azimuth: f64,
}

impl Place {
    fn of(position: Vector2<f64>) -> Self {
        let turns = position.y.atan2(position.x) / TAU;
        let turns = if turns < 0.0 { turns + 1.0 } else { turns };
        Self {
            position,
            distance: position.norm(),
            azimuth: turns * OUTLINE_AZIMUTHS as f64,
        }
    }

    /// The azimuths from here to another place, which may be counted beyond the last; `None` if it lies
    /// clockwise from here.
    fn span_to(&self, other: &Self) -> Option<std::ops::RangeInclusive<usize>> {
        let round = OUTLINE_AZIMUTHS as f64;
        let ahead = other.azimuth - self.azimuth;
        let end = if ahead < -round / 2.0 {
            other.azimuth + round
        } else if (0.0..=round / 2.0).contains(&ahead) {
            other.azimuth
        } else {
            return None;
        };
        Some(self.azimuth.ceil() as usize..=end.floor() as usize)
    }

    /// Distance from the centre at which a ray crosses the edge to another place, no farther than the
    /// farther end.
    fn crossing(&self, other: &Self, direction: &Vector2<f64>) -> f64 {
        let farther = self.distance.max(other.distance);
        let edge = other.position - self.position;
        let radius = self.position.perp(&edge) / direction.perp(&edge);
        if radius.is_finite() {
            radius.min(farther)
        } else {
            farther
        }
    }
}

/// The outline through the samples and the vertices farthest outside it, one between two samples.
fn with_corners(samples: &[Vector2<f64>], places: &[Place]) -> Vec<Vector2<f64>> {
    let after = |azimuth: usize| samples[(azimuth + 1) % samples.len()];
    let mut corners: Vec<Option<(f64, Vector2<f64>)>> = vec![None; samples.len()];
    for place in places {
        let azimuth = place.azimuth as usize % samples.len();
        let sample = samples[azimuth];
        let excess = (place.position - sample).perp(&(after(azimuth) - sample));
        if excess > corners[azimuth].map_or(0.0, |corner| corner.0) {
            corners[azimuth] = Some((excess, place.position));
        }
    }
    let with_corner = samples.iter().zip(corners);
    with_corner
        .flat_map(|(sample, corner)| std::iter::once(*sample).chain(corner.map(|corner| corner.1)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Rotation3};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
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
