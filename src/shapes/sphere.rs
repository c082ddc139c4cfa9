//! A sphere.

use crate::model::StarSurface;
use nalgebra::Vector3;

/// The sphere r(n) = radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Radius, positive.
    pub radius: f64,
}

impl StarSurface for Sphere {
    fn radius(&self, _n: &Vector3<f64>) -> f64 {
        self.radius
    }

    fn radius_and_gradient(&self, _n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        (self.radius, Vector3::zeros())
    }
}
