//! Real orthonormal spherical harmonics, as the dissertation publishes them (2.13, 2.15).
//!
//! ```text
//! m > 0: sqrt(2) N cos(m phi) P_l^m(cos theta)    m = 0: N P_l(cos theta)
//! m < 0: sqrt(2) N sin(|m| phi) P_l^|m|(cos theta)
//! ```
//!
//! without the Condon-Shortley phase (P_1^1 = + sin theta), and index j = l(l+1) + m. Evaluated by
//! the fully normalised recurrence, which holds sin^m theta inside and needs no factorials; error
//! below 1e-13 up to degree 64.

mod expansion;
mod polar_parts;

use nalgebra::Vector3;
use std::f64::consts::PI;

/// Index of the harmonic of degree l and order m, from -l to l, in a list: j = l(l+1) + m. Of other orders it is that of
/// another degree, or of none.
pub const fn harmonic_index(degree: usize, order: isize) -> usize {
    degree
        .wrapping_mul(degree.wrapping_add(1))
        .wrapping_add_signed(order)
}

/// All real orthonormal harmonics of degree <= `degree` in the direction of the unit vector `n`, at
/// their [`harmonic_index`]. In many directions, a [`HarmonicBasis`] is faster.
pub fn harmonics(degree: usize, n: &Vector3<f64>) -> Vec<f64> {
    let mut values = vec![0.0; (degree + 1) * (degree + 1)];
    HarmonicBasis::new(degree).evaluate(n, &mut values);
    values
}

/// All real orthonormal harmonics up to a degree, with the factors of their recurrence.
#[derive(Debug, Clone, PartialEq)]
pub struct HarmonicBasis {
    degree: usize,
    /// Per order m: the factor from the sectoral harmonic of order m - 1 to that of m.
    sectoral: Vec<f64>,
    /// Per order m and degree l = m, ..., degree: what cos(theta) times the harmonic of degree l and what
    /// that of degree l - 1 contribute to that of degree l + 1.
    steps: Vec<[f64; 2]>,
}

impl HarmonicBasis {
    /// The harmonics of degree 0 to `degree`.
    pub fn new(degree: usize) -> Self {
        let ratio = |l: usize, m: usize| {
            let (l, m) = (l as f64, m as f64);
            ((4.0 * l * l - 1.0) / (l * l - m * m)).sqrt()
        };
        let orders = 0..=degree;
        Self {
            degree,
            sectoral: orders
                .clone()
                .map(|m| match m {
                    0 => 1.0 / (4.0 * PI).sqrt(),
                    m => ((2 * m + 1) as f64 / (2 * m) as f64).sqrt(),
                })
                .collect(),
            steps: orders
                .flat_map(|m| (m..=degree).map(move |l| (l, m)))
                .map(|(l, m)| {
                    let up = ratio(l + 1, m);
                    [up, if l == m { 0.0 } else { up / ratio(l, m) }]
                })
                .collect(),
        }
    }

    /// Their values in the direction of the unit vector `n`, at their [`harmonic_index`]: `out` holds
    /// (degree + 1)² of them.
    ///
    /// # Panics
    ///
    /// If `out` is shorter than that.
    pub fn evaluate(&self, n: &Vector3<f64>, out: &mut [f64]) {
        let mut sectoral = 1.0;
        let (mut re, mut im) = (1.0, 0.0);
        let mut steps = self.steps.iter();
        for m in 0..=self.degree {
            sectoral *= self.sectoral[m];
            let mut scale = 1.0;
            if m > 0 {
                (re, im) = (re * n.x - im * n.y, re * n.y + im * n.x);
                scale = 2.0_f64.sqrt();
            }
            let (cos, sin) = (scale * re, scale * im);
            let (mut below, mut current) = (0.0, sectoral);
            for (l, [up, back]) in (m..=self.degree).zip(steps.by_ref()) {
                let order = m as isize;
                out[harmonic_index(l, order)] = cos * current;
                if m > 0 {
                    out[harmonic_index(l, -order)] = sin * current;
                }
                (below, current) = (current, up * n.z * current - back * below);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_beyond_the_degree_have_an_index_too() {
        assert_eq!(harmonic_index(2, -1), 5);
        assert_eq!(harmonic_index(1, isize::MAX), isize::MAX as usize + 2);
        assert_eq!(harmonic_index(1, isize::MIN), (isize::MIN + 2) as usize);
    }

    #[test]
    fn low_degrees_match_their_closed_forms() {
        let n = Vector3::new(0.48, 0.6, 0.64);
        let y = harmonics(2, &n);
        let expected = [
            0.5 / PI.sqrt(),
            (3.0 / (4.0 * PI)).sqrt() * n.y,
            (3.0 / (4.0 * PI)).sqrt() * n.z,
            (3.0 / (4.0 * PI)).sqrt() * n.x,
            (15.0 / (4.0 * PI)).sqrt() * n.x * n.y,
            (15.0 / (4.0 * PI)).sqrt() * n.y * n.z,
            (5.0 / (16.0 * PI)).sqrt() * (3.0 * n.z * n.z - 1.0),
            (15.0 / (4.0 * PI)).sqrt() * n.x * n.z,
            (15.0 / (16.0 * PI)).sqrt() * (n.x * n.x - n.y * n.y),
        ];
        for (have, want) in y.iter().zip(expected) {
            assert!((have - want).abs() < 1e-15, "{have} {want}");
        }
    }

    #[test]
    fn the_addition_theorem_holds_at_high_degree() {
        let degree = 64;
        for n in [Vector3::new(0.0, 0.0, 1.0), Vector3::new(0.48, 0.6, 0.64)] {
            let y = harmonics(degree, &n);
            for l in 0..=degree {
                let sum: f64 = y[l * l..(l + 1) * (l + 1)].iter().map(|y| y * y).sum();
                let want = (2 * l + 1) as f64 / (4.0 * PI);
                assert!((sum / want - 1.0).abs() < 1e-12, "l = {l}");
            }
        }
    }
}
