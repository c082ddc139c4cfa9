//! Superquadrics on their way through a fit, and the distance of a point from them.

use super::form::{EXPONENTS_FROM, Form, NUMBERS, POSE};
use crate::model::{Frame, InvalidSuperquadric, Superquadric};
use nalgebra::{Matrix3, Point3, Rotation3, SVector, Vector3};
use std::array::from_fn;

/// Numbers that the distance of a point from one body depends on: three semi-axes, two exponents, rotation, centre.
pub(super) const TOUCHED: usize = 11;

/// Bounds of the logarithms of semi-axes, in mean radii, and of exponents.
const SEMI_AXES: [f64; 2] = [-4.0, 4.0];
const EXPONENTS: [f64; 2] = [0.262_364_264_467_491_06, 2.995_732_273_553_991];

/// The logarithm of the exponent that fits begin with, and lean on where the points tell nothing: 2.2.
pub(super) const USUAL_EXPONENT: f64 = 0.788_457_360_364_270_2;

/// A superquadric with its pose.
#[derive(Debug, Clone, Copy)]
pub(super) struct Body {
    /// Logarithms of the twelve numbers.
    pub(super) logs: [f64; NUMBERS],
    pub(super) axes: Matrix3<f64>,
    pub(super) centre: Vector3<f64>,
}

/// The radial distance of a point from a body, and what it changes by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distance {
    pub(super) value: f64,
    /// Derivatives by the logarithms of a, b, c, n1, n2 of the octant, rotation and centre in the body's frame.
    pub(super) slopes: [f64; TOUCHED],
    /// Which of the twelve numbers the first five are.
    pub(super) numbers: [usize; 5],
}

/// The n-norm p of two numbers not below zero; its slopes; and the derivative of its logarithm by that of n.
struct Norm {
    value: f64,
    slopes: [f64; 2],
    by_exponent: f64,
}

impl Norm {
    fn new(x: f64, y: f64, n: f64) -> Self {
        let (large, small) = (x.max(y), x.min(y));
        let logarithm = (small / large).ln();
        let power = (n * logarithm).exp();
        // The ratio is zero, or so small that its power is: the edge of an octant.
        let (lean, weighted) = match power > 0.0 {
            true => (power * large / small, power * logarithm),
            false => (0.0, 0.0),
        };
        let sum = 1.0 + power;
        let growth = sum.ln() / n;
        let s = growth.exp();
        let steep = s / sum;
        Self {
            value: s * large,
            slopes: match x >= y {
                true => [steep, lean * steep],
                false => [lean * steep, steep],
            },
            by_exponent: weighted / sum - growth,
        }
    }
}

impl Body {
    /// An upright start: semi-axes along given axes, and the usual exponents.
    pub(super) fn start(centre: Vector3<f64>, axes: Matrix3<f64>, semi_axes: Vector3<f64>) -> Self {
        Self {
            logs: from_fn(|i| match i < EXPONENTS_FROM {
                true => semi_axes[i / 2].ln().clamp(SEMI_AXES[0], SEMI_AXES[1]),
                false => USUAL_EXPONENT,
            }),
            axes,
            centre,
        }
    }

    fn bounds(number: usize) -> [f64; 2] {
        if number < EXPONENTS_FROM {
            SEMI_AXES
        } else {
            EXPONENTS
        }
    }

    /// Whether a number is at a bound beyond which `towards` points.
    pub(super) fn is_held(&self, number: usize, towards: f64) -> bool {
        let [least, most] = Self::bounds(number);
        let value = self.logs[number];
        (value <= least && towards < 0.0) || (value >= most && towards > 0.0)
    }

    /// Whether a number is at a bound.
    pub(super) fn is_at_bound(&self, number: usize) -> bool {
        Self::bounds(number).contains(&self.logs[number])
    }

    /// The body with its free numbers and its pose changed, within bounds.
    pub(super) fn moved(&self, form: Form, step: &[f64]) -> Self {
        let ties = form.ties();
        let pose: SVector<f64, POSE> = SVector::from_row_slice(&step[form.numbers()..]);
        let turn = Rotation3::from_scaled_axis(pose.fixed_rows::<3>(0).into_owned());
        Self {
            logs: from_fn(|i| {
                let [least, most] = Self::bounds(i);
                (self.logs[i] + step[ties[i]]).clamp(least, most)
            }),
            axes: Rotation3::from_matrix_unchecked(self.axes * turn.into_inner()).into_inner(),
            centre: self.centre + self.axes * pose.fixed_rows::<3>(3),
        }
    }

    /// |y| (1 - 1 / g(y)) of the point y in the body's frame, the way along the ray from the centre to the point.
    pub(super) fn distance(&self, numbers: &[f64; NUMBERS], point: &Vector3<f64>) -> Distance {
        let y = self.axes.tr_mul(&(point - self.centre));
        let side = y.map(|x| usize::from(x < 0.0));
        let touched = [
            side.x,
            2 + side.y,
            4 + side.z,
            6 + side.z,
            8 + 2 * side.x + side.y,
        ];
        let [a, b, c, n1, n2] = touched.map(|number| numbers[number]);
        let inner = Norm::new(y.x.abs() / a, y.y.abs() / b, n2);
        let outer = Norm::new(inner.value, y.z.abs() / c, n1);
        let (g, length) = (outer.value, y.norm());
        if g.is_nan() || g <= 1e-12 {
            // At the very centre there is no ray.
            return Distance {
                value: -numbers[0].min(numbers[2]).min(numbers[4]),
                slopes: [0.0; TOUCHED],
                numbers: touched,
            };
        }
        let slope = Vector3::new(
            outer.slopes[0] * inner.slopes[0] / a * 1_f64.copysign(y.x),
            outer.slopes[0] * inner.slopes[1] / b * 1_f64.copysign(y.y),
            outer.slopes[1] / c * 1_f64.copysign(y.z),
        );
        let outward = slope * (length / (g * g)) + y * ((1.0 - 1.0 / g) / length);
        let per = length / (g * g);
        let turned = outward.cross(&y);
        let by_n2 = outer.slopes[0] * inner.value * inner.by_exponent;
        Distance {
            value: length * (1.0 - 1.0 / g),
            slopes: [
                -per * y.x * slope.x,
                -per * y.y * slope.y,
                -per * y.z * slope.z,
                per * g * outer.by_exponent,
                per * by_n2,
                turned.x,
                turned.y,
                turned.z,
                -outward.x,
                -outward.y,
                -outward.z,
            ],
            numbers: touched,
        }
    }

    /// The twelve numbers.
    pub(super) fn numbers(&self) -> [f64; NUMBERS] {
        self.logs.map(f64::exp)
    }

    /// The body in the scan's unit, and its frame in the scan.
    pub(super) fn told(
        &self,
        size: f64,
        origin: &Point3<f64>,
    ) -> Result<(Superquadric, Frame), InvalidSuperquadric> {
        let [ap, an, bp, bn, cp, cn, n1p, n1n, pp, pn, np, nn] = self.numbers();
        let axes = [[ap, an], [bp, bn], [cp, cn]].map(|sides| sides.map(|axis| axis * size));
        let shape = Superquadric::poly12(axes, [n1p, n1n], [[pp, pn], [np, nn]])?;
        let mut frame = Rotation3::from_matrix_unchecked(self.axes);
        frame.renormalize();
        let frame = Frame {
            centre: origin + self.centre * size,
            axes: frame.into_inner(),
        };
        Ok((shape, frame))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn distances_have_the_slopes_of_differences() {
        let body = Body {
            logs: [0.1, -0.2, 0.3, 0.0, -0.4, 0.2, 1.2, 0.6, 0.9, 1.4, 0.5, 1.1],
            axes: Rotation3::from_euler_angles(0.3, 0.5, -0.7).into_inner(),
            centre: Vector3::new(0.1, -0.1, 0.05),
        };
        let form = Form::Poly12;
        let at = |body: &Body, point: &Vector3<f64>| body.distance(&body.numbers(), point).value;
        for i in 0..40 {
            let t = 2.4 * f64::from(i) + 0.1;
            let z = (f64::from(i) + 0.5) / 20.0 - 1.0;
            let point = Vector3::new(t.cos(), t.sin(), 2.0 * z);
            let distance = body.distance(&body.numbers(), &point);
            let pose = std::array::from_fn(|j| NUMBERS + j);
            let places = [&distance.numbers[..], &<[usize; POSE]>::map(pose, |p| p)].concat();
            for (slope, place) in distance.slopes.iter().zip(places) {
                let moved = |step: f64| {
                    let mut steps = [0.0; NUMBERS + POSE];
                    steps[place] = step;
                    at(&body.moved(form, &steps), &point)
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                assert_relative_eq!(difference, *slope, epsilon = 1e-8, max_relative = 1e-6);
            }
        }
    }

    #[test]
    fn bounds_hold() {
        assert_relative_eq!(EXPONENTS[0].exp(), 1.3, max_relative = 1e-15);
        assert_relative_eq!(EXPONENTS[1].exp(), 20.0, max_relative = 1e-15);
        assert_relative_eq!(USUAL_EXPONENT.exp(), 2.2, max_relative = 1e-15);
        let body = Body::start(Vector3::zeros(), Matrix3::identity(), Vector3::repeat(1.0));
        let far = body.moved(Form::Single, &[9.0; 11]);
        assert!((0..NUMBERS).all(|number| far.is_at_bound(number)));
        assert!(far.is_held(0, 1.0) && !far.is_held(0, -1.0));
    }
}
