//! Superquadrics on their way through a fit.

use super::form::{EXPONENTS_FROM, Form, NUMBERS, POSE};
use crate::model::{Frame, InvalidSuperquadric, Superquadric};
use nalgebra::{Matrix3, Point3, Rotation3, SVector, Vector3};
use std::array::from_fn;

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

    /// The same body of equal octants, of which a is no smaller than b.
    pub(super) fn in_order(mut self) -> Self {
        if self.logs[0] < self.logs[2] {
            let [x, y, z] = [0, 1, 2].map(|axis| self.axes.column(axis).into_owned());
            self.axes = Matrix3::from_columns(&[y, -x, z]);
            self.logs.swap(0, 2);
            self.logs.swap(1, 3);
        }
        self
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
    fn a_is_no_smaller_than_b_and_the_body_is_the_same() {
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3).into_inner();
        let body = Body::start(Vector3::zeros(), turn, Vector3::new(1.0, 2.0, 0.7));
        let ordered = body.in_order();
        let [a, _, b, ..] = ordered.numbers();
        assert_relative_eq!(a, 2.0, max_relative = 1e-15);
        assert_relative_eq!(b, 1.0, max_relative = 1e-15);
        assert_relative_eq!(ordered.axes.column(0), body.axes.column(1));
        assert_relative_eq!(ordered.axes.determinant(), 1.0, max_relative = 1e-15);
        assert_eq!(ordered.in_order().logs, ordered.logs);
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
