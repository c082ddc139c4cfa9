//! The gauge of a superquadric: how many times the body must grow to reach a point.
//!
//! With X = |x/a| and so on, p the n2-norm of (X, Y) and g the n1-norm of (p, Z), the gauge is g: one on the surface,
//! convex, and homogeneous of degree one, so that the radius in the direction n is 1 / g(n). Powers are of ratios
//! below one only, so that nothing overflows.

use super::norm::{NormJet, Slopes};
use super::{Octant, Superquadric};
use crate::model::{Derivatives, StarSurface};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};
use std::array::from_fn;

impl Superquadric {
    /// The gauge g of a point: below one inside, one on the surface.
    #[inline]
    pub fn gauge(&self, x: &Vector3<f64>) -> f64 {
        self.gauge_and_slope(x).0
    }

    /// Whether the gauge of a point is below a bound. It is at least the largest of X, Y and Z, and at most their sum, which
    /// spares most points its powers.
    #[inline]
    pub(crate) fn is_gauge_below(&self, x: &Vector3<f64>, bound: f64) -> bool {
        let octant = self.octant((*x).into());
        let scaled = Vector3::from_fn(|axis, _| x[axis].abs() / octant.axes[axis]);
        scaled.max() < bound && (scaled.sum() < bound || self.gauge(x) < bound)
    }

    /// The gauge and its gradient, which is along the outward normal of the scaled body through the point; zero at the
    /// origin.
    #[inline]
    pub fn gauge_and_slope(&self, x: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let [found] = Self::gauges_and_slopes([self], [x]);
        found
    }

    /// The same of several bodies, each at a point of its own.
    #[inline]
    pub(crate) fn gauges_and_slopes<const N: usize>(
        bodies: [&Self; N],
        x: [&Vector3<f64>; N],
    ) -> [(f64, Vector3<f64>); N] {
        let octants: [Octant; N] = from_fn(|i| bodies[i].octant((*x[i]).into()));
        let scaled = |axis: usize| from_fn(|i: usize| x[i][axis].abs() / octants[i].axes[axis]);
        let exponents = octants.map(|octant| octant.n2 - 1.0);
        let inner = Slopes::side_by_side(scaled(0), scaled(1), exponents);
        let exponents = octants.map(|octant| octant.n1 - 1.0);
        let outer = Slopes::side_by_side(inner.map(|norm| norm.norm), scaled(2), exponents);
        from_fn(|i| {
            let ([p, z], [x, y]) = (outer[i].slopes, inner[i].slopes);
            let slopes = [p * x, p * y, z];
            let [x, y, z] = from_fn(|k| slopes[k] * octants[i].signs[k] / octants[i].axes[k]);
            match outer[i].norm > 0.0 {
                true => (outer[i].norm, Vector3::new(x, y, z)),
                false => (0.0, Vector3::zeros()),
            }
        })
    }

    /// The gauge with its first and second derivatives at a point other than the origin.
    #[inline]
    pub(crate) fn gauge_jet(&self, x: &Vector3<f64>) -> Jet {
        let [jet] = Self::gauge_jets([self], [x]);
        jet
    }

    /// The same of several bodies, each at a point of its own.
    #[inline]
    pub(crate) fn gauge_jets<const N: usize>(
        bodies: [&Self; N],
        x: [&Vector3<f64>; N],
    ) -> [Jet; N] {
        let octants: [Octant; N] = from_fn(|i| bodies[i].octant((*x[i]).into()));
        let scaled = |axis: usize| from_fn(|i: usize| x[i][axis].abs() / octants[i].axes[axis]);
        let exponents = octants.map(|octant| octant.n2);
        let inner = NormJet::side_by_side(scaled(0), scaled(1), exponents);
        let exponents = octants.map(|octant| octant.n1);
        let outer = NormJet::side_by_side(inner.map(|norm| norm.norm), scaled(2), exponents);
        from_fn(|i| jet(&octants[i], &inner[i], &outer[i]))
    }
}

/// The derivatives of the gauge by x, y, z, from those of its norms: with g_p, g_z the slopes of the outer norm and
/// p_x, p_y those of the inner, g_x = g_p p_x and g_xx = g_pp p_x² + g_p p_xx.
#[inline(always)]
fn jet(octant: &Octant, inner: &NormJet, outer: &NormJet) -> Jet {
    let g = outer.norm;
    let [per_a, per_b, per_c] = from_fn(|i| octant.signs[i] / octant.axes[i]);
    let [px, py] = inner.slopes();
    let [gp, gz] = outer.slopes();
    // (n - 1)/g times what the second derivatives of either norm are made of.
    let across = (octant.n1 - 1.0) / g * outer.powers[0] * outer.powers[1];
    let bent = (octant.n2 - 1.0) / g * outer.powers[0] * inner.powers[0] * inner.powers[1];
    let [rp, rz] = outer.ratios;
    let [rx, ry] = inner.ratios;
    let (gpp, gzz, gpz) = (across * rz * rz, across * rp * rp, -across * rp * rz);
    let xx = (gpp * px * px + bent * ry * ry) * per_a * per_a;
    let yy = (gpp * py * py + bent * rx * rx) * per_b * per_b;
    let xy = (gpp * px * py - bent * rx * ry) * per_a * per_b;
    let (xz, yz) = (gpz * px * per_a * per_c, gpz * py * per_b * per_c);
    let zz = gzz * per_c * per_c;
    Jet {
        value: g,
        gradient: Vector3::new(gp * px * per_a, gp * py * per_b, gz * per_c),
        hessian: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    }
}

impl StarSurface for Superquadric {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / self.gauge(n)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (gauge, slope) = self.gauge_and_slope(n);
        let r = 1.0 / gauge;
        (r, n * r - slope * (r * r))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        Derivatives::on_sphere(n, &self.gauge_jet(n).powf(-1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn bodies() -> Vec<Superquadric> {
        vec![
            Superquadric::single([3.0, 2.0, 1.0], 2.0, 2.0).unwrap(),
            Superquadric::single([1.0, 2.0, 1.5], 4.0, 2.0).unwrap(),
            Superquadric::single([1.0, 2.0, 1.5], 1.4, 1.7).unwrap(),
            Superquadric::single([1.0, 2.0, 1.5], 2.7, 8.0).unwrap(),
            Superquadric::poly8([[1.0, 1.5], [2.0, 1.0], [0.7, 0.9]], 3.0, 6.0).unwrap(),
            Superquadric::poly12(
                [[1.0, 1.5], [2.0, 1.0], [0.7, 0.9]],
                [2.5, 4.0],
                [[2.0, 3.0], [5.0, 1.8]],
            )
            .unwrap(),
        ]
    }

    fn directions() -> impl Iterator<Item = Vector3<f64>> {
        (0..60).map(|i| {
            let t = 2.4 * f64::from(i) + 0.1;
            let z = (f64::from(i) + 0.5) / 30.0 - 1.0;
            Vector3::new(t.cos(), t.sin(), 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z
        })
    }

    #[test]
    fn the_gauge_is_the_formula_of_the_body() {
        for body in bodies() {
            for x in directions() {
                let octant = body.octant(x.into());
                let [a, b, c] = octant.axes;
                let s = (x.x / a).abs().powf(octant.n2) + (x.y / b).abs().powf(octant.n2);
                let f = s.powf(octant.n1 / octant.n2) + (x.z / c).abs().powf(octant.n1);
                assert_relative_eq!(
                    body.gauge(&x),
                    f.powf(1.0 / octant.n1),
                    max_relative = 1e-13
                );
            }
        }
    }

    #[test]
    fn a_gauge_is_below_what_is_above_it() {
        for body in bodies() {
            for x in directions().chain([Vector3::zeros(), Vector3::x() * 3.0]) {
                let gauge = body.gauge(&x);
                for bound in [0.5, 0.99, 1.01, 2.0] {
                    let bound = bound * gauge.max(0.1);
                    assert_eq!(body.is_gauge_below(&x, bound), gauge < bound);
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let step = 1e-5;
        for body in bodies() {
            for x in directions() {
                let jet = body.gauge_jet(&x);
                let (value, slope) = body.gauge_and_slope(&x);
                assert_relative_eq!(jet.value, value, max_relative = 1e-14);
                assert_relative_eq!(jet.gradient, slope, epsilon = 1e-13);
                for i in 0..3 {
                    let aside = Vector3::ith(i, step);
                    let (more, up) = body.gauge_and_slope(&(x + aside));
                    let (less, down) = body.gauge_and_slope(&(x - aside));
                    let difference = (more - less) / (2.0 * step);
                    assert_relative_eq!(difference, jet.gradient[i], epsilon = 1e-7);
                    let difference = (up - down) / (2.0 * step);
                    let column = jet.hessian.column(i).into_owned();
                    assert_relative_eq!(difference, column, epsilon = 1e-4, max_relative = 1e-4);
                }
            }
        }
    }

    #[test]
    fn the_surface_of_an_ellipsoid_is_that_of_the_closed_form() {
        let axes = Vector3::new(3.0, 2.0, 1.0);
        for n in directions().chain([Vector3::x(), Vector3::y(), -Vector3::z()]) {
            let found = bodies()[0].derivatives(&n);
            let weights = axes.map(|axis: f64| axis.powi(-2));
            let square = Jet {
                value: n.component_mul(&n).dot(&weights),
                gradient: n.component_mul(&weights) * 2.0,
                hessian: Matrix3::from_diagonal(&weights) * 2.0,
            };
            let expected = Derivatives::on_sphere(&n, &square.powf(-0.5));
            assert_relative_eq!(found.radius, expected.radius, max_relative = 1e-14);
            assert_relative_eq!(found.gradient, expected.gradient, epsilon = 1e-13);
            assert_relative_eq!(found.hessian, expected.hessian, epsilon = 1e-12);
        }
    }

    #[test]
    fn normals_are_continuous_where_octants_meet() {
        let body = bodies()[5];
        for n in directions() {
            for axis in 0..3 {
                let (mut one, mut other) = (n, n);
                (one[axis], other[axis]) = (1e-14, -1e-14);
                let jump = body.gauge_and_slope(&one).1 - body.gauge_and_slope(&other).1;
                assert!(jump.norm() < 1e-9, "{jump}");
            }
        }
    }
}
