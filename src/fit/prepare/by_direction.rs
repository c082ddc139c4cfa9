//! The mesh that points draw as seen from a centre: the triangulation of their directions.

use super::strays::{Strays, find_strays};
use crate::fit::error::FitError;
use crate::fit::points::rounder::rounder;
use crate::measure::{Scale, mesh_properties};
use crate::mesh::Mesh;
use crate::sphere::triangulate_directions;
use nalgebra::{Matrix3, Point3, Vector3};

/// Median scatter of neighbouring radii beyond which points do not form one surface.
const LARGEST_SCATTER: f64 = 0.1;

/// Least extent of a body over its largest, below which it is not made rounder.
const FLATTEST: f64 = 1e-3;

/// The mesh of points that form one surface round a centre, and which of them stand apart from their neighbours.
///
/// Points of a long body differ from their neighbours by its shape: where some stand apart they are looked at also in a space in
/// which it is as wide as it is long, and those are strays that stand apart in both. Of few points only that space tells.
pub(super) fn one_surface(
    points: &[Point3<f64>],
    centre: &Point3<f64>,
) -> Result<(Mesh, Vec<u32>), FitError> {
    let (mesh, Strays { indices, scatter }) = seen(points.to_vec(), centre)?;
    let is_one = scatter <= LARGEST_SCATTER;
    if is_one && indices.is_empty() {
        return Ok((mesh, indices));
    }
    let refused = FitError::Scattered { scatter };
    let Some(places) = rounded(&mesh, centre) else {
        return is_one.then_some((mesh, indices)).ok_or(refused);
    };
    let (Mesh { triangles, .. }, rounded) = seen(places, &Point3::origin())?;
    if is_one {
        let is_in_both = |index: &u32| rounded.indices.binary_search(index).is_ok();
        return Ok((mesh, indices.into_iter().filter(is_in_both).collect()));
    }
    match rounded.scatter <= LARGEST_SCATTER {
        true => Ok((Mesh { triangles, ..mesh }, rounded.indices)),
        false => Err(refused),
    }
}

/// The mesh of points, and those that stand apart.
fn seen(points: Vec<Point3<f64>>, centre: &Point3<f64>) -> Result<(Mesh, Strays), FitError> {
    let mesh = mesh_of_directions(points, centre)?;
    let strays = find_strays(&mesh, centre);
    Ok((mesh, strays))
}

/// The vertices of a mesh about its centre, in a space in which its second moments are the same in all directions. `None` if
/// it is flat.
fn rounded(mesh: &Mesh, centre: &Point3<f64>) -> Option<Vec<Point3<f64>>> {
    let inertia = mesh_properties(&Scale::of(mesh).mesh(mesh)).ok()?.inertia;
    let moments = Matrix3::from_diagonal_element(0.5 * inertia.trace()) - inertia;
    let (map, stretch) = rounder(moments)?;
    (FLATTEST * stretch < 1.0).then_some(())?;
    let places = mesh.vertices.iter().map(|point| map * (point - centre));
    Some(places.map(Point3::from).collect())
}

fn mesh_of_directions(points: Vec<Point3<f64>>, centre: &Point3<f64>) -> Result<Mesh, FitError> {
    let directions: Vec<Vector3<f64>> = points
        .iter()
        .map(|p| {
            let d = p - centre;
            let length = d.norm();
            if length > 0.0 {
                d / length
            } else {
                Vector3::z()
            }
        })
        .collect();
    let triangles = triangulate_directions(&directions).map_err(|_| FitError::NoVolume)?;
    Ok(Mesh {
        vertices: points,
        triangles,
    })
}

#[cfg(test)]
mod tests {
    use super::super::middle::middle;
    use super::*;
    use crate::shapes::Sampling;
    use std::f64::consts::TAU;

    fn points(count: usize, place: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(count, 0).unwrap();
        directions.iter().map(|n| Point3::from(place(n))).collect()
    }

    #[test]
    fn few_points_of_a_long_body_are_one_surface_and_its_stray_is_found() {
        let radius = |n: &Vector3<f64>| 1.0 / n.component_div(&Vector3::new(1.0, 1.5, 6.0)).norm();
        let mut rice = points(98, |n| n * radius(n));
        let centre = Point3::origin();
        assert!(seen(rice.clone(), &centre).unwrap().1.scatter > LARGEST_SCATTER);
        let (mesh, strays) = one_surface(&rice, &centre).unwrap();
        assert_eq!(mesh.vertices, rice);
        assert_eq!(mesh.triangles.len(), 2 * 98 - 4);
        assert!(strays.is_empty());
        rice[40] *= 2.0;
        assert_eq!(one_surface(&rice, &centre).unwrap().1, [40]);
    }

    #[test]
    fn points_of_a_long_body_in_rings_are_no_strays() {
        let rings = (0..14).flat_map(|ring| {
            let height = (2.0 * f64::from(ring) + 1.0) / 14.0 - 1.0;
            (0..200).map(move |at| {
                let (sin, cos) = (TAU * f64::from(at) / 200.0).sin_cos();
                let across = (1.0 - height * height).sqrt();
                Point3::new(0.5 * height, 0.5 * across * cos, 8.0 * across * sin)
            })
        });
        let mut rings: Vec<Point3<f64>> = rings.collect();
        let centre = middle(&rings);
        let (_, plain) = seen(rings.clone(), &centre).unwrap();
        assert!(!plain.indices.is_empty());
        assert!(one_surface(&rings, &centre).unwrap().1.is_empty());
        rings[1500] *= 1.5;
        assert_eq!(one_surface(&rings, &centre).unwrap().1, [1500]);
    }

    #[test]
    fn points_at_any_distance_are_no_surface() {
        // Radii that jump from point to point, in no order.
        let jump = |n: &Vector3<f64>| n * (1.0 + (1e4 * n.x).sin().abs());
        let cloud = points(300, |n| jump(n).component_mul(&Vector3::new(1.0, 1.0, 4.0)));
        let found = one_surface(&cloud, &Point3::origin());
        assert!(matches!(found, Err(FitError::Scattered { .. })));
        let flat = points(300, |n| {
            jump(n).component_mul(&Vector3::new(1.0, 1.0, 1e-6))
        });
        let found = one_surface(&flat, &Point3::origin());
        assert!(matches!(found, Err(FitError::Scattered { .. })));
    }
}
