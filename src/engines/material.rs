//! What grains and walls are made of, as engines take it.

use super::error::InvalidDeck;

/// What grains are made of: one material for grains and walls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrainMaterial {
    /// Young's modulus, in Pa. Engines take one softer than the grain's own, for the time step is as the inverse of
    /// its root.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Coefficient of sliding friction.
    pub friction: f64,
    /// Coefficient of rolling friction, of the radius of a sphere; for LAMMPS alone.
    pub rolling_friction: f64,
    /// Coefficient of restitution of a normal impact.
    pub restitution: f64,
    /// Density, in kg/m³.
    pub density: f64,
}

impl GrainMaterial {
    pub(super) fn check(&self) -> Result<(), InvalidDeck> {
        let above_zero = |x: f64| x > 0.0 && x.is_finite();
        let checks = [
            (
                "Young's modulus",
                "a finite number above zero",
                self.youngs_modulus,
                above_zero(self.youngs_modulus),
            ),
            (
                "Poisson's ratio",
                "from 0 to below 0.5",
                self.poissons_ratio,
                (0.0..0.5).contains(&self.poissons_ratio),
            ),
            (
                "the coefficient of friction",
                "a finite number, zero or above",
                self.friction,
                self.friction >= 0.0 && self.friction.is_finite(),
            ),
            (
                "the coefficient of rolling friction",
                "a finite number, zero or above",
                self.rolling_friction,
                self.rolling_friction >= 0.0 && self.rolling_friction.is_finite(),
            ),
            (
                "the coefficient of restitution",
                "above 0.05 and at most 1",
                self.restitution,
                self.restitution > 0.05 && self.restitution <= 1.0,
            ),
            (
                "the density",
                "a finite number above zero",
                self.density,
                above_zero(self.density),
            ),
        ];
        match checks.into_iter().find(|check| !check.3) {
            Some((what, range, found, _)) => Err(InvalidDeck::Material { what, range, found }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
impl GrainMaterial {
    /// That of tests, of this density.
    pub(super) fn trial(density: f64) -> Self {
        Self {
            youngs_modulus: 1e7,
            poissons_ratio: 0.3,
            friction: 0.4,
            rolling_friction: 0.0,
            restitution: 0.6,
            density,
        }
    }
}
