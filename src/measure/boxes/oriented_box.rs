//! Boxes of any orientation.

use crate::measure::integrals::mass::right_handed;
use nalgebra::{Matrix3, Point3, Vector3};

/// A box of any orientation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientedBox {
    /// Centre.
    pub centre: Point3<f64>,
    /// Unit axes in the columns, in the order of the extents: a rotation. The largest component of the
    /// first and of the second axis is positive.
    pub axes: Matrix3<f64>,
    /// Length, width and thickness: the sides of the box, descending.
    pub extents: Vector3<f64>,
}

impl OrientedBox {
    /// Product of the extents.
    pub fn volume(&self) -> f64 {
        self.extents.product()
    }
}

/// The box between least and greatest coordinates along orthonormal axes.
pub(super) fn oriented([low, high]: [Vector3<f64>; 2], axes: &Matrix3<f64>) -> OrientedBox {
    let extents = high - low;
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| extents[j].total_cmp(&extents[i]));
    OrientedBox {
        centre: Point3::from(axes * ((low + high) / 2.0)),
        axes: right_handed(axes, [order[0], order[1]]),
        extents: Vector3::from_fn(|i, _| extents[order[i]]),
    }
}
