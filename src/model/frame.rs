//! The grain's own frame: where its centre is, how its axes lie in the scan.

use super::InvalidGrain;
use nalgebra::{Matrix3, Point3, Vector3};

/// Coordinates beyond this are no numbers of a grain, of which moments are taken: scans have no larger ones.
const FARTHEST: f64 = 1e100;

/// How far axes may be from orthonormal: the rounding of a file with fewer digits than f64 has.
const AXES_TOLERANCE: f64 = 1e-9;

/// A right-handed orthonormal frame in the scan's coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The origin from which radii are measured, in the scan's frame and unit.
    pub centre: Point3<f64>,
    /// Columns: the unit vectors of the grain's x, y and z axes in the scan's frame.
    pub axes: Matrix3<f64>,
}

impl Frame {
    /// The scan's own frame.
    pub const SCAN: Self = Self {
        centre: Point3::new(0.0, 0.0, 0.0),
        axes: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    };

    /// Coordinates of a point of the scan in this frame.
    pub fn to_local(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.axes.tr_mul(&(point - self.centre))
    }

    /// This frame, that is told in another one, in the space of that one.
    pub(crate) fn within(&self, outer: &Self) -> Self {
        Self {
            centre: outer.to_scan(&self.centre.coords),
            axes: outer.axes * self.axes,
        }
    }

    /// The point of the scan with the given coordinates in this frame.
    pub fn to_scan(&self, local: &Vector3<f64>) -> Point3<f64> {
        self.centre + self.axes * local
    }

    /// Refuses a frame that is not finite or too far away for numbers, or whose axes are not orthonormal and right-handed.
    pub(in crate::model) fn check(&self) -> Result<(), InvalidGrain> {
        if !self.centre.iter().all(|x| x.abs() <= FARTHEST) {
            return Err(InvalidGrain::NotFinite {
                what: "the centre".into(),
            });
        }
        let deviation = self.axes.tr_mul(&self.axes) - Matrix3::identity();
        // Written so that NaN fails.
        match deviation.amax() < AXES_TOLERANCE && self.axes.determinant() > 0.0 {
            true => Ok(()),
            false => Err(InvalidGrain::Axes),
        }
    }
}
