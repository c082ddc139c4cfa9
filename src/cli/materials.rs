//! The materials of bodies in contact.

use super::args::ContactArgs;
use crate::contact::{Material, effective_modulus_pa};
use anyhow::{Result, bail};

impl ContactArgs {
    /// The effective modulus, in Pa, of the grain, of this Young's modulus, and of what it touches.
    pub(super) fn effective_modulus_pa(&self, modulus_mpa: f64) -> Result<f64> {
        let own = Material::new(1e6 * modulus_mpa, self.poissons_ratio)?;
        let other_modulus_mpa = self.other_youngs_modulus_mpa.unwrap_or(modulus_mpa);
        let other = Material::new(
            1e6 * other_modulus_mpa,
            self.other_poissons_ratio.unwrap_or(self.poissons_ratio),
        )?;
        let effective = effective_modulus_pa(&own, &other);
        if !effective.is_finite() {
            let softer = match modulus_mpa.min(other_modulus_mpa).is_finite() {
                true => "lower Young's modulus, or a Poisson's ratio above -1",
                false => "finite Young's modulus",
            };
            bail!(
                "both bodies are rigid, so that no force presses them together: give one of them a {softer}"
            );
        }
        Ok(effective)
    }
}
