//! How surfaces are curved over a whole contact, and not in its middle alone.
//!
//! Hertz's theory is for a gap that is a paraboloid as far as the contact reaches. Beside an edge it is none: across the planes
//! of a superquadric whose exponent is below two curvature has no bound, and that of a point tells nothing of the force.

use super::{Touch, UnionContact};
use crate::model::{Frame, MultiSuperquadric, Radial, Surface};
use crate::sphere::tangents;
use nalgebra::{Matrix2, Vector2, Vector3};

impl Touch {
    /// Curvatures of the surface that was touched along its two principal directions, each from the place touched to the
    /// places that lie so far to both sides of it. Those of the cap where an edge was rounded.
    pub fn curvatures_over(
        &self,
        surface: &(impl Surface + ?Sized),
        reaches: [f64; 2],
    ) -> [f64; 2] {
        match self.cap {
            Some(_) => self.principal,
            None => over(surface, &self.direction, &self.directions, reaches),
        }
    }
}

impl UnionContact {
    /// Principal curvatures over the contact, out to these reaches, of the parts of both unions that touch.
    pub fn curvatures_over(
        &self,
        bodies: [(&MultiSuperquadric, &Frame); 2],
        reaches: [f64; 2],
    ) -> [[f64; 2]; 2] {
        let found = self.curvatures(bodies);
        [0, 1].map(|body| {
            let (part, end) = self.end(bodies, body);
            let own = |v: Vector3<f64>| part.frame.axes.tr_mul(&v);
            let n = part.frame.to_local(&end).normalize();
            let directions = found[body].directions.map(own);
            over(&Radial(&part.shape), &n, &directions, reaches)
        })
    }
}

/// Curvatures of the circles through the place in the direction `n`, tangential to the surface there, and the places so far
/// to either side of it along two principal `directions`, which with the normal make a right-handed frame: the mean of both sides.
fn over(
    surface: &(impl Surface + ?Sized),
    n: &Vector3<f64>,
    directions: &[Vector3<f64>; 2],
    reaches: [f64; 2],
) -> [f64; 2] {
    let normal = directions[0].cross(&directions[1]);
    let (place, slopes) = surface.place_and_slopes(n);
    let steps = tangents(n);
    let slopes = steps.map(|step| slopes * step);
    let first = Matrix2::from_fn(|i, j| slopes[i].dot(&slopes[j]));
    let inverse = first.try_inverse().unwrap_or_else(Matrix2::zeros);
    let curvature = |along: Vector3<f64>| {
        let turn = inverse * Vector2::from(slopes.map(|slope| slope.dot(&along)));
        let aside = (n + steps[0] * turn.x + steps[1] * turn.y).normalize();
        let way = surface.place(&aside) - place;
        -2.0 * way.dot(&normal) / way.norm_squared()
    };
    [0, 1].map(|i| {
        let along = directions[i] * reaches[i];
        0.5 * (curvature(along) + curvature(-along))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{KnownContact, touch};
    use crate::model::{Part, Superquadric};
    use crate::shapes::Ellipsoid;
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3};

    #[test]
    fn a_sphere_is_curved_over_a_contact_as_in_its_middle() {
        let ball = Ellipsoid {
            semi_axes: Vector3::repeat(2.0),
        };
        let touched = touch(&Radial(&ball), &Vector3::new(1.0, 2.0, 3.0), None).unwrap();
        let found = touched.curvatures_over(&Radial(&ball), [0.1, 0.7]);
        assert_relative_eq!(found[0], 0.5, max_relative = 1e-12);
        assert_relative_eq!(found[1], 0.5, max_relative = 1e-12);
    }

    /// Of an ellipsoid whose lower half is half as high: curved by a / c² = 1 above and 4 below.
    #[test]
    fn both_sides_count_where_curvature_jumps() {
        let halves = Superquadric::poly8([[1.0; 2], [2.0; 2], [1.0, 0.5]], 2.0, 2.0).unwrap();
        let touched = touch(&Radial(&halves), &Vector3::x(), None).unwrap();
        let found = touched.curvatures_over(&Radial(&halves), [1e-3; 2]);
        assert_relative_eq!(found[0], 2.5, max_relative = 1e-5);
        assert_relative_eq!(found[1], 0.25, max_relative = 1e-5);
    }

    /// A grain of one superquadric of semi-axes 1.
    fn union(n1: f64) -> MultiSuperquadric {
        let part = Part {
            shape: Superquadric::single([1.0; 3], n1, 2.0).unwrap(),
            frame: Frame::SCAN,
        };
        MultiSuperquadric::new(vec![part]).unwrap()
    }

    /// z = 1 - x^n / n beside the tip: a circle through x has the curvature 2 x^(n-2) / n.
    #[test]
    fn an_edge_is_curved_by_the_power_law_of_its_exponent() {
        let (edge, ball) = (union(1.5), union(2.0));
        let frame = Frame {
            centre: Point3::new(3.0, 2.0, 1.0),
            axes: *Rotation3::from_euler_angles(0.3, 0.5, 0.7).matrix(),
        };
        let up = frame.axes * Vector3::z();
        let touch = UnionContact {
            parts: [0, 0],
            point: frame.centre + up * (1.0 - 1e-6),
            normal: up,
            overlap: 2e-6,
        };
        let above = Frame {
            centre: frame.centre + up * (2.0 - 2e-6),
            ..Frame::SCAN
        };
        let bodies = [(&edge, &frame), (&ball, &above)];
        let found = touch.curvatures_over(bodies, [1e-3, 4e-3]);
        assert_relative_eq!(
            found[0][0],
            2.0 / 1e-3_f64.sqrt() / 1.5,
            max_relative = 5e-3
        );
        assert_relative_eq!(
            found[0][1],
            2.0 / 4e-3_f64.sqrt() / 1.5,
            max_relative = 5e-3
        );
        assert_relative_eq!(found[1][0], 1.0, max_relative = 1e-9);
        let known = KnownContact::at(&touch.curvatures(bodies), None).unwrap();
        assert!(known.times(found).unwrap() > 5.0);
    }
}
