//! Elastic materials.

use thiserror::Error;

/// An isotropic, linearly elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    youngs_modulus_pa: f64,
    poissons_ratio: f64,
}

/// Why there is no such material.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// Young's modulus must be positive; infinite for a rigid body.
    #[error("Young's modulus must be above zero, not {pascals} Pa")]
    Modulus {
        /// The modulus given.
        pascals: f64,
    },
    /// Stability of the material asks for -1 to 0.5.
    #[error("Poisson's ratio must lie between -1 and 0.5, not at {ratio}")]
    PoissonsRatio {
        /// The ratio given.
        ratio: f64,
    },
}

impl Material {
    /// A body that does not give.
    pub const RIGID: Self = Self {
        youngs_modulus_pa: f64::INFINITY,
        poissons_ratio: 0.0,
    };

    /// A material of Young's modulus E > 0 in pascals (infinite: rigid) and Poisson's ratio -1 to 0.5.
    ///
    /// # Errors
    ///
    /// See [`MaterialError`].
    pub fn new(youngs_modulus_pa: f64, poissons_ratio: f64) -> Result<Self, MaterialError> {
        if youngs_modulus_pa.is_nan() || youngs_modulus_pa <= 0.0 {
            return Err(MaterialError::Modulus {
                pascals: youngs_modulus_pa,
            });
        }
        if !(-1.0..=0.5).contains(&poissons_ratio) {
            return Err(MaterialError::PoissonsRatio {
                ratio: poissons_ratio,
            });
        }
        Ok(Self {
            youngs_modulus_pa,
            poissons_ratio,
        })
    }

    /// How much it gives: (1 - nu²) / E, in 1/Pa.
    fn compliance_per_pa(&self) -> f64 {
        (1.0 - self.poissons_ratio * self.poissons_ratio) / self.youngs_modulus_pa
    }

    /// How much it gives sideways: (2 - nu) / G with the shear modulus G = E / (2 (1 + nu)), in 1/Pa.
    pub(super) fn shear_compliance_per_pa(&self) -> f64 {
        let nu = self.poissons_ratio;
        2.0 * (2.0 - nu) * (1.0 + nu) / self.youngs_modulus_pa
    }
}

/// The effective modulus E* of two bodies in contact, in pascals:
/// 1/E* = (1 - nu²)/E + (1 - nu'²)/E'. Infinite when neither gives.
pub fn effective_modulus_pa(one: &Material, other: &Material) -> f64 {
    1.0 / (one.compliance_per_pa() + other.compliance_per_pa())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_rigid_partner_leaves_the_plane_strain_modulus() {
        let steel = Material::new(210e9, 0.3).unwrap();
        let alone = effective_modulus_pa(&steel, &Material::RIGID);
        assert_relative_eq!(alone, 210e9 / 0.91, max_relative = 1e-15);
        let pair = effective_modulus_pa(&steel, &steel);
        assert_relative_eq!(pair, alone / 2.0, max_relative = 1e-15);
    }

    #[test]
    fn impossible_materials_are_refused() {
        for pascals in [0.0, -1.0, f64::NAN] {
            let refused = Material::new(pascals, 0.3);
            assert!(matches!(refused, Err(MaterialError::Modulus { .. })));
        }
        for ratio in [-1.1, 0.6, f64::NAN] {
            let refused = Material::new(1e9, ratio);
            assert!(matches!(refused, Err(MaterialError::PoissonsRatio { .. })));
        }
    }
}
