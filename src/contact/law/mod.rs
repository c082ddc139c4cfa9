//! The force of a contact that moves: elastic and viscous along the normal, friction across it, resistance to rolling.
//!
//! All is in SI units: metres, kilograms, seconds, newtons. The law is that of Wang, Marmysh and Ji (2020), who take it
//! from Zhou, Yu and others; where their print is lost or has a slip, it is derived from Hertz and Mindlin, as said at
//! each term.
//!
//! | symbol | unit | is |
//! |---|---|---|
//! | E* | Pa | effective modulus of both materials, 1/E* = sum (1 - nu²)/E |
//! | G* | Pa | effective shear modulus, 1/G* = sum (2 - nu)/G, G = E/(2 (1 + nu)) |
//! | R* | m | effective radius, 1/R* = sum 1/R of the spheres of equal volume; of a grain on a wall its R |
//! | m* | kg | effective mass, 1/m* = sum 1/m; of a grain on a wall its m |
//! | delta_n | m | overlap |
//! | delta_t | m | tangential displacement since the bodies touch, bounded by delta_max |
//! | v_n, v_t | m/s | relative velocity at the contact, along and across the normal |
//! | mu | 1 | coefficient of friction |
//! | mu_r | 1 | coefficient of rolling friction, a share of R* |
//! | c_n, c_t | 1 | coefficients of damping along and across the normal |

mod normal;
mod rolling;
mod tangential;
#[cfg(test)]
mod tests;

use super::{Material, effective_modulus_pa};
use nalgebra::Vector3;

/// What two materials and their surfaces make of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// E*, in pascals.
    effective_modulus_pa: f64,
    /// E*/(4 G*): delta_max as a share of mu delta_n, (2 - nu)/(2 (1 - nu)) of equal materials.
    slip_ratio: f64,
    surface: Friction,
}

/// How surfaces rub and how much of an impact they take, all without a unit and not below zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// mu: the largest tangential force as a share of the normal one.
    pub sliding: f64,
    /// mu_r: the moment against rolling as a share of the normal force times R*.
    pub rolling: f64,
    /// c_n: damping along the normal; [`Law::restitution`] says what an impact leaves.
    pub normal_damping: f64,
    /// c_t: damping across the normal, of contacts that do not slide.
    pub tangential_damping: f64,
}

/// Why there is no such law.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// A coefficient is below zero or not finite.
    #[error("{what} must be zero or above, not {value}")]
    Coefficient {
        /// What it is.
        what: &'static str,
        /// The value given.
        value: f64,
    },
    /// Both bodies are rigid.
    #[error("both materials are rigid: give one of them a finite Young's modulus")]
    Rigid,
}

/// Two bodies that touch, seen from the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// R*, in metres.
    pub radius: f64,
    /// m*, in kilograms.
    pub mass: f64,
    /// delta_n > 0, in metres.
    pub overlap: f64,
    /// The unit normal from the first body to the second.
    pub normal: Vector3<f64>,
    /// Velocity of the first body less that of the second at the contact, in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity of the first body less that of the second, in rad/s.
    pub spin: Vector3<f64>,
}

/// What acts on the first body at the contact; on the second the opposite does.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Action {
    /// Force, in newtons.
    pub force: Vector3<f64>,
    /// Moment beside that of the force, in newton metres: resistance to rolling.
    pub moment: Vector3<f64>,
}

impl Law {
    /// The law of two materials whose surfaces rub so.
    ///
    /// # Errors
    /// [`LawError`].
    pub fn new(one: &Material, other: &Material, surface: Friction) -> Result<Self, LawError> {
        for (what, value) in [
            ("the coefficient of friction", surface.sliding),
            ("the coefficient of rolling friction", surface.rolling),
            ("the normal damping", surface.normal_damping),
            ("the tangential damping", surface.tangential_damping),
        ] {
            // Written so that NaN fails.
            if !(value >= 0.0 && value.is_finite()) {
                return Err(LawError::Coefficient { what, value });
            }
        }
        let effective_modulus_pa = effective_modulus_pa(one, other);
        if !effective_modulus_pa.is_finite() {
            return Err(LawError::Rigid);
        }
        let sideways = one.shear_compliance_per_pa() + other.shear_compliance_per_pa();
        Ok(Self {
            effective_modulus_pa,
            slip_ratio: effective_modulus_pa * sideways / 4.0,
            surface,
        })
    }

    /// What acts on the first body. `slip` is delta_t, the displacement of the first body across the normal since they
    /// touch: it is turned into the tangent plane as that is now, grows by what they move in `step` seconds, and is
    /// kept for the next step.
    pub fn action(&self, contact: &Contact, slip: &mut Vector3<f64>, step: f64) -> Action {
        let (elastic, normal) = self.normal_forces(contact);
        *slip = tangential::turned(slip, &contact.normal);
        let across = self.friction(contact, elastic, normal, slip, step);
        Action {
            force: across - contact.normal * normal,
            moment: self.rolling_moment(contact, normal, step),
        }
    }
}
