//! The n-norm of two numbers, (x^n + y^n)^(1/n), of which superquadrics are made.

use std::array::from_fn;

/// Least ratio of two numbers in a power below zero: where exponents are below 2, the curvature is that beside the
/// edge, large but finite.
const LEAST_RATIO: f64 = 1e-12;

/// Exponents below this are no more than 2, but for rounding: a fitted ellipsoid is not flat where it meets its axes.
const SQUARE: f64 = 2.0 + 1e-9;

/// `x` to the power `n`, for `x` from 0 to 1; small whole powers are multiplied out. By logarithms it loses digits of
/// small powers only, which do not tell beside the one that they are added to.
#[inline(always)]
pub(super) fn power(x: f64, n: f64) -> f64 {
    match n {
        0.0 => 1.0,
        1.0 => x,
        2.0 => x * x,
        3.0 => x * x * x,
        4.0 => (x * x) * (x * x),
        6.0 => (x * x) * (x * x) * (x * x),
        _ => x.powf(n),
    }
}

/// The n-th root of `x`, from 1 to 2.
#[inline(always)]
fn root(x: f64, n: f64) -> f64 {
    match n {
        2.0 => x.sqrt(),
        3.0 => x.cbrt(),
        4.0 => x.sqrt().sqrt(),
        6.0 => x.sqrt().cbrt(),
        8.0 => x.sqrt().sqrt().sqrt(),
        _ => x.powf(1.0 / n),
    }
}

/// The smaller over the larger of two numbers; of zeros it is zero.
#[inline(always)]
fn ratio(x: f64, y: f64) -> f64 {
    let large = x.max(y);
    if large > 0.0 { x.min(y) / large } else { 0.0 }
}

/// What belongs to x and to y, of what belongs to the larger and to the smaller of them. Written without a branch,
/// which would be taken or not at random.
#[inline(always)]
fn in_order(x: f64, y: f64, of_larger: f64, of_smaller: f64) -> [f64; 2] {
    let larger = usize::from(x < y);
    let mut both = [of_smaller; 2];
    both[larger] = of_larger;
    both
}

/// A norm p of two numbers not below zero with its slopes, (x/p)^(n-1) and (y/p)^(n-1).
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) norm: f64,
    pub(super) slopes: [f64; 2],
}

impl Slopes {
    /// The norm of exponent 1 + `beyond_one`.
    #[inline(always)]
    pub(super) fn new(x: f64, y: f64, beyond_one: f64) -> Self {
        let [one] = Self::side_by_side([x], [y], [beyond_one]);
        one
    }

    /// Several norms at once, each step of all before the next: powers take long, and a processor begins one before
    /// the last has ended if it does not depend on it.
    #[inline(always)]
    pub(super) fn side_by_side<const N: usize>(
        x: [f64; N],
        y: [f64; N],
        beyond_one: [f64; N],
    ) -> [Self; N] {
        let ratio: [f64; N] = from_fn(|i| ratio(x[i], y[i]));
        let slope: [f64; N] = from_fn(|i| power(ratio[i], beyond_one[i]));
        let sum: [f64; N] = from_fn(|i| 1.0 + slope[i] * ratio[i]);
        let s: [f64; N] = from_fn(|i| root(sum[i], 1.0 + beyond_one[i]));
        from_fn(|i| {
            // (large/p)^(n-1), for (large/p)^n = 1 / sum and p = s large.
            let steep = s[i] / sum[i];
            Self {
                norm: s[i] * x[i].max(y[i]),
                slopes: in_order(x[i], y[i], steep, slope[i] * steep),
            }
        })
    }
}

/// A norm p with what its first and second derivatives are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormJet {
    pub(super) norm: f64,
    /// x/p and y/p.
    pub(super) ratios: [f64; 2],
    /// (x/p)^(n-2) and (y/p)^(n-2).
    pub(super) powers: [f64; 2],
}

impl NormJet {
    /// Several norms of exponents n at once, as [`Slopes::side_by_side`].
    #[inline(always)]
    pub(super) fn side_by_side<const N: usize>(x: [f64; N], y: [f64; N], n: [f64; N]) -> [Self; N] {
        let ratio: [f64; N] = from_fn(|i| ratio(x[i], y[i]));
        let bent: [f64; N] = from_fn(|i| match n[i] < SQUARE {
            true => power(ratio[i].max(LEAST_RATIO), n[i] - 2.0),
            false => power(ratio[i], n[i] - 2.0),
        });
        let sum: [f64; N] = from_fn(|i| 1.0 + bent[i] * ratio[i] * ratio[i]);
        let s: [f64; N] = from_fn(|i| root(sum[i], n[i]));
        from_fn(|i| {
            let (first, flat) = (1.0 / s[i], s[i] * s[i] / sum[i]);
            Self {
                norm: s[i] * x[i].max(y[i]),
                ratios: in_order(x[i], y[i], first, ratio[i] * first),
                powers: in_order(x[i], y[i], flat, bent[i] * flat),
            }
        })
    }

    /// Slopes of the norm: (x/p)^(n-1) and (y/p)^(n-1).
    #[inline(always)]
    pub(super) fn slopes(&self) -> [f64; 2] {
        [0, 1].map(|i| self.powers[i] * self.ratios[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn powers_and_roots_multiplied_out_are_powers() {
        for n in [0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 2.5] {
            assert_relative_eq!(power(0.7, n), 0.7_f64.powf(n), max_relative = 1e-15);
        }
        for n in [2.0, 3.0, 4.0, 6.0, 8.0, 2.5] {
            assert_relative_eq!(root(1.7, n), 1.7_f64.powf(1.0 / n), max_relative = 1e-15);
        }
    }

    #[test]
    fn norms_of_zero_and_of_huge_exponents_are_finite() {
        for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1e300), (1e-300, 1e300)] {
            for n in [1.1, 2.0, 100.0] {
                let [jet] = NormJet::side_by_side([x], [y], [n]);
                let all = [jet.ratios, jet.powers].concat();
                assert!(all.iter().all(|z| z.is_finite()), "{x} {y} {n}: {jet:?}");
                assert_relative_eq!(jet.norm, x.max(y), max_relative = 1e-15);
            }
        }
    }
}
