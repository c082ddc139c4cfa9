//! Gauss–Legendre quadrature.

use std::num::NonZeroUsize;

/// The Gauss–Legendre rule with `n` nodes on \[-1, 1\]: exact for polynomials of degree <= 2n - 1.
///
/// Nodes ascend and are symmetric about zero to the last bit; the weights sum to two.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GaussLegendre {
    /// Nodes and their weights.
    pairs: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule with `n` nodes. With `n` = 0 the rule is empty and every sum over it is zero.
    pub(crate) fn new(n: usize) -> Self {
        let Some(count) = NonZeroUsize::new(n) else {
            return Self { pairs: Vec::new() };
        };
        let rule = gauss_quad::GaussLegendre::new(count);
        let mut pairs = rule.as_node_weight_pairs().to_vec();
        // The nodes of the crate are symmetric but for their last bits.
        for i in 0..n / 2 {
            let (node, weight) = pairs[n - 1 - i];
            pairs[i] = (-node, weight);
        }
        if n % 2 == 1 {
            pairs[n / 2].0 = 0.0;
        }
        Self { pairs }
    }

    /// The number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Pairs (node, weight) of the rule mapped to the interval from `a` to `b`.
    pub(crate) fn on(&self, a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        self.pairs
            .iter()
            .map(move |(x, w)| (middle + half * x, half * w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_rule_is_exact_to_degree_2n_minus_1_on_any_interval() {
        for n in [1, 2, 4, 7, 16, 33, 64, 301] {
            let rule = GaussLegendre::new(n);
            assert_eq!(rule.len(), n);
            for degree in [0, 1, n, 2 * n - 1] {
                let exponent = degree as f64 + 1.0;
                let sum: f64 = rule
                    .on(0.0, 0.5)
                    .map(|(x, w)| w * x.powf(degree as f64))
                    .sum();
                assert_relative_eq!(sum, 0.5_f64.powf(exponent) / exponent, max_relative = 1e-13);
            }
        }
        assert_eq!(GaussLegendre::new(0).on(0.0, 1.0).count(), 0);
    }

    #[test]
    fn nodes_ascend_and_are_symmetric() {
        for n in [2, 9, 50, 301] {
            let pairs: Vec<_> = GaussLegendre::new(n).on(-1.0, 1.0).collect();
            assert!(pairs.is_sorted());
            let mirrored = pairs.iter().rev().map(|&(x, w)| (-x, w));
            assert!(mirrored.eq(pairs.iter().copied()));
        }
    }
}
