//! Normal forces by Hertz where two bodies are placed so that they overlap.

use super::contact::{CURVED, beyond_hertz};
use crate::contact::RelativeCurvature;
use crate::measure::Curvature;

/// What Hertz's forces are made of, beside depths and curvatures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzLaw {
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// The bodies' unit of length, in metres.
    pub metres_per_unit: f64,
}

impl HertzLaw {
    /// The force in newtons of bodies that overlap by a depth, with their curvatures at its two ends, in the bodies' unit;
    /// `None` where the theory has none. Adds what to know of it.
    pub(super) fn force_n(
        &self,
        depth: f64,
        [one, two]: &[Curvature; 2],
        warnings: &mut Vec<String>,
    ) -> Option<f64> {
        let angle = one.directions[0]
            .dot(&two.directions[0])
            .clamp(-1.0, 1.0)
            .acos();
        match RelativeCurvature::new(one.principal, two.principal, angle) {
            Ok(relative) => {
                let share = depth / relative.smaller_radius();
                warnings.extend(beyond_hertz("The depth", share, CURVED).map(|told| told + "."));
                let metres = self.metres_per_unit;
                Some(relative.normal_force_n(metres, depth * metres, self.effective_modulus_pa))
            }
            Err(error) => {
                warnings.push(format!("No force by Hertz: {error}."));
                None
            }
        }
    }
}
