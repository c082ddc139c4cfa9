//! Normal forces by Hertz where two bodies are placed so that they overlap.

use super::contact::beside_hertz;
use crate::contact::RelativeCurvature;
use crate::measure::Curvature;

/// What Hertz's forces are made of, beside depths and curvatures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzLaw {
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// The bodies' unit of length, in metres.
    pub metres_per_unit: f64,
    /// How far the smaller body reaches from its centre, in their unit.
    pub body: f64,
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
        let known =
            RelativeCurvature::new(one.principal, two.principal, angle).and_then(|relative| {
                let beside = beside_hertz("the depth", &relative, depth, self.body)?;
                Ok((relative, beside))
            });
        match known {
            Ok((relative, beside)) => {
                warnings.extend(beside.iter().map(|told| sentence(told)));
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

/// With a capital letter and a full stop.
fn sentence(told: &str) -> String {
    let (first, rest) = told.split_at(1);
    format!("{}{rest}.", first.to_uppercase())
}
