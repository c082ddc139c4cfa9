//! Where a scene is looked at from.

use nalgebra::{Matrix3, Point3, Vector3};

/// An orthographic view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Camera {
    /// The place in the middle of the picture.
    pub target: Point3<f64>,
    /// Rows: unit vectors that point right, up and towards the eye in the picture.
    pub axes: Matrix3<f64>,
    /// Pixels per unit of length.
    pub scale: f64,
}

impl Camera {
    /// A camera that looks at `target` against `towards_eye`, with `up` upwards as far as it can be, and shows a length
    /// of one as so many pixels. Directions of any length; an `up` along the view gives way to any other.
    pub(crate) fn new(
        target: Point3<f64>,
        towards_eye: Vector3<f64>,
        up: Vector3<f64>,
        scale: f64,
    ) -> Self {
        let eye = towards_eye.try_normalize(0.0).unwrap_or(Vector3::z());
        let any = Vector3::ith(eye.iamin(), 1.0);
        let right = up.cross(&eye).try_normalize(1e-9 * up.norm());
        let right = right.unwrap_or_else(|| any.cross(&eye).normalize());
        Self {
            target,
            axes: Matrix3::from_rows(&[right, eye.cross(&right), eye].map(|axis| axis.transpose())),
            scale,
        }
    }

    /// Pixels right and up of the middle of the picture, and towards the eye.
    pub(crate) fn seen(&self, place: &Point3<f64>) -> Vector3<f64> {
        self.axes * (place - self.target) * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn right_is_right_up_is_up_and_near_is_near() {
        let camera = Camera::new(
            Point3::new(1.0, 0.0, 0.0),
            -Vector3::y(),
            Vector3::z(),
            10.0,
        );
        let seen = camera.seen(&Point3::new(1.5, -2.0, 3.0));
        assert_relative_eq!(seen, Vector3::new(5.0, 30.0, 20.0), epsilon = 1e-12);
        let along = Camera::new(Point3::origin(), Vector3::z(), Vector3::z(), 1.0);
        assert_relative_eq!(along.axes.determinant(), 1.0, epsilon = 1e-12);
    }
}
