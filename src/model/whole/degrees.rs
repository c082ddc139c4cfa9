//! Sums over the degrees of spherical harmonics, one order at a time.
//!
//! The real orthonormal harmonics of the orders m and -m are Q_l^m(z) Re and Im (x + iy)^m, with Q a
//! polynomial (see [`crate::sphere::HarmonicBasis`] for conventions and normalisation). So an expansion
//! is
//!
//! ```text
//! f(x, y, z) = sum over m of  A_m(z) Re (x + iy)^m + B_m(z) Im (x + iy)^m,   A_m = sum over l of a_l^m Q_l^m
//! ```
//!
//! a polynomial in x, y, z: nothing is singular at the poles, and its derivatives are those of A and B,
//! which the recurrence gives by the rule of Leibniz. Directions of equal z share the sums.

use std::f64::consts::PI;

/// The three-term recurrences of Q_l^m, l = m, m + 1, ...
#[derive(Debug, Clone)]
pub(super) struct Degrees {
    degree: usize,
    /// Per order m: Q_m^m, with the factor sqrt(2) of the orders other than zero.
    sectoral: Vec<f64>,
    /// Per order m and degree l = m, ..., degree: Q_(l+1) = up z Q_l - back Q_(l-1).
    steps: Vec<[f64; 2]>,
}

/// A sum over the degrees and its first derivatives with respect to z, at N places.
pub(super) type Sums<const D: usize, const N: usize> = [[f64; N]; D];

impl Degrees {
    /// Up to a degree.
    pub(super) fn new(degree: usize) -> Self {
        let ratio = |l: usize, m: usize| {
            let (l, m) = (l as f64, m as f64);
            ((4.0 * l * l - 1.0) / (l * l - m * m)).sqrt()
        };
        let mut sectoral = Vec::with_capacity(degree + 1);
        let mut product = 1.0 / (4.0 * PI).sqrt();
        for m in 0..=degree {
            if m > 0 {
                product *= ((2 * m + 1) as f64 / (2 * m) as f64).sqrt();
            }
            let scale = if m > 0 { 2.0_f64.sqrt() } else { 1.0 };
            sectoral.push(scale * product);
        }
        let pairs = (0..=degree).flat_map(|m| (m..=degree).map(move |l| (l, m)));
        let steps = pairs
            .map(|(l, m)| {
                let up = ratio(l + 1, m);
                [up, if l == m { 0.0 } else { up / ratio(l, m) }]
            })
            .collect();
        Self {
            degree,
            sectoral,
            steps,
        }
    }

    /// The highest degree.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// Gives to `each`, order by order from zero, the sums A and B at heights z with D - 1 derivatives.
    #[inline(always)]
    pub(super) fn sums<const D: usize, const N: usize>(
        &self,
        coefficients: &[f64],
        z: &[f64; N],
        mut each: impl FnMut(&Sums<D, N>, &Sums<D, N>),
    ) {
        let mut steps = self.steps.iter();
        for (m, sectoral) in self.sectoral.iter().enumerate() {
            let (mut a, mut b) = ([[0.0; N]; D], [[0.0; N]; D]);
            let (mut below, mut current) = ([[0.0; N]; D], [[0.0; N]; D]);
            current[0] = [*sectoral; N];
            for (l, [up, back]) in (m..=self.degree).zip(steps.by_ref()) {
                let middle = l * (l + 1);
                let (cos, sin) = (coefficients[middle + m], coefficients[middle - m]);
                let mut next = [[0.0; N]; D];
                for d in 0..D {
                    for i in 0..N {
                        a[d][i] += cos * current[d][i];
                        b[d][i] += sin * current[d][i];
                        // In an order that keeps short what the next step waits for.
                        let mut rest = back * below[d][i];
                        if d > 0 {
                            rest -= up * d as f64 * current[d - 1][i];
                        }
                        next[d][i] = up * z[i] * current[d][i] - rest;
                    }
                }
                (below, current) = (current, next);
            }
            if m == 0 {
                b = [[0.0; N]; D];
            }
            each(&a, &b);
        }
    }
}
