//! Functions of a direction with two derivatives.

use nalgebra::{Matrix3, Vector3};

/// A function of a direction with its first two derivatives with respect to the components of n, as
/// if it were a function of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) gradient: Vector3<f64>,
    pub(crate) hessian: Matrix3<f64>,
}

impl Default for Jet {
    fn default() -> Self {
        Self {
            value: 0.0,
            gradient: Vector3::zeros(),
            hessian: Matrix3::zeros(),
        }
    }
}

impl Jet {
    /// A constant.
    pub(crate) fn constant(value: f64) -> Self {
        Self {
            value,
            ..Self::default()
        }
    }

    /// The linear function with this slope.
    pub(crate) fn linear(n: &Vector3<f64>, slope: Vector3<f64>) -> Self {
        Self {
            value: slope.dot(n),
            gradient: slope,
            ..Self::default()
        }
    }

    /// This function to a power.
    pub(crate) fn powf(&self, power: f64) -> Self {
        let slope = |times: f64| self.value.powf(power - times);
        self.composed(
            slope(0.0),
            power * slope(1.0),
            power * (power - 1.0) * slope(2.0),
        )
    }

    /// The exponential of this function.
    pub(crate) fn exp(&self) -> Self {
        let value = self.value.exp();
        self.composed(value, value, value)
    }

    /// A function of this one, given by its value and its first two derivatives here.
    pub(crate) fn composed(&self, value: f64, first: f64, second: f64) -> Self {
        Self {
            value,
            gradient: self.gradient * first,
            hessian: self.hessian * first + self.gradient * self.gradient.transpose() * second,
        }
    }

    /// A multiple of this function.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            gradient: self.gradient * factor,
            hessian: self.hessian * factor,
        }
    }

    /// The product of two functions.
    pub(crate) fn times(&self, other: &Self) -> Self {
        let mixed = self.gradient * other.gradient.transpose();
        Self {
            value: self.value * other.value,
            gradient: self.gradient * other.value + other.gradient * self.value,
            hessian: self.hessian * other.value
                + other.hessian * self.value
                + mixed
                + mixed.transpose(),
        }
    }

    /// The sum of two functions.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            value: self.value + other.value,
            gradient: self.gradient + other.gradient,
            hessian: self.hessian + other.hessian,
        }
    }
}
