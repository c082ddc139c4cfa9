//! The distance of a point from a superquadric, and what it changes by.
//!
//! With X = |x/a| and so on, p the n2-norm of (X, Y) and g the n1-norm of (p, Z), the derivatives of log g by log X,
//! log Y and log Z are shares that add up to one; all others follow from them. Powers are of ratios below one only.

use super::bodies::Body;
use super::form::Form;
use nalgebra::{Matrix3, Vector3};
use std::array::from_fn;

/// Numbers that the distance of a point from one body depends on: three semi-axes, two exponents, rotation, centre.
pub(super) const TOUCHED: usize = 11;

/// Octants of a body: its sides along x, y and z.
pub(super) const OCTANTS: usize = 8;

/// Coordinates nearer to zero, in mean radii, are as if they were so far from it.
const TINY: f64 = 1e-100;

/// A body made ready for the distances of many points.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReadyBody {
    axes: Matrix3<f64>,
    centre: Vector3<f64>,
    octants: [Octant; OCTANTS],
    least_axis: f64,
}

#[derive(Debug, Clone, Copy)]
struct Octant {
    /// One over the semi-axes.
    per_axis: [f64; 3],
    /// n1, n2.
    exponents: [f64; 2],
    /// One over n1, n2.
    per_exponent: [f64; 2],
}

/// The distance of a point from a body along the ray from its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distance {
    /// |y| (1 - 1 / g) of the point y in the body's frame: above zero outside.
    pub(super) value: f64,
    pub(super) octant: usize,
    /// The point y.
    at: Vector3<f64>,
    /// |y| / g.
    radius: f64,
    /// By how much of y the distance grows along y.
    along: f64,
    /// Derivatives of log g by the logarithms of X, Y, Z, and of n1, n2.
    shares: [f64; 3],
    by_exponents: [f64; 2],
}

/// The n-norm of two numbers, all in logarithms over that of the first.
struct Norm {
    /// The logarithm of the norm.
    logarithm: f64,
    /// Its derivatives by the logarithms of both numbers.
    shares: [f64; 2],
    /// And by that of n.
    by_exponent: f64,
}

impl Norm {
    #[inline(always)]
    fn new(second: f64, n: f64, per_n: f64) -> Self {
        let ratio = -second.abs();
        let power = (n * ratio).exp();
        let sum = 1.0 + power;
        let growth = sum.ln() * per_n;
        let larger = 1.0 / sum;
        let smaller = power * larger;
        Self {
            logarithm: second.max(0.0) + growth,
            shares: match second > 0.0 {
                true => [smaller, larger],
                false => [larger, smaller],
            },
            by_exponent: ratio * smaller - growth,
        }
    }
}

impl ReadyBody {
    pub(super) fn new(body: &Body) -> Self {
        let numbers = body.numbers();
        let octant = |octant: usize| {
            let [a, b, c, n1, n2] = touched(octant).map(|number| numbers[number]);
            Octant {
                per_axis: [1.0 / a, 1.0 / b, 1.0 / c],
                exponents: [n1, n2],
                per_exponent: [1.0 / n1, 1.0 / n2],
            }
        };
        Self {
            axes: body.axes,
            centre: body.centre,
            octants: from_fn(octant),
            least_axis: numbers[0].min(numbers[2]).min(numbers[4]),
        }
    }

    /// The distance of a point.
    #[inline(always)]
    pub(super) fn distance(&self, point: &Vector3<f64>) -> Distance {
        let at = self.axes.tr_mul(&(point - self.centre));
        let side = |axis: usize| usize::from(at[axis] < 0.0) << axis;
        let octant = side(0) | side(1) | side(2);
        let Octant {
            per_axis,
            exponents: [n1, n2],
            per_exponent: [per_n1, per_n2],
        } = self.octants[octant];
        let [x, y, z] = from_fn(|axis| (at[axis].abs() * per_axis[axis]).max(TINY));
        let inner = Norm::new((y / x).ln(), n2, per_n2);
        let outer = Norm::new((z / x).ln() - inner.logarithm, n1, per_n1);
        let g = x * (inner.logarithm + outer.logarithm).exp();
        let length = at.norm();
        let [of_inner, of_z] = outer.shares;
        // Written so that NaN is taken for the very centre, where there is no ray.
        let has_ray = g > 1e-12;
        let inverse = if has_ray { 1.0 / g } else { 0.0 };
        let value = match has_ray {
            true => length * (1.0 - inverse),
            false => -self.least_axis,
        };
        Distance {
            value,
            octant,
            at,
            radius: length * inverse,
            along: if has_ray {
                value / (length * length)
            } else {
                0.0
            },
            shares: [of_inner * inner.shares[0], of_inner * inner.shares[1], of_z],
            by_exponents: [outer.by_exponent, of_inner * inner.by_exponent],
        }
    }
}

impl Distance {
    /// Derivatives by the logarithms of a, b, c, n1, n2 of the octant, rotation and centre in the body's frame.
    #[inline(always)]
    pub(super) fn slopes(&self) -> [f64; TOUCHED] {
        let per_axis = |axis: usize| {
            let at = self.at[axis];
            self.radius * self.shares[axis] / at.abs().max(TINY).copysign(at)
        };
        let steep = Vector3::new(per_axis(0), per_axis(1), per_axis(2));
        let turned = steep.cross(&self.at);
        let outward = steep + self.at * self.along;
        let [a, b, c] = self.shares.map(|share| -self.radius * share);
        let [n1, n2] = self.by_exponents.map(|share| self.radius * share);
        [
            a, b, c, n1, n2, turned.x, turned.y, turned.z, -outward.x, -outward.y, -outward.z,
        ]
    }
}

/// Which of the twelve numbers an octant has: a, b, c, n1, n2.
fn touched(octant: usize) -> [usize; 5] {
    let [x, y, z] = [octant & 1, octant >> 1 & 1, octant >> 2];
    [x, 2 + y, 4 + z, 6 + z, 8 + 2 * x + y]
}

/// Which parameters of a body of some form its slopes are by.
pub(super) fn places(form: Form, octant: usize) -> [usize; TOUCHED] {
    let ties = form.ties();
    let touched = touched(octant);
    from_fn(|i| match touched.get(i) {
        Some(&number) => ties[number],
        None => form.parameters() + i - TOUCHED,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::superquadric::form::{NUMBERS, POSE};
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;

    #[test]
    fn distances_have_the_slopes_of_differences() {
        let body = Body {
            logs: [0.1, -0.2, 0.3, 0.0, -0.4, 0.2, 1.2, 0.6, 0.9, 1.4, 0.5, 1.1],
            axes: Rotation3::from_euler_angles(0.3, 0.5, -0.7).into_inner(),
            centre: Vector3::new(0.1, -0.1, 0.05),
        };
        let form = Form::Poly12;
        for i in 0..40 {
            let t = 2.4 * f64::from(i) + 0.1;
            let z = (f64::from(i) + 0.5) / 20.0 - 1.0;
            let point = Vector3::new(t.cos(), t.sin(), 2.0 * z);
            let distance = ReadyBody::new(&body).distance(&point);
            let places = places(form, distance.octant);
            for (slope, place) in distance.slopes().into_iter().zip(places) {
                let moved = |step: f64| {
                    let mut steps = [0.0; NUMBERS + POSE];
                    steps[place] = step;
                    ReadyBody::new(&body.moved(form, &steps))
                        .distance(&point)
                        .value
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                assert_relative_eq!(difference, slope, epsilon = 1e-8, max_relative = 1e-6);
            }
        }
    }

    #[test]
    fn on_axes_and_at_the_centre_distances_are_known() {
        let axes = Vector3::new(0.5, 1.0, 2.0);
        let body = Body::start(Vector3::zeros(), Matrix3::identity(), axes);
        let ready = ReadyBody::new(&body);
        for axis in 0..3 {
            let distance = ready.distance(&Vector3::ith(axis, -3.0));
            assert_relative_eq!(distance.value, 3.0 - axes[axis], max_relative = 1e-12);
            assert!(distance.slopes().iter().all(|slope| slope.is_finite()));
        }
        let centre = ready.distance(&Vector3::zeros());
        assert_relative_eq!(centre.value, -0.5, max_relative = 1e-12);
        assert!(centre.slopes().iter().all(|slope| *slope == 0.0));
    }
}
