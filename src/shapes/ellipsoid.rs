//! An ellipsoid.

use crate::model::StarSurface;
use nalgebra::Vector3;

/// The ellipsoid r(n) = (n_x²/a² + n_y²/b² + n_z²/c²)^(-1/2), centred at the origin.
///
/// Its gradient is the tangential part of -r³ (n_x/a², n_y/b², n_z/c²).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Semi-axes a, b, c along x, y, z, positive.
    pub semi_axes: Vector3<f64>,
}

impl StarSurface for Ellipsoid {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / n.component_div(&self.semi_axes).norm()
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let scaled = n.component_div(&self.semi_axes);
        let r = 1.0 / scaled.norm();
        let slope = scaled.component_div(&self.semi_axes) * -r.powi(3);
        (r, slope - n * n.dot(&slope))
    }
}
