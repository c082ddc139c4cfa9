//! Nodes of a quadrature over a star-shaped surface.

use super::SurfaceElement;
use nalgebra::Vector3;

/// A node of a quadrature over directions, and the radius there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    /// A unit vector.
    pub(crate) direction: Vector3<f64>,
    /// Its weight.
    pub(crate) solid_angle: f64,
    /// Radius.
    pub(crate) radius: f64,
    /// Surface gradient.
    pub(crate) gradient: Vector3<f64>,
}

impl Ray {
    /// The part of the surface that it stands for: with X = r n, X_s x X_t = r (r n - g).
    pub(super) fn element(&self) -> SurfaceElement {
        let place = self.direction * self.radius;
        SurfaceElement {
            place,
            area: (place - self.gradient) * (self.radius * self.solid_angle),
            solid_angle: self.solid_angle,
        }
    }
}
