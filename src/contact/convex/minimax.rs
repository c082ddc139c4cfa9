//! The point where the larger of two gauges is least, by sequential quadratic programming.
//!
//! Of the squared gauges psi, which are convex and of second degree, both are linearised, and with a multiplier s
//! between 0 and 1 the sum (1 - s) H_1 + s H_2 of their second derivatives takes the place of both: the step d makes
//! both linear models equal, and s is the multiplier of that. Steps are halved until the larger psi falls.

use super::pair::{ConvexPair, Found, Goal};
use super::positive;
use crate::sphere::Jet;
use nalgebra::Vector3;

/// Steps allowed; pairs of DEM take five, hard ones twelve.
const MAX_STEPS: usize = 60;

/// Halvings of a step.
const MAX_HALVINGS: usize = 25;

/// Share of the fall that the model foretells which a step must bring.
const ARMIJO: f64 = 1e-4;

/// Steps below this share of the distance of the centres are worth a look at the lower bound.
const SHORT: f64 = 1e-2;

/// Bounds of the first guess of the multiplier.
const LEAST_SHARE: f64 = 1e-3;

/// The square of a gauge.
#[inline(always)]
fn squared(gauge: &Jet) -> Jet {
    let g = gauge.value;
    let slope = gauge.gradient * (2.0 * g);
    Jet {
        value: g * g,
        gradient: slope,
        hessian: gauge.hessian * (2.0 * g) + gauge.gradient * gauge.gradient.transpose() * 2.0,
    }
}

#[inline(always)]
fn squares(pair: &ConvexPair<'_>, x: &Vector3<f64>) -> [Jet; 2] {
    let [first, second] = pair.jets(x);
    [squared(&first), squared(&second)]
}

pub(super) fn solve(pair: &ConvexPair<'_>, start: Vector3<f64>, goal: &Goal) -> Found {
    let mut x = start;
    let [mut one, mut other] = squares(pair, &x);
    let distance = pair.offset.norm();
    let mut found = Found {
        upper: one.value.max(other.value).sqrt(),
        ..Found::start(pair, x)
    };
    let mut stalls = 0;
    for step in 1..=MAX_STEPS {
        found.iterations = step;
        let Some((direction, s)) = newton_step(&one, &other) else {
            break;
        };
        let before = one.value.max(other.value);
        let foretold = (one.value + one.gradient.dot(&direction))
            .max(other.value + other.gradient.dot(&direction))
            - before;
        let mut length = 1.0;
        let mut is_better = false;
        for _ in 0..MAX_HALVINGS {
            let tried = x + direction * length;
            let [first, second] = squares(pair, &tried);
            let after = first.value.max(second.value);
            if after <= before + ARMIJO * length * foretold.min(0.0) + 1e-15 * before {
                (x, one, other, is_better) = (tried, first, second, true);
                found.upper = after.sqrt();
                break;
            }
            length *= 0.5;
        }
        found.point = x;
        stalls += usize::from(!is_better);
        if length * direction.norm() > SHORT * distance && is_better {
            continue;
        }
        if let Some(normal) = (one.gradient * (1.0 - s) - other.gradient * s).try_normalize(0.0) {
            let lower = pair.lower_bound(&normal);
            if lower > found.lower {
                (found.lower, found.normal) = (lower, normal);
            }
        }
        found.is_settled = goal.is_met(&found);
        if found.is_settled || stalls > 1 {
            break;
        }
    }
    found
}

/// The step and the multiplier s of it.
#[inline(always)]
fn newton_step(one: &Jet, other: &Jet) -> Option<(Vector3<f64>, f64)> {
    let difference = other.gradient - one.gradient;
    // The multiplier that comes nearest to opposite gradients.
    let squared = difference.norm_squared();
    let guess = match squared > 0.0 {
        true => -one.gradient.dot(&difference) / squared,
        false => 0.5,
    };
    let guess = guess.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
    let hessian = one.hessian * (1.0 - guess) + other.hessian * guess;
    let [along, across] = positive::solve(&hessian, [&one.gradient, &difference])?;
    let bend = difference.dot(&across);
    let s = match bend > 0.0 {
        true => ((other.value - one.value) - difference.dot(&along)) / bend,
        false => guess,
    };
    let s = s.clamp(0.0, 1.0);
    Some((-(along + across * s), s))
}
