//! The terms of one order after another, at one place.

use nalgebra::Vector3;

/// An expansion at (x, y, z) as its orders m = 0, 1, 2, ... are added up, with its derivatives in space.
#[derive(Debug)]
pub(super) struct Azimuth {
    x: f64,
    y: f64,
    /// Real and imaginary part of (x + iy) to the powers m, the next order, and m - 1.
    powers: [[f64; 2]; 2],
    /// m.
    order: f64,
    pub(super) value: f64,
    pub(super) gradient: Vector3<f64>,
}

impl Azimuth {
    pub(super) fn new(x: f64, y: f64) -> Self {
        Self {
            x,
            y,
            powers: [[1.0, 0.0], [0.0; 2]],
            order: 0.0,
            value: 0.0,
            gradient: Vector3::zeros(),
        }
    }

    /// Adds the next order, given by A and B and their slopes: A Re w^m + B Im w^m with w = x + iy. The
    /// derivative of w^m is m w^(m-1), and i times that with respect to y.
    pub(super) fn add(&mut self, [a, a1]: [f64; 2], [b, b1]: [f64; 2]) {
        let [now, before] = self.powers;
        self.value += term(a, b, now);
        self.gradient += Vector3::new(
            self.order * term(a, b, before),
            self.order * term(b, -a, before),
            term(a1, b1, now),
        );
        let [re, im] = now;
        let next = [re * self.x - im * self.y, re * self.y + im * self.x];
        self.powers = [next, now];
        self.order += 1.0;
    }

    /// The value, and the part of the gradient that is tangential to the sphere at `n`.
    pub(super) fn on_sphere(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        (self.value, self.gradient - n * self.gradient.dot(n))
    }
}

fn term(a: f64, b: f64, [re, im]: [f64; 2]) -> f64 {
    a * re + b * im
}
