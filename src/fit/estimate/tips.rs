//! What the points say of bumps that the estimate leaves out.
//!
//! The prior is alike everywhere. It takes the last of a beak or a tip for noise, which the estimate then flattens;
//! but what it took is left in the residuals there. Let the surface have, beside what the prior tells of, a bump
//! b = exp(k (n.t - 1)) of unknown height about the end t. With the residuals e of the posterior mean, the most likely
//! height and its variance are
//!
//! ```text
//! a = S / I,   1 / I,      S = b'W e / s²,   I = b'W (b - b°) / s² + 1 / p²
//! ```
//!
//! with p the standard deviation of such heights before a point is seen, without which points far down a bump's side would
//! tell heights of any size, and b° what the estimate makes of radii b (generalised least squares: the inverse covariance of the radii takes them to
//! W e / s²). The estimate leaves out the share q_l that the points leave unlearnt: of b = sum b_l P_l that is
//! b - b° = sum q_l b_l P_l, at the end and in the mean square over a cloud that is alike everywhere. Of several widths the one
//! counts under which the points are most likely; the widest tells what they leave open for which the prior has no room.

mod sums;

use super::bump::{AT_POLE, EXPECTED, LegendreBump, falls};
use super::outcome::Estimate;
use super::posterior::Posterior;
use nalgebra::Vector3;
use sums::Points;

/// k of the [bumps](Points::bumps), each twice the one before: Gaussians of 20, 14, 10, 7, 5 and 3.5 degrees.
const SHARPNESSES: [f64; 6] = [8.0, 16.0, 32.0, 64.0, 128.0, 256.0];

/// What is missing at an end.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Missing {
    /// By how much it makes the points more likely, in squared standard deviations of its height.
    pub(super) gain: f64,
    /// Most likely height above the estimate, in units of the mean radius.
    pub(super) height: f64,
    /// Its variance.
    pub(super) variance: f64,
    /// k of the bump: over a small angle a it falls by k a² / 2 of its height.
    pub(super) sharpness: f64,
}

/// Standard deviations of its height beyond which a bump is no chance, of some thousand that are looked for.
const NO_CHANCE: f64 = 4.0;

impl Missing {
    /// Whether noise would hardly make as high a bump.
    pub(super) fn is_no_chance(&self) -> bool {
        self.gain > NO_CHANCE.powi(2)
    }
}

/// The points with what the estimate leaves of them.
pub(super) struct Tips {
    points: Points,
    noise: f64,
    bumps: [Bump; SHARPNESSES.len()],
}

#[derive(Clone, Copy)]
struct Bump {
    /// Its k.
    sharpness: f64,
    /// b - b° at the end, of a bump of height one.
    left: f64,
    /// Mean square b (b - b°) over that of b².
    left_of_squares: f64,
}

impl Bump {
    fn new(sharpness: f64, falls: &[f64], unlearnt: &[f64]) -> Self {
        let bump = LegendreBump::new(falls, &AT_POLE, unlearnt);
        Self {
            sharpness,
            left: bump.left.iter().sum::<f64>() / bump.series.iter().sum::<f64>(),
            left_of_squares: bump.left_of_squares,
        }
    }

    /// What is missing about an end, if it is this bump: from the sums of b w e and of w b².
    fn told(&self, [score, squares]: [f64; 2], noise: f64) -> Missing {
        let score = score / noise;
        let information = squares * self.left_of_squares / noise + 1.0 / (EXPECTED * EXPECTED);
        Missing {
            gain: score * score / information,
            height: self.left * score / information,
            variance: self.left * self.left / information,
            sharpness: self.sharpness,
        }
    }
}

impl Tips {
    pub(super) fn new(estimate: &Estimate, posterior: &Posterior<'_>) -> Self {
        Self {
            points: Points::new(
                posterior.cloud,
                &posterior.residuals(&estimate.coefficients),
            ),
            noise: estimate.spectrum.noise().powi(2),
            bumps: SHARPNESSES.map(|k| Bump::new(k, &falls(k), &estimate.unlearnt)),
        }
    }

    /// The likeliest and the widest of the bumps about an end, in the stretched space.
    pub(super) fn likeliest_and_widest(&self, end: &Vector3<f64>) -> [Missing; 2] {
        let bumps = self.likely(end);
        let widest = Some(bumps[0]).filter(|widest| widest.variance.is_finite());
        let known = bumps.into_iter().filter(|bump| bump.gain.is_finite());
        let likeliest = known.max_by(|a, b| a.gain.total_cmp(&b.gain));
        [likeliest, widest].map(Option::unwrap_or_default)
    }

    /// Each bump about an end.
    fn likely(&self, end: &Vector3<f64>) -> [Missing; SHARPNESSES.len()] {
        let sums: [_; SHARPNESSES.len()] = self.points.bumps(end);
        std::array::from_fn(|at| self.bumps[at].told(sums[at], self.noise))
    }
}

#[cfg(test)]
mod tests;
