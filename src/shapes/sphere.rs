//! A sphere.

use super::solid::{Solid, closed_form};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::Symmetry;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

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

    fn derivatives(&self, _n: &Vector3<f64>) -> Derivatives {
        Derivatives {
            radius: self.radius,
            gradient: Vector3::zeros(),
            hessian: Matrix3::zeros(),
        }
    }
}

impl Solid for Sphere {
    /// S = 4 pi r², V = 4/3 pi r³, means of the squares r²/5.
    fn integrals(&self) -> Integrals {
        let square = self.radius * self.radius;
        closed_form(
            self.radius,
            4.0 * PI * square,
            4.0 / 3.0 * PI * square * self.radius,
            Vector3::repeat(square / 5.0),
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }
}
