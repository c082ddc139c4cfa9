//! Resistance to rolling: a moment against the relative spin (Zhou and others 1999).

use super::{Contact, Law};
use nalgebra::Vector3;

impl Law {
    /// -mu_r R* F_n w/|w| with the relative spin w, in newton metres; never more than would end the spin of a sphere of
    /// mass m* and radius R* in a step, so that a body at rest is not shaken.
    pub(super) fn rolling_moment(&self, contact: &Contact, normal: f64, step: f64) -> Vector3<f64> {
        let spin = contact.spin.norm();
        if self.surface.rolling == 0.0 || spin == 0.0 {
            return Vector3::zeros();
        }
        let moment = self.surface.rolling * contact.radius * normal;
        let stopping = 0.4 * contact.mass * contact.radius.powi(2) * spin / step;
        contact.spin * (-moment.min(stopping) / spin)
    }
}
