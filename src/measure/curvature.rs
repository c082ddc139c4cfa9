//! Normals, fundamental forms and curvatures of a surface at a point.
//!
//! For unit tangents s and t of the sphere at n, the surface X has
//!
//! ```text
//! normal    = X_s x X_t / |X_s x X_t|                 (outward where s x t = n)
//! first     I(s, t)  = X_s . X_t
//! second    II(s, t) = -X_st . normal
//! ```
//!
//! Of a star-shaped surface, with r the radius, g its surface gradient and H its second covariant derivatives on
//! the sphere, these are (r n - g) / W, r² s.t + (g.s)(g.t) and (r² s.t + 2 (g.s)(g.t) - r s.H t) / W with
//! W = sqrt(r² + |g|²): (2.42)–(2.47) of Radvilaite 2016, where dot products are printed as plain ones, written
//! for directions instead of angles, so that nothing is singular at the poles. The tangents are turned until the first
//! form is diagonal, so that nothing cancels. The second form is taken to the inward normal: curvatures are positive
//! where the surface is convex.
//!
//! Error: that of the derivatives, times a few roundings.

pub(super) mod corners;
pub(super) mod kind;
pub(super) mod peaks;
pub(super) mod statistics;
pub(super) mod unfollowed;

use crate::model::SurfaceJet;
use crate::sphere::tangents;
use nalgebra::{Matrix2, Vector3};

/// The shape of a surface round one of its points, in the frame of its [`SurfaceJet`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvature {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    /// Two orthogonal unit tangents of the sphere of directions.
    pub steps: [Vector3<f64>; 2],
    /// The derivatives of the surface along them: length per radian, orthogonal to each other and to the normal.
    pub tangents: [Vector3<f64>; 2],
    /// First fundamental form in these tangents, \[\[E, F\], \[F, G\]\], with F = 0: length squared.
    pub first: Matrix2<f64>,
    /// Second fundamental form \[\[L, M\], \[M, N\]\], to the inward normal: length.
    pub second: Matrix2<f64>,
    /// Principal curvatures, the larger first, positive where convex: one over length.
    pub principal: [f64; 2],
    /// Unit vectors along which the principal curvatures are met, tangential to the surface; with the
    /// normal they make a right-handed frame (first, second, normal). At an umbilic any two.
    pub directions: [Vector3<f64>; 2],
}

impl Curvature {
    /// The curvature in the direction of the unit vector `n`, where the surface has these derivatives.
    /// Not finite where they are not, or where the surface has no normal.
    pub fn new(n: &Vector3<f64>, jet: &SurfaceJet) -> Self {
        let turned = |[s, t]: [Vector3<f64>; 2], angle: f64| {
            let (sin, cos) = angle.sin_cos();
            [s * cos + t * sin, t * cos - s * sin]
        };
        let any = tangents(n);
        let [along, across] = any.map(|step| jet.slopes * step);
        let spread = (along - across).dot(&(along + across));
        let steps = turned(any, 0.5 * (2.0 * along.dot(&across)).atan2(spread));
        let tangents = steps.map(|step| jet.slopes * step);
        let lengths = tangents.map(|tangent| tangent.norm());
        let normal = tangents[0].cross(&tangents[1]).normalize();
        let [x, y, z] = &jet.bends;
        let bend = x * normal.x + y * normal.y + z * normal.z;
        let form = |i: usize, j: usize| -steps[i].dot(&(bend * steps[j]));
        let (l, m, n_n) = (form(0, 0), form(0, 1), form(1, 1));

        // Per unit length instead of per radian: the matrix of the shape operator is symmetric.
        let [e, g] = lengths;
        let (a, b, c) = (l / (e * e), m / (e * g), n_n / (g * g));
        let units = [tangents[0] / e, tangents[1] / g];
        let (mean, half_spread) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
        Self {
            normal,
            steps,
            tangents,
            first: Matrix2::new(e * e, 0.0, 0.0, g * g),
            second: Matrix2::new(l, m, m, n_n),
            principal: [mean + half_spread, mean - half_spread],
            directions: turned(units, 0.5 * (2.0 * b).atan2(a - c)),
        }
    }

    /// The turn of the direction, in radians along the sphere, that moves along the surface by `step`.
    pub(super) fn turn(&self, step: &Vector3<f64>) -> Vector3<f64> {
        let along = |i: usize| {
            let tangent = self.tangents[i];
            self.steps[i] * (step.dot(&tangent) / tangent.norm_squared())
        };
        along(0) + along(1)
    }

    /// The area of the surface per solid angle of directions.
    pub(super) fn area(&self) -> f64 {
        self.tangents[0].norm() * self.tangents[1].norm()
    }

    /// Mean curvature H = (E N + G L - 2 F M) / (2 (E G - F²)): half the sum of the principal ones.
    pub fn mean(&self) -> f64 {
        0.5 * (self.principal[0] + self.principal[1])
    }

    /// Gaussian curvature K = (L N - M²) / (E G - F²): the product of the principal ones.
    pub fn gaussian(&self) -> f64 {
        self.principal[0] * self.principal[1]
    }

    /// Normal curvature along a unit tangent of the surface, k1 cos² + k2 sin² (Euler).
    pub fn along(&self, tangent: &Vector3<f64>) -> f64 {
        let [first, second] = self
            .directions
            .map(|direction| direction.dot(tangent).powi(2));
        self.principal[0] * first + self.principal[1] * second
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Derivatives, Radial, StarSurface, Surface};
    use crate::shapes::{Body, Cylinder, Ellipsoid, Sampling};
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    fn at(surface: &(impl StarSurface + ?Sized), n: &Vector3<f64>) -> Curvature {
        Curvature::new(n, &Radial(surface).jet(n))
    }

    /// All over the sphere, and along the axes: both poles and four points of the equator.
    fn directions() -> Vec<Vector3<f64>> {
        let mut all = Sampling::Fibonacci.directions(400, 0).unwrap();
        all.extend(Sampling::Cube.directions(26, 0).unwrap());
        all
    }

    /// K = h⁴/(abc)² and H = h³ (a² + b² + c² - |x|²)/(2 (abc)²), with h the distance of the tangent
    /// plane from the centre (Poelaert, Schniewind and Janssens 2011).
    fn check_ellipsoid(semi_axes: Vector3<f64>, n: &Vector3<f64>) {
        let ellipsoid = Ellipsoid { semi_axes };
        let x = n * ellipsoid.radius(n);
        let squares = semi_axes.component_mul(&semi_axes);
        let slope = x.component_div(&squares);
        let h = 1.0 / slope.norm();
        let gaussian = h.powi(4) / squares.product();
        let mean = h.powi(3) * (squares.sum() - x.norm_squared()) / (2.0 * squares.product());
        let found = at(&ellipsoid, n);
        assert_relative_eq!(found.normal, slope.normalize(), epsilon = 1e-13);
        assert_relative_eq!(found.gaussian(), gaussian, max_relative = 1e-10);
        assert_relative_eq!(found.mean(), mean, max_relative = 1e-10);
        // Rodrigues: along a principal direction d the normal turns by k d per unit length. The
        // normal of an ellipsoid is m(x)/|m(x)| with m = x/a².
        for (k, d) in found.principal.into_iter().zip(found.directions) {
            let change = d.component_div(&squares) * h;
            let turn = change - found.normal * change.dot(&found.normal);
            assert!((turn - d * k).norm() < 1e-10 * found.principal[0], "{n:?}");
            assert_relative_eq!(found.along(&d), k, max_relative = 1e-9);
        }
    }

    #[test]
    fn ellipsoids_have_their_closed_form_everywhere_and_at_the_poles() {
        for axes in [
            [2.0, 2.0, 1.0],
            [3.0, 2.0, 1.0],
            [1.0, 1.0, 4.0],
            [5.0, 5.0, 5.0],
        ] {
            for n in directions() {
                check_ellipsoid(Vector3::from(axes), &n);
            }
        }
    }

    proptest! {
        #[test]
        fn ellipsoids_of_any_axes_have_their_closed_form(
            axes in prop::array::uniform3(0.5..2.0_f64),
            n in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let n = Vector3::from(n);
            prop_assume!(n.norm() > 0.1);
            check_ellipsoid(Vector3::from(axes), &n.normalize());
        }

        #[test]
        fn a_surface_twice_as_large_is_half_as_curved_and_turns_with_its_frame(
            size in 0.01..100.0_f64,
            angles in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            let surface = Body::Maize.surface();
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).into_inner();
            for n in Sampling::Fibonacci.directions(40, 0).unwrap() {
                let one = surface.derivatives(&n);
                let other = Derivatives {
                    radius: one.radius * size,
                    gradient: one.gradient * size,
                    hessian: one.hessian * size,
                }
                .turned(&turn);
                let at = |n: Vector3<f64>, found: &Derivatives| Curvature::new(&n, &found.radial(&n));
                let [one, other] = [at(n, &one), at(turn * n, &other)];
                prop_assert!((turn * one.normal - other.normal).norm() < 1e-12);
                let largest = one.principal[0].abs().max(one.principal[1].abs());
                for (k, scaled) in one.principal.into_iter().zip(other.principal) {
                    prop_assert!((k - scaled * size).abs() < 1e-10 * largest);
                }
            }
        }
    }

    #[test]
    fn the_forms_are_those_of_the_printed_formulas() {
        let surface = Body::Bean.surface();
        for n in directions() {
            let found = at(surface.as_ref(), &n);
            let (first, second) = (found.first, found.second);
            let [s, t] = found.tangents;
            let products = Matrix2::new(s.dot(&s), s.dot(&t), s.dot(&t), t.dot(&t));
            assert_relative_eq!(first, products, epsilon = 1e-11);
            assert!(s.dot(&found.normal).abs() < 1e-12 && t.dot(&found.normal).abs() < 1e-12);
            let [e, f, g] = [first.m11, first.m12, first.m22];
            let [l, m, n] = [second.m11, second.m12, second.m22];
            let mean = (e * n + g * l - 2.0 * f * m) / (2.0 * (e * g - f * f));
            let gaussian = (l * n - m * m) / (e * g - f * f);
            assert_relative_eq!(found.mean(), mean, epsilon = 1e-12);
            assert_relative_eq!(found.gaussian(), gaussian, epsilon = 1e-12);
            let [first, second] = found.directions;
            assert_relative_eq!(first.cross(&second), found.normal, epsilon = 1e-12);
        }
    }

    #[test]
    fn flat_faces_are_flat_and_a_mantle_is_curved_one_way() {
        let cylinder = Cylinder {
            radius: 2.0,
            half_height: 1.0,
        };
        let side = at(&cylinder, &Vector3::new(0.6, 0.7, 0.1).normalize());
        assert_relative_eq!(side.principal[0], 0.5, epsilon = 1e-13);
        assert!(side.principal[1].abs() < 1e-13);
        assert_relative_eq!(side.directions[1].z.abs(), 1.0, epsilon = 1e-13);
        let end = at(&cylinder, &Vector3::new(0.2, 0.3, 0.9).normalize());
        assert!(end.principal.iter().all(|k| k.abs() < 1e-13));
    }
}
