//! On which side points lie: signs that rounding does not change (Shewchuk 1997).

use nalgebra::{Point3, Vector2};
use robust::{Coord, Coord3D};

/// Twice the area of the triangle a, b, c: above zero where these run counter-clockwise.
pub(crate) fn orient2d([a, b, c]: [Vector2<f64>; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    robust::orient2d(a, b, c)
}

/// Six times the volume of a tetrahedron: above zero where d lies below the plane of a, b and c, that is on the side from
/// which these run clockwise.
pub(crate) fn orient3d([a, b, c]: [Point3<f64>; 3], d: Point3<f64>) -> f64 {
    let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    robust::orient3d(a, b, c, d)
}
