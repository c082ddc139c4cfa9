//! What to know of the figures of a bed.

use super::BedRunRecord;
use crate::bed::BedSettings;
use crate::digits::given;
use crate::report::number::short;

/// The largest overlap, as a share of the mean radius, of which nothing is said. Hertz's theory is for patches that are
/// small beside the grains; at this overlap the patch of two spheres has an eighth of their radius.
const USUAL_OVERLAP: f64 = 0.03;

/// The largest overlap beside which packing fractions are told. They are too large by a half of it to all of it: here
/// by as much as shapes differ.
pub(super) const MOST_OVERLAP: f64 = 0.1;

/// The largest energy of motion and height, as a share of that at the start, of which nothing is said: steps are not exact.
const MOST_ENERGY: f64 = 1.01;

impl BedRunRecord {
    /// Whether grains overlap so much that a packing fraction means nothing.
    pub(super) fn is_crushed(&self) -> bool {
        self.fabric.largest_overlap > MOST_OVERLAP
    }

    /// In sentences.
    pub(super) fn warnings(&self, settings: &BedSettings, has_mesh: bool) -> Vec<String> {
        let seed = self.seed;
        let mut warnings = Vec::new();
        if !self.is_at_rest {
            let what_helps = match settings.rolling_friction == 0.0 {
                true => {
                    "--rolling-friction 0.01 ends the rocking of grains, and more --seconds let them go on"
                }
                false => "more --seconds let it go on",
            };
            warnings.push(format!(
                "The bed of seed {seed} is not at rest after {} s; its figures are those of a bed that moves: \
                 {what_helps}.",
                short(self.seconds)
            ));
        }
        if self.energy_left > MOST_ENERGY {
            warnings.push(format!(
                "The grains of the bed of seed {seed} have {:.0} % more energy than they began with, so its figures are not those of a \
                 bed that fell: forces between grains whose parts overlap do not keep energy. --damping 0.01,0.01 takes it away.",
                100.0 * (self.energy_left - 1.0)
            ));
        }
        let overlap = self.fabric.largest_overlap;
        if overlap > USUAL_OVERLAP {
            let then = match self.is_crushed() {
                true => {
                    "that is too much for a packing fraction to mean anything, and none is told"
                }
                false => {
                    "Hertz's theory is for smaller ones, and packing fractions are too large by up to that share"
                }
            };
            warnings.push(format!(
                "Grains of the bed of seed {seed} overlap by up to {:.1} % of their mean radius: {then}. A larger \
                 --youngs-modulus-mpa than {} makes them harder.",
                100.0 * overlap,
                given(settings.youngs_modulus_pa / 1e6)
            ));
        }
        if self.packing.core.is_none() && !self.is_crushed() && !has_mesh {
            warnings.push(format!(
                "The bed of seed {seed} has no core: two diameters off the walls, 1.5 off the floor and one below its \
                 surface, less than half a diameter of height or one of width is left."
            ));
        }
        warnings
    }
}
