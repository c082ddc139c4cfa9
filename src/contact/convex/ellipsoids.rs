//! The contact of two ellipsoids, whose squared gauges are of second degree: one unknown is left.
//!
//! With psi_1 = x.A x and psi_2 = (x - c).B (x - c), the least of (1 - s) psi_1 + s psi_2 over x is met at
//! x(s) = M⁻¹ s B c, M = (1 - s) A + s B. For every s from 0 to 1 it is a lower bound of mu², and the larger psi at x(s) is
//! an upper one; they meet where both psi are equal, which Newton's method finds (Perram and Wertheim 1985).

use super::pair::{ConvexPair, Found, Goal};
use nalgebra::{Matrix3, Vector3};

/// Steps allowed; four are usual.
const MAX_STEPS: usize = 40;

/// Bounds of the first guess of s.
const LEAST_SHARE: f64 = 1e-3;

/// Two ellipsoids seen from the first one's centre, along its axes.
pub(super) struct Ellipsoids {
    /// A, which is diagonal.
    first: Vector3<f64>,
    /// B.
    second: Matrix3<f64>,
    offset: Vector3<f64>,
}

impl Ellipsoids {
    /// `None` unless both bodies are ellipsoids.
    #[inline]
    pub(super) fn new(pair: &ConvexPair<'_>) -> Option<Self> {
        let weights =
            |[a, b, c]: [f64; 3]| Vector3::new(1.0 / (a * a), 1.0 / (b * b), 1.0 / (c * c));
        let first = weights(pair.first.ellipsoid()?);
        let second = weights(pair.second.ellipsoid()?);
        let scaled = Matrix3::from_fn(|i, j| pair.turn[(i, j)] * second[j]);
        Some(Self {
            first,
            second: scaled * pair.turn.transpose(),
            offset: pair.offset,
        })
    }

    /// Half the gradients of both squared gauges.
    #[inline(always)]
    fn slopes(&self, x: &Vector3<f64>) -> [Vector3<f64>; 2] {
        [self.first.component_mul(x), self.second * (x - self.offset)]
    }

    /// From a point where the gradients, weighed with s, are as opposite as can be.
    pub(super) fn solve(&self, pair: &ConvexPair<'_>, start: &Vector3<f64>, goal: &Goal) -> Found {
        let mut found = Found::start(pair, *start);
        let pull = self.second * self.offset;
        let [one, other] = self.slopes(start);
        let difference = other - one;
        let guess = -one.dot(&difference) / difference.norm_squared();
        // Written so that NaN is a half.
        let mut s = match guess.is_finite() {
            true => guess.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE),
            false => 0.5,
        };
        let [mut low, mut high] = [0.0, 1.0];
        for step in 1..=MAX_STEPS {
            found.iterations = step;
            let matrix = Matrix3::from_diagonal(&(self.first * (1.0 - s))) + self.second * s;
            let Some(matrix) = matrix.cholesky() else {
                break;
            };
            let x = matrix.solve(&(pull * s));
            let [one, other] = self.slopes(&x);
            let [first, second] = [x.dot(&one), (x - self.offset).dot(&other)];
            let lower = ((1.0 - s) * first + s * second).sqrt();
            found.point = x;
            found.upper = first.max(second).sqrt();
            if lower > found.lower {
                let normal = (one * (1.0 - s) - other * s).try_normalize(0.0);
                (found.lower, found.normal) = (lower, normal.unwrap_or(found.normal));
            }
            found.is_settled = goal.is_met(&found);
            if found.is_settled {
                break;
            }
            let miss = second - first;
            match miss > 0.0 {
                true => low = s,
                false => high = s,
            }
            let difference = other - one;
            s += 0.5 * miss / difference.dot(&matrix.solve(&difference));
            // Written so that NaN is halved away.
            if !(low < s && s < high) {
                s = 0.5 * (low + high);
            }
        }
        found
    }
}
