//! One superquadric of a fit.

use super::number::{short, triple, with_error};
use crate::fit::ParameterErrors;
use crate::model::{Frame, Superquadric};
use serde::Serialize;
use std::fmt;

/// A superquadric in the scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SuperquadricRecord {
    /// Its centre.
    pub centre: [f64; 3],
    /// Its x, y and z axes.
    pub axes: [[f64; 3]; 3],
    /// Semi-axes a, b and c, each on the positive and on the negative side.
    pub semi_axes: [[f64; 2]; 3],
    /// Their standard errors; `null` where a number is at a bound, or the points do not determine it.
    pub semi_axes_errors: [[Option<f64>; 2]; 3],
    /// Whether they are at a bound of the fit, and the points would have them beyond it.
    pub semi_axes_at_bound: [[bool; 2]; 3],
    /// n1 on either side of z.
    pub n1: [f64; 2],
    /// Their standard errors, likewise.
    pub n1_errors: [Option<f64>; 2],
    /// Whether they are at a bound, from 1.3 to 20, likewise.
    pub n1_at_bound: [bool; 2],
    /// n2 by the side of x, then of y.
    pub n2: [[f64; 2]; 2],
    /// Their standard errors, likewise.
    pub n2_errors: [[Option<f64>; 2]; 2],
    /// Whether they are at a bound, likewise.
    pub n2_at_bound: [[bool; 2]; 2],
    /// Standard errors of rotations about its axes, in radians, likewise.
    pub rotation_errors_rad: [Option<f64>; 3],
    /// Standard errors of the centre's coordinates along the scan's axes, likewise.
    pub centre_errors: [Option<f64>; 3],
}

impl SuperquadricRecord {
    pub(super) fn new(shape: &Superquadric, frame: &Frame, errors: &ParameterErrors) -> Self {
        Self {
            centre: frame.centre.into(),
            axes: [0, 1, 2].map(|i| frame.axes.column(i).into_owned().into()),
            semi_axes: shape.semi_axes(),
            semi_axes_errors: errors.semi_axes,
            semi_axes_at_bound: errors.at_bound.semi_axes,
            n1: shape.n1(),
            n1_errors: errors.n1,
            n1_at_bound: errors.at_bound.n1,
            n2: shape.n2(),
            n2_errors: errors.n2,
            n2_at_bound: errors.at_bound.n2,
            rotation_errors_rad: errors.rotation_rad,
            centre_errors: errors.centre,
        }
    }

    /// Whether an exponent is as small or as large as they can be.
    pub(super) fn has_exponent_at_bound(&self) -> bool {
        let mut all = self
            .n1_at_bound
            .iter()
            .chain(self.n2_at_bound.as_flattened());
        all.any(|is_at_bound| *is_at_bound)
    }

    /// The line of an axis or an exponent: one figure, or one for each side where they differ.
    fn sides(values: &[f64], errors: &[Option<f64>], at_bound: &[bool]) -> String {
        let each = values.iter().zip(errors).zip(at_bound);
        let mut each: Vec<String> = each
            .map(|((value, error), is_at_bound)| match (error, is_at_bound) {
                (_, true) => format!("{} (its bound)", short(*value)),
                (None, false) => format!("{} (error not known)", short(*value)),
                (error, false) => with_error(*value, *error),
            })
            .collect();
        each.dedup();
        each.join(" | ")
    }

    pub(super) fn write(&self, f: &mut fmt::Formatter<'_>, length: &str) -> fmt::Result {
        writeln!(f, "centre        {}{length}", triple(self.centre))?;
        for (axis, name) in ["a", "b", "c"].into_iter().enumerate() {
            let sides = Self::sides(
                &self.semi_axes[axis],
                &self.semi_axes_errors[axis],
                &self.semi_axes_at_bound[axis],
            );
            writeln!(f, "semi-axis {name}   {sides}{length}")?;
        }
        let n1 = Self::sides(&self.n1, &self.n1_errors, &self.n1_at_bound);
        writeln!(f, "exponent n1   {n1}")?;
        let n2 = Self::sides(
            self.n2.as_flattened(),
            self.n2_errors.as_flattened(),
            self.n2_at_bound.as_flattened(),
        );
        writeln!(f, "exponent n2   {n2}")
    }
}
