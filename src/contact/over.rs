//! How surfaces are curved over a whole contact, and not in its middle alone.
//!
//! Hertz's theory is for a gap that is a paraboloid as far as the contact reaches. Beside an edge it is none: across the planes
//! of a superquadric whose exponent is below two curvature has no bound, and that of a point tells nothing of the force.

use super::{Touch, UnionContact};
use crate::measure::Curvature;
use crate::model::{Frame, MultiSuperquadric, Radial, Surface};
use crate::sphere::tangents;
use nalgebra::{Matrix2, Vector2, Vector3};

impl Touch {
    /// Curvature of the surface that was touched, from the place touched to the one that lies so far `aside` of it, along its two
    /// principal directions. That of the cap where an edge was rounded.
    pub fn curvature_over(&self, surface: &(impl Surface + ?Sized), aside: &Vector2<f64>) -> f64 {
        match self.cap {
            Some(_) => {
                let squares = aside.component_mul(aside);
                squares.dot(&Vector2::from(self.principal)) / squares.sum()
            }
            None => over(
                surface,
                &self.direction,
                &self.directions[0].cross(&self.directions[1]),
                &(self.directions[0] * aside.x + self.directions[1] * aside.y),
            ),
        }
    }
}

impl UnionContact {
    /// How the gap between the parts of both unions that touch is curved, from the contact to so far `aside` of it, along the
    /// principal directions of the first. `found`: the [curvatures](Self::curvatures) there.
    pub fn curvature_over(
        &self,
        bodies: [(&MultiSuperquadric, &Frame); 2],
        found: &[Curvature; 2],
        aside: &Vector2<f64>,
    ) -> f64 {
        let [first, second] = found[0].directions;
        let aside = first * aside.x + second * aside.y;
        let of = |body: usize| {
            let (part, end) = self.end(bodies, body);
            let own = |v: &Vector3<f64>| part.frame.axes.tr_mul(v);
            let n = part.frame.to_local(&end).normalize();
            over(
                &Radial(&part.shape),
                &n,
                &own(&found[body].normal),
                &own(&aside),
            )
        };
        of(0) + of(1)
    }
}

/// Curvature of the circle through the place in the direction `n`, tangential to the surface there, and the place so far `aside` of
/// it. `normal`: of the surface, outwards.
fn over(
    surface: &(impl Surface + ?Sized),
    n: &Vector3<f64>,
    normal: &Vector3<f64>,
    aside: &Vector3<f64>,
) -> f64 {
    let (place, slopes) = surface.place_and_slopes(n);
    let steps = tangents(n);
    let slopes = steps.map(|step| slopes * step);
    let first = Matrix2::from_fn(|i, j| slopes[i].dot(&slopes[j]));
    let inverse = first.try_inverse().unwrap_or_else(Matrix2::zeros);
    let turn = inverse * Vector2::from(slopes.map(|slope| slope.dot(aside)));
    let there = (n + steps[0] * turn.x + steps[1] * turn.y).normalize();
    let way = surface.place(&there) - place;
    -2.0 * way.dot(normal) / way.norm_squared()
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
        for aside in [Vector2::new(0.1, 0.0), Vector2::new(-0.3, 0.7)] {
            let found = touched.curvature_over(&Radial(&ball), &aside);
            assert_relative_eq!(found, 0.5, max_relative = 1e-12);
        }
    }

    /// Of an ellipsoid whose lower half is half as high: curved by a / c² = 1 above and 4 below.
    #[test]
    fn curvature_may_jump_from_one_side_to_the_other() {
        let halves = Superquadric::poly8([[1.0; 2], [2.0; 2], [1.0, 0.5]], 2.0, 2.0).unwrap();
        let touched = touch(&Radial(&halves), &Vector3::x(), None).unwrap();
        let along = |aside: Vector2<f64>| touched.curvature_over(&Radial(&halves), &(aside * 1e-3));
        let mut steep = [along(Vector2::x()), along(-Vector2::x())];
        steep.sort_by(f64::total_cmp);
        assert_relative_eq!(steep[0], 1.0, max_relative = 1e-5);
        assert_relative_eq!(steep[1], 4.0, max_relative = 1e-5);
        assert_relative_eq!(along(Vector2::y()), 0.25, max_relative = 1e-5);
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
        let found = touch.curvatures(bodies);
        let gap = |aside: &Vector2<f64>| touch.curvature_over(bodies, &found, aside);
        for (aside, distance) in [(Vector2::x(), 1e-3_f64), (-Vector2::y(), 4e-3)] {
            let aside = aside * distance;
            let expected = 1.0 + 2.0 / distance.sqrt() / 1.5;
            assert_relative_eq!(gap(&aside), expected, max_relative = 5e-3);
        }
        let known = KnownContact::at(&found, None).unwrap();
        assert!(known.times(touch.overlap, gap).unwrap() > 5.0);
    }
}
