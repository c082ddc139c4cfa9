//! Functions of many directions with derivatives, for loops that the compiler vectorises.

use super::Jet;
use nalgebra::{Matrix3, Vector3};

/// A function in N directions with its first ORDER derivatives (none to two) with respect to the components of n, as if
/// it were a function of space. Derivatives of higher order are not touched, and so cost nothing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jets<const ORDER: usize, const N: usize> {
    pub(crate) value: [f64; N],
    pub(crate) gradient: [[f64; N]; 3],
    /// At [`entry`].
    pub(crate) hessian: [[f64; N]; 6],
}

/// The entry of two axes in a list of those of a symmetric matrix: the diagonal, then those without x, y and z.
#[inline(always)]
pub(super) const fn entry(i: usize, j: usize) -> usize {
    if i == j { i } else { 6 - i - j }
}

/// The axes of each entry.
pub(super) const AXES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [0, 2], [0, 1]];

impl<const ORDER: usize, const N: usize> Jets<ORDER, N> {
    pub(crate) const ZERO: Self = Self {
        value: [0.0; N],
        gradient: [[0.0; N]; 3],
        hessian: [[0.0; N]; 6],
    };

    /// Adds another function.
    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Self) {
        add(&mut self.value, &other.value);
        if ORDER > 0 {
            for axis in 0..3 {
                add(&mut self.gradient[axis], &other.gradient[axis]);
            }
        }
        if ORDER > 1 {
            for at in 0..6 {
                add(&mut self.hessian[at], &other.hessian[at]);
            }
        }
    }

    /// Adds the product of two functions.
    #[inline(always)]
    pub(crate) fn add_product(&mut self, a: &Self, b: &Self) {
        for i in 0..N {
            self.value[i] += a.value[i] * b.value[i];
        }
        if ORDER > 0 {
            for axis in 0..3 {
                let (da, db) = (&a.gradient[axis], &b.gradient[axis]);
                for i in 0..N {
                    self.gradient[axis][i] += a.value[i] * db[i] + da[i] * b.value[i];
                }
            }
        }
        if ORDER > 1 {
            for (at, [j, k]) in AXES.into_iter().enumerate() {
                let (dda, ddb) = (&a.hessian[at], &b.hessian[at]);
                for i in 0..N {
                    self.hessian[at][i] += a.value[i] * ddb[i]
                        + dda[i] * b.value[i]
                        + a.gradient[j][i] * b.gradient[k][i]
                        + a.gradient[k][i] * b.gradient[j][i];
                }
            }
        }
    }

    /// The quotient of two functions.
    #[inline(always)]
    #[expect(
        clippy::needless_range_loop,
        reason = "iterators over lanes are not vectorised in one piece here"
    )]
    pub(crate) fn over(&self, divisor: &Self) -> Self {
        let mut out = Self::ZERO;
        let mut per = [0.0; N];
        for i in 0..N {
            per[i] = 1.0 / divisor.value[i];
            out.value[i] = self.value[i] * per[i];
        }
        if ORDER > 0 {
            for axis in 0..3 {
                for i in 0..N {
                    let slope = self.gradient[axis][i] - divisor.gradient[axis][i] * out.value[i];
                    out.gradient[axis][i] = slope * per[i];
                }
            }
        }
        if ORDER > 1 {
            for (at, [j, k]) in AXES.into_iter().enumerate() {
                for i in 0..N {
                    let bend = self.hessian[at][i]
                        - divisor.hessian[at][i] * out.value[i]
                        - out.gradient[j][i] * divisor.gradient[k][i]
                        - out.gradient[k][i] * divisor.gradient[j][i];
                    out.hessian[at][i] = bend * per[i];
                }
            }
        }
        out
    }

    /// Takes from the gradients what is not along the sphere.
    #[inline(always)]
    #[expect(
        clippy::needless_range_loop,
        reason = "iterators over lanes are not vectorised in one piece here"
    )]
    pub(crate) fn keep_along_sphere(&mut self, n: &[[f64; N]; 3]) {
        let mut outwards = [0.0; N];
        for axis in 0..3 {
            for i in 0..N {
                outwards[i] += self.gradient[axis][i] * n[axis][i];
            }
        }
        for axis in 0..3 {
            for i in 0..N {
                self.gradient[axis][i] -= outwards[i] * n[axis][i];
            }
        }
    }

    /// The gradient in one of the directions.
    #[inline(always)]
    pub(crate) fn gradient_at(&self, i: usize) -> Vector3<f64> {
        Vector3::from(self.gradient.map(|component| component[i]))
    }
}

impl<const N: usize> Jets<2, N> {
    /// The function in one of the directions.
    #[inline(always)]
    pub(crate) fn jet_at(&self, i: usize) -> Jet {
        Jet {
            value: self.value[i],
            gradient: self.gradient_at(i),
            hessian: Matrix3::from_fn(|j, k| self.hessian[entry(j, k)][i]),
        }
    }
}

#[inline(always)]
fn add<const N: usize>(sum: &mut [f64; N], other: &[f64; N]) {
    for i in 0..N {
        sum[i] += other[i];
    }
}
