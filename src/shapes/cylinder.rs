//! A circular cylinder.

use super::gauge::{derivatives, distance_from_axis, from_axis, radius_and_gradient};
use super::solid::{Solid, closed_form};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::{Jet, Symmetry};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The cylinder max(sqrt(x² + y²)/R, |z|/h) <= 1, centred at the origin, its axis along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Radius R, positive.
    pub radius: f64,
    /// Half the height, h, positive.
    pub half_height: f64,
}

impl Cylinder {
    /// Whether `n`, at this distance from the axis, meets the side and not an end.
    fn is_side(&self, n: &Vector3<f64>, distance: f64) -> bool {
        distance / self.radius > n.z.abs() / self.half_height
    }

    /// The slope of the gauge |z| / h of the end that `n` meets.
    fn end_slope(&self, n: &Vector3<f64>) -> Vector3<f64> {
        Vector3::z() * (n.z.signum() / self.half_height)
    }

    /// Mean radius h/2 ln(1 + R²/h²) + R atan(h/R): that of the two ends and that of the side.
    pub(super) fn mean_radius(&self) -> f64 {
        let (r, h) = (self.radius, self.half_height);
        h / 2.0 * (r / h).powi(2).ln_1p() + r * (h / r).atan()
    }
}

impl StarSurface for Cylinder {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let side = n.x.hypot(n.y) / self.radius;
        1.0 / side.max(n.z.abs() / self.half_height)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (distance, outwards) = from_axis(n);
        let slope = match self.is_side(n, distance) {
            true => outwards / self.radius,
            false => self.end_slope(n),
        };
        radius_and_gradient(n, &slope)
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let distance = distance_from_axis(n);
        let gauge = match self.is_side(n, distance.value) {
            true => distance.scaled(1.0 / self.radius),
            false => Jet::linear(n, self.end_slope(n)),
        };
        derivatives(n, &gauge)
    }
}

impl Solid for Cylinder {
    /// S = 2 pi R (R + 2 h), V = 2 pi R² h, means of x² and y² R²/4 and of z² h²/3.
    fn integrals(&self) -> Integrals {
        let (r, h) = (self.radius, self.half_height);
        let (across, along) = (r * r / 4.0, h * h / 3.0);
        closed_form(
            self.mean_radius(),
            TAU * r * (r + 2.0 * h),
            TAU * r * r * h,
            Vector3::new(across, across, along),
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }

    /// The rim, at atan(R/h).
    fn singular_polar_angles(&self, _azimuth: f64) -> Vec<f64> {
        vec![self.radius.atan2(self.half_height)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_4, LN_2, PI};

    #[test]
    fn the_textbook_values_are_met() {
        // Of height 2 and radius 2: S = 16 pi, V = 8 pi, I_z = m R²/2, I_x = m (3 R² + H²)/12.
        let found = Cylinder {
            radius: 2.0,
            half_height: 1.0,
        }
        .integrals();
        let solid = found.properties;
        assert_relative_eq!(solid.area, 16.0 * PI, max_relative = 1e-15);
        assert_relative_eq!(solid.volume, 8.0 * PI, max_relative = 1e-15);
        assert_relative_eq!(solid.inertia[(2, 2)], 16.0 * PI, max_relative = 1e-15);
        let across = 8.0 * PI * (3.0 * 4.0 + 4.0) / 12.0;
        assert_relative_eq!(solid.inertia[(0, 0)], across, max_relative = 1e-15);
    }

    #[test]
    fn as_high_as_wide_the_mean_radius_is_simple() {
        let found = Cylinder {
            radius: 1.0,
            half_height: 1.0,
        };
        let mean = LN_2 / 2.0 + FRAC_PI_4;
        assert_relative_eq!(found.mean_radius(), mean, max_relative = 1e-15);
    }
}
