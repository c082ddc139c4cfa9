//! Gauss–Legendre quadrature.
//!
//! The nodes are the zeros of the Legendre polynomial P_n, the weights 2 / ((1 - x²) P_n'(x)²)
//! (Abramowitz and Stegun, 25.4.29). Newton's iteration on the three-term recurrence starts from
//! Tricomi's cos(pi (i - 1/4) / (n + 1/2)) and needs two to four steps. Cost: O(n²) once per rule.

use std::f64::consts::PI;

/// Newton's iteration on P_n doubles its digits each step and starts with at least two.
const NEWTON_STEPS: usize = 8;

/// The Gauss–Legendre rule with `n` nodes on \[-1, 1\]: exact for polynomials of degree <= 2n - 1.
///
/// Nodes ascend and are symmetric about zero to the last bit; the weights sum to two.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussLegendre {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl GaussLegendre {
    /// The rule with `n` nodes. With `n` = 0 the rule is empty and every sum over it is zero.
    pub fn new(n: usize) -> Self {
        let mut nodes = vec![0.0; n];
        let mut weights = vec![0.0; n];
        for i in 0..n.div_ceil(2) {
            let is_middle = 2 * i + 1 == n;
            let mut x = match is_middle {
                true => 0.0,
                false => (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos(),
            };
            for _ in 0..NEWTON_STEPS {
                let (value, slope) = legendre(n, x);
                let step = value / slope;
                x -= step;
                if step.abs() < f64::EPSILON {
                    break;
                }
            }
            let (_, slope) = legendre(n, x);
            let weight = 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
            (nodes[i], nodes[n - 1 - i]) = (-x, x);
            (weights[i], weights[n - 1 - i]) = (weight, weight);
        }
        Self { nodes, weights }
    }

    /// The nodes on \[-1, 1\], ascending.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The weights on \[-1, 1\], in the order of the nodes.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Pairs (node, weight) of the rule mapped to the interval from `a` to `b`.
    pub fn on(&self, a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        self.nodes
            .iter()
            .zip(&self.weights)
            .map(move |(x, w)| (middle + half * x, half * w))
    }
}

/// P_n(x) and P_n'(x) for n >= 1 and |x| < 1, by
/// j P_j = (2j - 1) x P_{j-1} - (j - 1) P_{j-2} and (x² - 1) P_n' = n (x P_n - P_{n-1}).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for j in 2..=n {
        let j = j as f64;
        let next = ((2.0 * j - 1.0) * x * current - (j - 1.0) * previous) / j;
        (previous, current) = (current, next);
    }
    let slope = n as f64 * (x * current - previous) / ((x - 1.0) * (x + 1.0));
    (current, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn matches_the_closed_forms() {
        let (a, b) = ((0.6_f64).sqrt(), 5.0 / 9.0);
        let third = GaussLegendre::new(3);
        for (got, want) in third.nodes().iter().zip([-a, 0.0, a]) {
            assert_abs_diff_eq!(*got, want, epsilon = 1e-15);
        }
        for (got, want) in third.weights().iter().zip([b, 8.0 / 9.0, b]) {
            assert_abs_diff_eq!(*got, want, epsilon = 1e-15);
        }

        let root = (10.0_f64 / 7.0).sqrt();
        let (inner, outer) = (
            (5.0 - 2.0 * root).sqrt() / 3.0,
            (5.0 + 2.0 * root).sqrt() / 3.0,
        );
        let fifth = GaussLegendre::new(5);
        for (got, want) in fifth
            .nodes()
            .iter()
            .zip([-outer, -inner, 0.0, inner, outer])
        {
            assert_abs_diff_eq!(*got, want, epsilon = 1e-15);
        }
        let w = (322.0 + 13.0 * 70.0_f64.sqrt()) / 900.0;
        assert_abs_diff_eq!(fifth.weights()[1], w, epsilon = 1e-15);
        assert_abs_diff_eq!(fifth.weights()[2], 128.0 / 225.0, epsilon = 1e-15);
    }

    #[test]
    fn is_exact_to_degree_2n_minus_1() {
        for n in [1, 2, 4, 7, 16, 33, 64] {
            let rule = GaussLegendre::new(n);
            for degree in 0..2 * n {
                let sum: f64 = rule
                    .on(-1.0, 1.0)
                    .map(|(x, w)| w * x.powi(degree as i32))
                    .sum();
                let exact = match degree % 2 {
                    0 => 2.0 / (degree as f64 + 1.0),
                    _ => 0.0,
                };
                assert_abs_diff_eq!(sum, exact, epsilon = 2e-14);
            }
        }
    }

    #[test]
    fn nodes_ascend_and_are_symmetric() {
        for n in [2, 9, 50, 301] {
            let rule = GaussLegendre::new(n);
            assert!(rule.nodes().windows(2).all(|pair| pair[0] < pair[1]));
            for i in 0..n {
                assert_eq!(rule.nodes()[i], -rule.nodes()[n - 1 - i]);
            }
        }
    }

    #[test]
    fn maps_to_an_interval() {
        let sum: f64 = GaussLegendre::new(12)
            .on(1.0, 3.0)
            .map(|(x, w)| w * x.exp())
            .sum();
        assert_abs_diff_eq!(sum, 3.0_f64.exp() - 1.0_f64.exp(), epsilon = 1e-13);
    }

    #[test]
    fn an_empty_rule_sums_to_zero() {
        assert_eq!(GaussLegendre::new(0).on(0.0, 1.0).count(), 0);
    }
}
