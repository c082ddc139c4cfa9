//! The one trait that closed-form bodies and fitted models share.

use nalgebra::Vector3;

/// A closed surface that every ray from the origin meets once: r = r(n), n a unit vector.
///
/// Everything is said in terms of the direction `n`, never of angles, so nothing is singular at the
/// poles. With the surface gradient g (the tangential derivative of r on the unit sphere, a vector
/// orthogonal to n), the outward normal is along `r n - g` and the element of area is
/// `r sqrt(r^2 + |g|^2)` per unit solid angle.
pub trait StarSurface {
    /// Radius in the direction of the unit vector `n`.
    fn radius(&self, n: &Vector3<f64>) -> f64;

    /// Radius and its surface gradient (length per radian, orthogonal to `n`).
    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>);
}
