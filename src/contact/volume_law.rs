//! A normal force that keeps energy whatever the shapes: the gradient of an energy of the volume that two bodies share.

use super::ContactRegion;
use crate::measure::equivalent_radius;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Exponent of the volume in the energy: with it, spheres feel the force of Hertz.
const EXPONENT: f64 = 1.25;

/// Depth of a lens over the effective radius up to which its volume is about pi R u².
const SHALLOW: f64 = 0.1;

/// The energy U = 8/15 E* R*^(-3/4) (V / pi)^(5/4) of a shared volume V.
///
/// Two spheres that overlap by a small u share V = pi R* u², with 1/R* = 1/R1 + 1/R2, so U is 8/15 E* sqrt(R*) u^(5/2),
/// the work of Hertz's force. Of other bodies R* is that of the spheres of their volumes, whatever touches: the force is
/// that of Hertz only for these, but its work on any closed path is nil. After the form F = k m V^(m-1) dV/dx of Feng
/// (2021), "An energy-conserving contact theory for discrete element modelling of arbitrarily shaped particles".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VolumeLaw {
    /// k of U = k V^(5/4): newtons per square metre, over a length to the power 3/4 in the bodies' unit.
    stiffness_pa: f64,
    metres_per_unit: f64,
    /// R*, in the bodies' unit.
    radius: f64,
}

impl VolumeLaw {
    /// Of two bodies by their volumes, whose unit of length is so many metres.
    pub fn new(volumes: [f64; 2], metres_per_unit: f64, effective_modulus_pa: f64) -> Self {
        let [one, two] = volumes.map(equivalent_radius);
        let radius = one * two / (one + two);
        Self {
            stiffness_pa: 8.0 / 15.0 * effective_modulus_pa * radius.powf(-0.75)
                / PI.powf(EXPONENT),
            metres_per_unit,
            radius,
        }
    }

    /// R*, in the bodies' unit: of spheres of their volumes, as far as the law is Hertz's, the depth is small beside it.
    pub fn effective_radius(&self) -> f64 {
        self.radius
    }

    /// How many times the force of Hertz the force at a region is, about: with V = pi R u² of a lens, and R the effective radius where the
    /// surfaces touch, it is (R / R*)^(3/4). `None` where the region has no deepest points, whose line is normal to both surfaces, and
    /// where it is deeper than a tenth of R or R*, and no such lens.
    pub fn times_hertz(&self, region: &ContactRegion) -> Option<f64> {
        region.curvatures.as_ref()?;
        let radius = region.volume / (PI * region.depth * region.depth);
        let is_lens = region.depth <= SHALLOW * radius.min(self.radius);
        is_lens.then(|| (radius / self.radius).powf(0.75))
    }

    /// The energy stored in a region, in joules.
    pub fn energy_j(&self, region: &ContactRegion) -> f64 {
        self.stiffness_pa * region.volume.powf(EXPONENT) * self.metres_per_unit.powi(3)
    }

    /// Standard error of the force at a region, as a share of it, where both surfaces tell theirs: with V = pi R u² of a lens
    /// the force goes with R^(5/4) u^(3/2), R the effective radius where they touch.
    pub fn force_share(region: &ContactRegion) -> Option<f64> {
        let of_radius = region.radius_share(EXPONENT)?;
        Some(of_radius.hypot(1.5 * region.depth_error()? / region.depth))
    }

    /// The force on the second body at a region, in newtons; on the first it is the opposite.
    pub fn force_n(&self, region: &ContactRegion) -> Vector3<f64> {
        let slope = EXPONENT * self.stiffness_pa * region.volume.powf(EXPONENT - 1.0);
        region.area * (slope * self.metres_per_unit.powi(2))
    }
}
