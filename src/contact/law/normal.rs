//! Along the normal: the theory of Hertz, and damping that leaves the same share of any impact.

use super::{Contact, Law};
use std::f64::consts::PI;

impl Law {
    /// The elastic force 4/3 E* sqrt(R*) delta_n^1.5, and with damping c_n sqrt(8 m* E* sqrt(R* delta_n)) v_n the force
    /// that acts, in newtons. Bodies that part do not pull: it is not below zero.
    pub(super) fn normal_forces(&self, contact: &Contact) -> (f64, f64) {
        // 2 E* times the radius of the patch.
        let stiffness = 2.0 * self.effective_modulus_pa * (contact.radius * contact.overlap).sqrt();
        let elastic = 2.0 / 3.0 * stiffness * contact.overlap;
        let approach = contact.velocity.dot(&contact.normal);
        let viscous =
            self.surface.normal_damping * (4.0 * contact.mass * stiffness).sqrt() * approach;
        (elastic, (elastic + viscous).max(0.0))
    }

    /// The share of its velocity that a sphere keeps in a head-on impact without friction.
    ///
    /// In y = delta_n^(5/4) the motion is that of a linear oscillator with the damping ratio zeta = sqrt(6/5) c_n
    /// (Antypov and Elliott 2011); it ends where the force would pull (Schwager and Pöschel 2007):
    /// exp(-zeta/s (pi - atan2(2 zeta s, 1 - 2 zeta²))), s = sqrt(1 - zeta²).
    pub fn restitution(&self) -> f64 {
        let zeta = 1.2_f64.sqrt() * self.surface.normal_damping;
        let s = (1.0 - zeta * zeta).abs().sqrt();
        match zeta < 1.0 {
            true => {
                let phase = PI - (2.0 * zeta * s).atan2(1.0 - 2.0 * zeta * zeta);
                (-zeta / s * phase).exp()
            }
            // Damped more than critically: its solution is one of hyperbolic functions.
            false if s > 0.0 => (-zeta / s * ((zeta + s) / (zeta - s)).ln()).exp(),
            false => (-2.0_f64).exp(),
        }
    }
}
