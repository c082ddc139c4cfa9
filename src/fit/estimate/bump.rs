//! Bumps of the radius around a circle, which may be a point, and what an estimate leaves of them.
//!
//! exp(k (n.t - 1)) about a point t is the sum of (2 l + 1) b_l P_l(n.t) with b_l = exp(-l (l + 1) / 2 k) times a constant, but
//! for terms of the order 1 / k; its mean over the points t at the polar angle s is that of (2 l + 1) b_l P_l(cos s) P_l.

use std::iter::repeat;

/// Degrees of a bump are below this times the root of its k, ...
const REACH: f64 = 6.0;

/// ... and below this.
pub(super) const HIGHEST: usize = 96;

/// Standard deviation of heights, in units of the mean radius, before a point is seen: that of beaks. Without it points far down the
/// sides of a bump, as about a hole, would tell heights of any size.
pub(super) const EXPECTED: f64 = 0.1;

/// Legendre polynomials at the pole: of the circle that is a point.
pub(super) const AT_POLE: [f64; HIGHEST] = [1.0; HIGHEST];

/// b_l by degree, of the bumps with this k.
pub(super) fn falls(sharpness: f64) -> Vec<f64> {
    let degrees = ((REACH * sharpness.sqrt()) as usize).min(HIGHEST);
    let fall = |l: usize| (-((l * (l + 1)) as f64) / (2.0 * sharpness)).exp();
    (0..degrees).map(fall).collect()
}

/// A bump around a circle, by degree.
pub(super) struct LegendreBump {
    /// Factors of the Legendre polynomials in the cosine of the polar angle.
    pub(super) series: Vec<f64>,
    /// The part of them that the points leave unlearnt.
    pub(super) left: Vec<f64>,
    /// The share that this part has of the mean square.
    pub(super) left_of_squares: f64,
}

impl LegendreBump {
    /// `at_circle`: the Legendre polynomials there; `unlearnt`: the shares by degree, beyond them all.
    pub(super) fn new(falls: &[f64], at_circle: &[f64; HIGHEST], unlearnt: &[f64]) -> Self {
        let heights: Vec<f64> = falls.iter().zip(at_circle).map(|(b, p)| b * p).collect();
        let part = |(l, height): (usize, &f64)| (2 * l + 1) as f64 * height;
        let series: Vec<f64> = heights.iter().enumerate().map(part).collect();
        let shares = unlearnt.iter().copied().chain(repeat(1.0));
        let left: Vec<f64> = series.iter().zip(shares).map(|(b, q)| b * q).collect();
        let squares = |part: &[f64]| -> f64 { part.iter().zip(&heights).map(|(a, b)| a * b).sum() };
        Self {
            left_of_squares: squares(&left) / squares(&series),
            series,
            left,
        }
    }
}
