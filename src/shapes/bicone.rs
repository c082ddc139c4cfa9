//! A bicone.

use super::gauge::{derivatives, distance_from_axis, from_axis, radius_and_gradient};
use super::solid::{Solid, closed_form};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::{Jet, Symmetry};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Two equal cones, base on base: sqrt(x² + y²)/R + |z|/h <= 1, centred at the origin, the axis
/// along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bicone {
    /// Radius R of the common base, positive.
    pub radius: f64,
    /// Height h of each cone, positive.
    pub half_height: f64,
}

impl Bicone {
    /// Mean radius R h (pi/2 h + R ln(R/h)) / (R² + h²), the integral of
    /// sin(theta) / (sin(theta)/R + cos(theta)/h) from 0 to pi/2.
    pub(super) fn mean_radius(&self) -> f64 {
        let (r, h) = (self.radius, self.half_height);
        r * h * (FRAC_PI_2 * h + r * (r / h).ln()) / (r * r + h * h)
    }
}

impl StarSurface for Bicone {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / (n.x.hypot(n.y) / self.radius + n.z.abs() / self.half_height)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (_, outwards) = from_axis(n);
        let along = Vector3::z() * (n.z.signum() / self.half_height);
        radius_and_gradient(n, &(outwards / self.radius + along))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let along = Vector3::z() * (n.z.signum() / self.half_height);
        let across = distance_from_axis(n).scaled(1.0 / self.radius);
        derivatives(n, &across.plus(&Jet::linear(n, along)))
    }
}

impl Solid for Bicone {
    /// S = 2 pi R sqrt(R² + h²), V = 2/3 pi R² h, means of x² and y² 3 R²/20 and of z² h²/10.
    fn integrals(&self) -> Integrals {
        let (r, h) = (self.radius, self.half_height);
        let (across, along) = (3.0 * r * r / 20.0, h * h / 10.0);
        closed_form(
            self.mean_radius(),
            TAU * r * r.hypot(h),
            TAU / 3.0 * r * r * h,
            Vector3::new(across, across, along),
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }

    /// The apex and the rim, at 0 and pi/2.
    fn singular_polar_angles(&self, _azimuth: f64) -> Vec<f64> {
        vec![0.0, FRAC_PI_2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_4, PI};

    #[test]
    fn the_textbook_values_are_met() {
        // Two cones of radius 4, height 3 and slant 5; each has m = 16 pi, I_z = 3/10 m R² and, about
        // a diameter of its base, I_x = m (3 R² + 2 h²)/20.
        let found = Bicone {
            radius: 4.0,
            half_height: 3.0,
        };
        let solid = found.integrals().properties;
        assert_relative_eq!(solid.area, 2.0 * PI * 4.0 * 5.0, max_relative = 1e-15);
        assert_relative_eq!(solid.volume, 32.0 * PI, max_relative = 1e-15);
        let along = 32.0 * PI * 0.3 * 16.0;
        assert_relative_eq!(solid.inertia[(2, 2)], along, max_relative = 1e-15);
        let across = 32.0 * PI * (3.0 * 16.0 + 2.0 * 9.0) / 20.0;
        assert_relative_eq!(solid.inertia[(0, 0)], across, max_relative = 1e-15);
    }

    #[test]
    fn as_high_as_wide_the_mean_radius_is_a_quarter_of_pi() {
        let found = Bicone {
            radius: 1.0,
            half_height: 1.0,
        };
        assert_relative_eq!(found.mean_radius(), FRAC_PI_4, max_relative = 1e-15);
    }
}
