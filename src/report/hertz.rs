//! Normal forces by Hertz where two bodies are placed so that they overlap.

use super::contact::{beside_hertz, beside_middle};
use crate::contact::{ContactError, KnownContact, told_depth};
use crate::measure::Curvature;
use crate::model::LocalError;

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

/// What a force is made of at one place, in the bodies' unit.
pub(super) struct Overlap<'a> {
    /// How far the bodies overlap.
    pub(super) depth: f64,
    /// Of both surfaces at its two ends.
    pub(super) curvatures: &'a [Curvature; 2],
    /// Their standard errors there, where they are known.
    pub(super) errors: Option<&'a [LocalError; 2]>,
    /// Standard error of the depth, where it is known.
    pub(super) depth_error: Option<f64>,
    /// How many times the force of the curvatures there is that of the whole contact.
    pub(super) times: &'a dyn Fn(&KnownContact) -> Result<f64, ContactError>,
}

/// A force in newtons, and its standard error where that is known.
pub(super) struct Force {
    pub(super) force_n: f64,
    pub(super) error_n: Option<f64>,
}

impl HertzLaw {
    /// The force of an overlap; `None` where the theory has none, or none is vouched for. Adds what to know of it.
    pub(super) fn force(&self, overlap: &Overlap<'_>, warnings: &mut Vec<String>) -> Option<Force> {
        let known = told_depth(overlap.depth, overlap.depth_error)
            .and_then(|()| KnownContact::at(overlap.curvatures, overlap.errors))
            .and_then(|known| {
                let mut beside =
                    beside_hertz("The depth", known.relative(), overlap.depth, self.body)?;
                beside.extend(beside_middle((overlap.times)(&known)?)?);
                Ok((known, beside))
            });
        match known {
            Ok((known, beside)) => {
                warnings.extend(beside);
                let metres = self.metres_per_unit;
                let force_n = known.relative().normal_force_n(
                    metres,
                    overlap.depth * metres,
                    self.effective_modulus_pa,
                );
                let share = known.force_share(overlap.depth, overlap.depth_error);
                Some(Force {
                    force_n,
                    error_n: share.map(|share| share * force_n),
                })
            }
            Err(error) => {
                warnings.push(format!("No force by Hertz: {error}."));
                None
            }
        }
    }
}
