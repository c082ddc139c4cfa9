//! Expansions with two derivatives, one direction at a time.

use super::{CapBasis, column};
use crate::sphere::{Cap, Jet};
use nalgebra::{Matrix3, Vector3};

impl CapBasis {
    /// An expansion with its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, cap: &Cap, coefficients: &[f64], n: &Vector3<f64>) -> Jet {
        let (coefficients, _) = coefficients.as_chunks();
        let [jet] = self.jets::<1>(cap, coefficients, n);
        jet
    }

    /// K expansions, whose coefficients stand side by side.
    pub(crate) fn jets<const K: usize>(
        &self,
        cap: &Cap,
        coefficients: &[[f64; K]],
        n: &Vector3<f64>,
    ) -> [Jet; K] {
        let [u, v, x] = cap.coordinates((*n).into());
        let place = |value: f64, gradient: Vector3<f64>| Jet {
            value,
            gradient,
            hessian: Matrix3::zeros(),
        };
        let per_tangent = 1.0 / cap.tangent_length();
        let u = place(u, cap.tangents[0] * per_tangent);
        let v = place(v, cap.tangents[1] * per_tangent);
        let x = place(x, cap.centre * (-2.0 / cap.height));
        let degree = (coefficients.len().isqrt().saturating_sub(1)).min(self.degree);
        let mut sums = [Jet::default(); K];
        let mut add = |function: Jet, coefficients: &[f64; K]| {
            for (sum, coefficient) in sums.iter_mut().zip(coefficients) {
                *sum = sum.plus(&function.scaled(*coefficient));
            }
        };
        let (mut re, mut im) = (Jet::constant(1.0), Jet::default());
        for (m, (first, steps)) in self.orders.iter().enumerate().take(degree + 1) {
            if m > 0 {
                (re, im) = (
                    re.times(&u).plus(&im.times(&v).scaled(-1.0)),
                    re.times(&v).plus(&im.times(&u)),
                );
            }
            let (mut below, mut current) = (Jet::default(), Jet::constant(*first));
            for j in 0..=degree - m {
                let at = column(m + j, m);
                add(current.times(&re), &coefficients[at]);
                if m > 0 {
                    add(current.times(&im), &coefficients[at + 1]);
                }
                if let Some(s) = steps.get(j) {
                    let factor = Jet {
                        value: s.a * x.value + s.b,
                        ..x.scaled(s.a)
                    };
                    let next = factor.times(&current).plus(&below.scaled(-s.c));
                    (below, current) = (current, next);
                }
            }
        }
        sums
    }
}
