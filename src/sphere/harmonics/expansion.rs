//! Expansions in harmonics in one direction, with derivatives.
//!
//! The harmonic of degree l and order m is Re or Im (x + iy)^m times a polynomial Q_lm(z). Its
//! derivatives with respect to x, y and z, as a function of space, are regular everywhere: there are no
//! angles and nothing is divided by sin(theta). Q and its derivatives follow the recurrence
//!
//! ```text
//! Q_(l+1) = a z Q_l - b Q_(l-1),   Q' _(l+1) = a (z Q'_l + Q_l) - b Q'_(l-1),   and so on
//! ```
//!
//! and are summed over l for each m, about (L+1)^2 multiplications per derivative and no memory.
//! The number of coefficients sets the degree L, at most that of the basis.

use super::HarmonicBasis;
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};

/// The sums of one order, of the cosine and of the sine, with D - 1 derivatives along z, and the
/// powers of x + iy that they are multiplied by.
struct Order<const D: usize> {
    order: f64,
    cosine: [f64; D],
    sine: [f64; D],
    /// (x + iy)^m, ^(m-1) and ^(m-2) as real and imaginary parts; zero where the power is negative.
    powers: [[f64; 2]; 3],
}

impl<const D: usize> Order<D> {
    /// Cosine's sum times the real part plus sine's sum times the imaginary part of the power m -
    /// `lowered`, for a derivative along z.
    fn along_x(&self, along_z: usize, lowered: usize) -> f64 {
        let [re, im] = self.powers[lowered];
        self.cosine[along_z] * re + self.sine[along_z] * im
    }

    /// The same for i times the power: what a derivative along y gives.
    fn along_y(&self, along_z: usize, lowered: usize) -> f64 {
        let [re, im] = self.powers[lowered];
        self.sine[along_z] * re - self.cosine[along_z] * im
    }
}

impl HarmonicBasis {
    /// The value of an expansion in the direction of the unit vector `n`.
    pub fn value(&self, coefficients: &[f64], n: &Vector3<f64>) -> f64 {
        let mut sum = 0.0;
        let (coefficients, _) = coefficients.as_chunks();
        self.for_each_order::<1, 1>(coefficients, n, |[order]| sum += order.along_x(0, 0));
        sum
    }

    /// Value and surface gradient (per radian, orthogonal to `n`) of an expansion.
    pub(crate) fn value_and_gradient(
        &self,
        coefficients: &[f64],
        n: &Vector3<f64>,
    ) -> (f64, Vector3<f64>) {
        let (coefficients, _) = coefficients.as_chunks();
        let [found] = self.values_and_gradients(coefficients, n);
        found
    }

    /// Values and surface gradients of K expansions, whose coefficients stand side by side.
    pub(crate) fn values_and_gradients<const K: usize>(
        &self,
        coefficients: &[[f64; K]],
        n: &Vector3<f64>,
    ) -> [(f64, Vector3<f64>); K] {
        let mut found = [(0.0, Vector3::zeros()); K];
        self.for_each_order::<2, K>(coefficients, n, |orders| {
            for ((value, gradient), order) in found.iter_mut().zip(&orders) {
                *value += order.along_x(0, 0);
                *gradient += in_space(order);
            }
        });
        found.map(|(value, gradient)| (value, gradient - n * gradient.dot(n)))
    }

    /// An expansion with its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, coefficients: &[f64], n: &Vector3<f64>) -> Jet {
        let (coefficients, _) = coefficients.as_chunks();
        let [jet] = self.jets(coefficients, n);
        jet
    }

    /// K expansions, whose coefficients stand side by side.
    pub(crate) fn jets<const K: usize>(
        &self,
        coefficients: &[[f64; K]],
        n: &Vector3<f64>,
    ) -> [Jet; K] {
        let mut jets = [Jet::default(); K];
        self.for_each_order::<3, K>(coefficients, n, |orders| {
            for (jet, order) in jets.iter_mut().zip(&orders) {
                jet.value += order.along_x(0, 0);
                jet.gradient += in_space(order);
                let (once, twice) = (order.order, order.order * (order.order - 1.0));
                let xx = twice * order.along_x(0, 2);
                let xy = twice * order.along_y(0, 2);
                let xz = once * order.along_x(1, 1);
                let yz = once * order.along_y(1, 1);
                let zz = order.along_x(2, 0);
                jet.hessian += Matrix3::new(xx, xy, xz, xy, -xx, yz, xz, yz, zz);
            }
        });
        jets
    }

    /// Calls `with` with the sums of every order, of K expansions.
    fn for_each_order<const D: usize, const K: usize>(
        &self,
        coefficients: &[[f64; K]],
        n: &Vector3<f64>,
        mut with: impl FnMut([Order<D>; K]),
    ) {
        let Some(degree) = coefficients.len().isqrt().checked_sub(1) else {
            return;
        };
        let degree = degree.min(self.degree);
        let mut sectoral = 1.0;
        let mut powers = [[1.0, 0.0], [0.0; 2], [0.0; 2]];
        let mut steps = &self.steps[..];
        for m in 0..=degree {
            sectoral *= self.sectoral[m];
            let mut first = sectoral;
            if m > 0 {
                first *= 2.0_f64.sqrt();
                let [re, im] = powers[0];
                let next = [re * n.x - im * n.y, re * n.y + im * n.x];
                powers = [next, powers[0], powers[1]];
            }
            let (of_order, others) = steps.split_at(self.degree + 1 - m);
            steps = others;
            let (mut below, mut current) = ([0.0; D], [0.0; D]);
            current[0] = first;
            let (mut cosines, mut sines) = ([[0.0; D]; K], [[0.0; D]; K]);
            for (l, [up, back]) in (m..=degree).zip(of_order) {
                let middle = l * (l + 1);
                let (a, b) = (&coefficients[middle + m], &coefficients[middle - m]);
                for k in 0..K {
                    for d in 0..D {
                        cosines[k][d] += a[k] * current[d];
                        sines[k][d] += b[k] * current[d];
                    }
                }
                let mut next = [0.0; D];
                for d in 0..D {
                    let lower = if d > 0 {
                        d as f64 * current[d - 1]
                    } else {
                        0.0
                    };
                    next[d] = up * (n.z * current[d] + lower) - back * below[d];
                }
                (below, current) = (current, next);
            }
            with(std::array::from_fn(|k| Order {
                order: m as f64,
                cosine: cosines[k],
                sine: sines[k],
                powers,
            }));
        }
    }
}

/// What an order contributes to the gradient of the expansion as a function of space.
fn in_space<const D: usize>(order: &Order<D>) -> Vector3<f64> {
    Vector3::new(
        order.order * order.along_x(0, 1),
        order.order * order.along_y(0, 1),
        order.along_x(1, 0),
    )
}

#[cfg(test)]
mod tests;
