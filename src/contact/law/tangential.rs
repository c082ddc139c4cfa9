//! Across the normal: friction after Mindlin and Deresiewicz.

use super::{Contact, Law};
use nalgebra::Vector3;

/// The vector in the plane across the normal, as long as it was: a contact that turns with its bodies keeps it.
pub(super) fn turned(slip: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    let across = slip - normal * slip.dot(normal);
    let (before, after) = (slip.norm(), across.norm());
    match after > 0.0 {
        true => across * (before / after),
        false => Vector3::zeros(),
    }
}

impl Law {
    /// The force against `slip` and against its growth, in newtons:
    ///
    /// ```text
    /// mu F_e (1 - q^1.5) + c_t sqrt(6 mu m* F_e sqrt(q) / delta_max) v_t,   q = 1 - delta_t / delta_max,
    /// delta_max = mu E*/(4 G*) delta_n  =  mu (2 - nu)/(2 (1 - nu)) delta_n  of equal materials
    /// ```
    ///
    /// At delta_t = delta_max the bodies slide, and the displacement grows no more. By that delta_max the force begins
    /// with the stiffness 8 G* a of Mindlin (1949), a = sqrt(R* delta_n). Damping cannot make it more than mu times the
    /// normal force.
    pub(super) fn friction(
        &self,
        contact: &Contact,
        elastic: f64,
        normal: f64,
        slip: &mut Vector3<f64>,
        step: f64,
    ) -> Vector3<f64> {
        let mu = self.surface.sliding;
        let most = mu * self.slip_ratio * contact.overlap;
        if most <= 0.0 {
            *slip = Vector3::zeros();
            return Vector3::zeros();
        }
        let velocity = contact.velocity - contact.normal * contact.velocity.dot(&contact.normal);
        *slip += velocity * step;
        let mut length = slip.norm();
        if length > most {
            *slip *= most / length;
            length = most;
        }
        let left = 1.0 - length / most;
        let mut force = Vector3::zeros();
        if length > 0.0 {
            force -= *slip * (mu * elastic * (1.0 - left * left.sqrt()) / length);
        }
        let damping = 6.0 * mu * contact.mass * elastic * left.sqrt() / most;
        force -= velocity * (self.surface.tangential_damping * damping.sqrt());
        let (limit, size) = (mu * normal, force.norm());
        match size > limit {
            true => force * (limit / size),
            false => force,
        }
    }
}
