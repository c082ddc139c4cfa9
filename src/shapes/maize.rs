//! A maize kernel.

use super::{Bump, Bumpy};
use crate::model::{Derivatives, StarSurface};
use crate::sphere::Jet;
use nalgebra::Vector3;

/// A maize kernel, some 11.5 x 8.5 x 5 mm: a flat wedge, its tip cap towards -x and a concave crown
/// towards +x.
///
/// r(n) = W(n) (1 + sum A exp(kappa (n . d - 1))) with W a [`Wedge`] and two bumps: the tip cap and
/// the hollow of the crown, each a Gaussian of some 0.3 rad.
///
/// Mirror-symmetric in y and z. Star-shaped: the crown takes away at most 0.13 of the radius.
pub fn maize() -> Bumpy<Wedge> {
    Bumpy {
        base: Wedge {
            semi_axes: Vector3::new(5.6, 3.6, 2.45),
            taper: Vector3::new(0.0, 0.35, 0.1),
        },
        bumps: vec![
            Bump::round(0.11, 14.0, [-1.0, 0.0, 0.0]),
            Bump::round(-0.13, 8.0, [1.0, 0.0, 0.0]),
        ],
    }
}

/// A flattened block with round edges, narrower towards -x:
/// r(n) = ((n_x/a)⁴ + (n_y/b(n))⁴ + (n_z/c(n))⁴)^(-1/4) with each semi-axis tapered as
/// a(n) = a exp(t_a n_x).
///
/// The sum h in the brackets is positive on the whole sphere, so r is positive and smooth; its
/// gradient is the tangential part of -r/(4h) times that of h.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wedge {
    /// Semi-axes a, b, c in the plane x = 0, positive.
    pub semi_axes: Vector3<f64>,
    /// Growth rates of the three semi-axes with n_x.
    pub taper: Vector3<f64>,
}

impl StarSurface for Wedge {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.scaled(n).map(|s| s.powi(4)).sum().powf(-0.25)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (axes, scaled) = (self.tapered(n), self.scaled(n));
        let h = scaled.map(|s| s.powi(4)).sum();
        let r = h.powf(-0.25);
        let mut slope = scaled.map(|s| s.powi(3)).component_div(&axes);
        slope.x -= scaled.map(|s| s.powi(4)).dot(&self.taper);
        let slope = slope * (-r / h);
        (r, slope - n * n.dot(&slope))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let along = |axis: usize, rate: f64| Jet::linear(n, Vector3::ith(axis, rate));
        let h = (0..3)
            .map(|i| {
                let shrink = along(0, -self.taper[i]).exp();
                let scaled = along(i, 1.0 / self.semi_axes[i]).times(&shrink);
                scaled.powf(4.0)
            })
            .fold(Jet::default(), |sum, power| sum.plus(&power));
        Derivatives::on_sphere(n, &h.powf(-0.25))
    }
}

impl Wedge {
    /// The semi-axes as tapered at `n`.
    fn tapered(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.taper
            .map(|t| (t * n.x).exp())
            .component_mul(&self.semi_axes)
    }

    /// The coordinates of `n` over the semi-axes there.
    fn scaled(&self, n: &Vector3<f64>) -> Vector3<f64> {
        n.component_div(&self.tapered(n))
    }
}
