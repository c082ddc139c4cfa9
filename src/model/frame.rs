//! The grain's own frame: where its centre is, how its axes lie in the scan.

use nalgebra::{Matrix3, Point3, Vector3};

/// A right-handed orthonormal frame in the scan's coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The origin from which radii are measured, in the scan's frame and unit.
    pub centre: Point3<f64>,
    /// Columns: the unit vectors of the grain's x, y and z axes in the scan's frame.
    pub axes: Matrix3<f64>,
}

impl Frame {
    /// Coordinates of a point of the scan in this frame.
    pub fn to_local(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.axes.tr_mul(&(point - self.centre))
    }

    /// The point of the scan with the given coordinates in this frame.
    pub fn to_scan(&self, local: &Vector3<f64>) -> Point3<f64> {
        self.centre + self.axes * local
    }
}
