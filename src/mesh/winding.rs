//! How often a closed surface goes round a point: whether the point is inside.

use super::Mesh;
use nalgebra::{Point3, Vector2, Vector3};
use std::f64::consts::TAU;

/// The winding number of a mesh about a point off it: the sum of the solid angles of its triangles over
/// 4 pi. One inside of a closed mesh that is wound counter-clockwise
/// from outside, zero outside and in cavities; of an open one, a fraction (Jacobson, Kavan and
/// Sorkine-Hornung 2013). All triangles must name vertices that exist.
pub(crate) fn winding_number(mesh: &Mesh, point: &Point3<f64>) -> f64 {
    let away = |vertex: &Point3<f64>| (vertex - point, (vertex - point).norm());
    let seen: Vec<(Vector3<f64>, f64)> = mesh.vertices.iter().map(away).collect();
    let half_angles = mesh
        .triangles
        .iter()
        .map(|corners| half_angle(corners.map(|corner| seen[corner as usize])));
    sum_of_angles(half_angles) / TAU
}

/// The solid angle that a triangle fills, seen from the origin: above zero where it is wound counter-clockwise from outside.
pub(crate) fn solid_angle(corners: [Vector3<f64>; 3]) -> f64 {
    let half = half_angle(corners.map(|corner| (corner, corner.norm())));
    2.0 * half.y.atan2(half.x)
}

/// A vector at half of that angle from the x-axis, of corners and their distances (van Oosterom and Strackee 1983).
fn half_angle([(a, la), (b, lb), (c, lc)]: [(Vector3<f64>, f64); 3]) -> Vector2<f64> {
    let volume = a.dot(&b.cross(&c));
    let across = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    Vector2::new(across, volume)
}

/// The sum of the angles of vectors from the x-axis, each between -pi and pi. Those of acute angles are multiplied as complex
/// numbers as long as the product's angle is acute too, for that is cheaper than to find each angle.
fn sum_of_angles(vectors: impl Iterator<Item = Vector2<f64>>) -> f64 {
    let angle = |v: Vector2<f64>| v.y.atan2(v.x);
    let (mut sum, mut product) = (0.0, Vector2::x());
    for v in vectors {
        if v.x > 0.0 && product.x > 0.0 {
            let next = Vector2::new(
                product.x * v.x - product.y * v.y,
                product.x * v.y + product.y * v.x,
            );
            product = next / next.amax();
        } else {
            sum += angle(product);
            product = v;
        }
    }
    sum + angle(product)
}

/// The winding number of a closed polygon about a point of the plane.
pub(crate) fn polygon_winding_number(corners: &[Vector2<f64>], point: &Vector2<f64>) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let angles = corners.iter().zip(next).map(|(from, to)| {
        let (from, to) = (from - point, to - point);
        Vector2::new(from.dot(&to), from.perp(&to))
    });
    sum_of_angles(angles) / TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_goes_round_its_inside_once() {
        let mut cube = Mesh::radial(3, |n| 1.0 / n.amax());
        for (place, expected) in [
            ([0.0, 0.0, 0.0], 1.0),
            ([0.99, -0.99, 0.99], 1.0),
            ([1.01, 0.0, 0.0], 0.0),
            ([5.0, 5.0, 5.0], 0.0),
        ] {
            let found = winding_number(&cube, &Point3::from(place));
            assert!((found - expected).abs() < 1e-12, "{place:?}: {found}");
        }
        cube.triangles
            .iter_mut()
            .for_each(|corners| corners.reverse());
        assert!((winding_number(&cube, &Point3::origin()) + 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_square_goes_round_its_inside_once() {
        let square = [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]].map(Vector2::from);
        for (place, expected) in [([0.9, 0.9], 1.0), ([1.1, 0.0], 0.0)] {
            let found = polygon_winding_number(&square, &Vector2::from(place));
            assert!((found - expected).abs() < 1e-12);
        }
    }
}
