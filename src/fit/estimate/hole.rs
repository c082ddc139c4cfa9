//! What a hole between the points may hide.
//!
//! Over a hole the surface is the most likely one under a prior that is the same everywhere. A tip is sharper than that, and
//! one that broke off is flat. So errors hold, as one more standard deviation, [a share](SHARE) of what the surface bulges over
//! the plane of the hole's rim: over a cap of half-angle a about the direction c the radius is uncertain by
//!
//! ```text
//! share r (1 - cos a / (n.c))
//! ```
//!
//! Measured on clouds of eight smooth bodies whose tips were cut off, a hole of some ten degrees: area, volume and moments were
//! up to 14 standard errors off.

use super::functionals::RingSurface;
use super::outcome::Estimate;
use crate::fit::gaps::{largest_cap, random_gap};
use crate::measure::Moments;
use crate::sphere::HarmonicBasis;
use crate::vectorize::dot;
use nalgebra::Vector3;

/// Of the bulge over the plane of its rim.
const SHARE: f64 = 0.5;

/// The largest cap of directions of the stretched space in which there is no point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hole {
    middle: Vector3<f64>,
    /// In radians.
    pub(super) half_angle: f64,
    /// Of the surface in the middle, in units of the mean.
    radius: f64,
}

impl Estimate {
    pub(super) fn hole(&self) -> Hole {
        *self.derived.hole.get_or_init(|| Hole::of(self))
    }
}

impl Hole {
    fn of(estimate: &Estimate) -> Self {
        let (half_angle, middle) = largest_cap(&estimate.cloud.directions);
        let mut harmonics = vec![0.0; estimate.coefficients.len()];
        HarmonicBasis::new(estimate.degree).evaluate(&middle, &mut harmonics);
        Self {
            middle,
            half_angle,
            radius: dot(&harmonics, &estimate.coefficients),
        }
    }

    /// Whether so many random points would not leave it.
    pub(super) fn is_no_chance(&self, points: usize) -> bool {
        self.half_angle > random_gap(points)
    }

    /// By how much the radius is uncertain in a direction, in units of the mean, and the gradient of that.
    pub(super) fn hidden(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (rim, along) = (self.half_angle.cos(), n.dot(&self.middle));
        if along <= rim || along <= 0.0 {
            return (0.0, Vector3::zeros());
        }
        let most = SHARE * self.radius;
        let across = self.middle - n * along;
        (
            most * (1.0 - rim / along),
            across * (most * rim / (along * along)),
        )
    }

    /// Area, volume and moments of the surface with it.
    pub(super) fn moments(&self, surface: &RingSurface) -> Moments {
        surface.moments_with(|n| self.hidden(n))
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn half_of_the_cap_over_the_rim_may_be_missing() {
        let mut directions = fibonacci(3000);
        directions.retain(|n| n.z < 20_f64.to_radians().cos());
        let estimate = estimated(&samples(&directions, |_| 3.0, 0.001), Vector3::repeat(3.0));
        let hole = estimate.hole();
        assert!(hole.is_no_chance(directions.len()));
        assert_relative_eq!(hole.half_angle.to_degrees(), 20.0, epsilon = 1.0);
        let (middle, slope) = hole.hidden(&hole.middle);
        assert_relative_eq!(
            middle,
            0.5 * (1.0 - hole.half_angle.cos()),
            max_relative = 1e-3
        );
        assert!(slope.norm() < 1e-12);
        assert_eq!(hole.hidden(&Vector3::x()).0, 0.0);
        let surface = RingSurface::new(&estimate);
        let added = hole.moments(&surface).volume - surface.moments().volume;
        let height = 1.0 - hole.half_angle.cos();
        let cap = 27.0 * PI * height * height * (3.0 - height) / 3.0;
        assert_relative_eq!(added, 0.5 * cap, max_relative = 0.1);
        // What a ball of even points leaves is chance.
        let estimate = estimated(
            &samples(&fibonacci(3000), |_| 3.0, 0.001),
            Vector3::repeat(3.0),
        );
        assert!(!estimate.hole().is_no_chance(3000));
    }
}
