//! Smooth local swellings and dents on a simple body.

use super::Solid;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::Jet;
use nalgebra::Vector3;

/// A smooth local change of radius, as a share of it: A exp(kappa (n . d - 1) - (n . p)²).
///
/// It is highest in the direction d and falls off as a Gaussian of standard deviation
/// 1/sqrt(kappa) radians; the pinch p makes it steeper across the plane orthogonal to p, which turns
/// a dent into a groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bump {
    amplitude: f64,
    sharpness: f64,
    direction: Vector3<f64>,
    pinch: Vector3<f64>,
}

impl Bump {
    /// A round bump of amplitude A (negative: a dent), sharpness kappa > 0, around the direction d,
    /// a vector of any positive length.
    pub fn round(amplitude: f64, sharpness: f64, direction: [f64; 3]) -> Self {
        Self {
            amplitude,
            sharpness,
            direction: Vector3::from(direction).normalize(),
            pinch: Vector3::zeros(),
        }
    }

    /// The same bump, narrowed along `pinch`, orthogonal to its direction.
    pub fn pinched(self, pinch: [f64; 3]) -> Self {
        Self {
            pinch: Vector3::from(pinch),
            ..self
        }
    }

    fn value(&self, n: &Vector3<f64>) -> f64 {
        let across = n.dot(&self.pinch);
        self.amplitude * (self.sharpness * (n.dot(&self.direction) - 1.0) - across * across).exp()
    }

    /// The value and its derivatives in space.
    fn jet(&self, n: &Vector3<f64>) -> Jet {
        let away = Jet::linear(n, self.direction).plus(&Jet::constant(-1.0));
        let across = Jet::linear(n, self.pinch);
        let exponent = away
            .scaled(self.sharpness)
            .plus(&across.times(&across).scaled(-1.0));
        exponent.exp().scaled(self.amplitude)
    }

    /// The value and its derivative in space, of which only the tangential part has a meaning.
    fn value_and_slope(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let value = self.value(n);
        let slope = self.direction * self.sharpness - self.pinch * (2.0 * n.dot(&self.pinch));
        (value, slope * value)
    }
}

/// The derivatives of a product of functions on the sphere, from those of its factors.
fn product(one: &Derivatives, other: &Derivatives) -> Derivatives {
    let jet = |factor: &Derivatives| Jet {
        value: factor.radius,
        gradient: factor.gradient,
        hessian: factor.hessian,
    };
    let product = jet(one).times(&jet(other));
    Derivatives {
        radius: product.value,
        gradient: product.gradient,
        hessian: product.hessian,
    }
}

/// A body with bumps: r(n) = base(n) (1 + sum of the bumps at n).
///
/// As smooth as its base, and star-shaped as long as the negative amplitudes sum to more than -1.
#[derive(Debug, Clone, PartialEq)]
pub struct Bumpy<B> {
    /// The body without its bumps.
    pub base: B,
    /// The bumps; their order does not matter.
    pub bumps: Vec<Bump>,
}

impl<B: StarSurface> StarSurface for Bumpy<B> {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let swelling: f64 = self.bumps.iter().map(|bump| bump.value(n)).sum();
        self.base.radius(n) * (1.0 + swelling)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (radius, gradient) = self.base.radius_and_gradient(n);
        let (mut factor, mut slope) = (1.0, Vector3::zeros());
        for bump in &self.bumps {
            let (value, derivative) = bump.value_and_slope(n);
            factor += value;
            slope += derivative;
        }
        let tangential = slope - n * n.dot(&slope);
        (radius * factor, gradient * factor + tangential * radius)
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let factor = self
            .bumps
            .iter()
            .fold(Jet::constant(1.0), |sum, bump| sum.plus(&bump.jet(n)));
        product(
            &self.base.derivatives(n),
            &Derivatives::on_sphere(n, &factor),
        )
    }
}

impl<B: StarSurface + Send> Solid for Bumpy<B> {}
