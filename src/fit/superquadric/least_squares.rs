//! The method of Levenberg and Marquardt, with bounds and a robust loss (Madsen, Nielsen and Tingleff 2004).

use super::bodies::Body;
use super::loss::{Loss, Reach};
use super::normal_equations::{NormalEquations, distances};
use super::weighing::Weighing;
use crate::fit::context::{Cancelled, Context};
use crate::spread::robust_deviation;
use nalgebra::{Cholesky, DVector, Vector3};

/// Scale of the loss where few points are astray and where many are, in mean radii.
const WIDE: f64 = 0.5;
const NARROW: f64 = 0.03;

/// And where those astray are left out, in standard deviations.
const NEAR: f64 = 2.5;

/// What exact points may be off a body for rounding, in mean radii.
pub(super) const ROUNDING: f64 = 1e-9;

/// The damping to begin with, and beyond which no step helps.
const DAMPING: [f64; 2] = [1e-3, 1e12];

/// A fit ends when a step changes no parameter by more.
const SMALL_STEP: f64 = 1e-9;

/// How many times the loss of a minimum that of another one is.
pub(super) const OTHER_MINIMUM: f64 = 1.0 + 1e-3;

/// When else a fit ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    /// After so many steps.
    pub(super) steps: usize,
    /// When a step lowers the loss by no larger share.
    pub(super) gain: f64,
}

/// What a fit came to.
#[derive(Debug, Clone)]
pub(super) struct Minimum {
    pub(super) bodies: Vec<Body>,
    pub(super) iterations: usize,
    pub(super) weighing: Weighing,
}

/// Standard deviation of the distances of points from bodies, whatever a few strays do.
pub(super) fn deviation(bodies: &[Body], points: &[Vector3<f64>]) -> f64 {
    robust_deviation(distances(bodies, points).into_iter())
}

/// The weighing that goes with the distances of points from bodies.
pub(super) fn weighed(bodies: &[Body], points: &[Vector3<f64>], like: &Weighing) -> Weighing {
    let deviation = deviation(bodies, points);
    Weighing {
        loss: Loss {
            scale: match like.loss.reach {
                Reach::Wide => WIDE,
                Reach::Narrow => NARROW,
                Reach::Near => (NEAR * deviation).max(ROUNDING),
            },
            ..like.loss
        },
        prior: deviation * deviation,
        ..*like
    }
}

/// Fits bodies with the weighing that they ask for, and once more with the one that they then ask for.
pub(super) fn minimised(
    bodies: Vec<Body>,
    points: &[Vector3<f64>],
    like: &Weighing,
    end: End,
    context: &Context<'_>,
) -> Result<Minimum, Cancelled> {
    let weighing = weighed(&bodies, points, like);
    let first = descended(bodies, points, weighing, end, context)?;
    let weighing = weighed(&first.bodies, points, like);
    let found = descended(first.bodies, points, weighing, end, context)?;
    Ok(Minimum {
        iterations: first.iterations + found.iterations,
        ..found
    })
}

/// Which of some fits is the best; `None` of none.
pub(super) fn least(tried: &[Minimum], points: &[Vector3<f64>]) -> Option<usize> {
    let losses = losses(tried, points).into_iter().enumerate();
    let best = losses.min_by(|(_, p), (_, q)| p.total_cmp(q))?;
    Some(best.0)
}

/// Fits with their losses, the least first.
pub(super) fn ranked(tried: Vec<Minimum>, points: &[Vector3<f64>]) -> Vec<(f64, Minimum)> {
    let losses = losses(&tried, points);
    let mut ranked: Vec<_> = losses.into_iter().zip(tried).collect();
    ranked.sort_by(|(p, _), (q, _)| p.total_cmp(q));
    ranked
}

/// Of fits in the order of their losses those whose loss is so many times the least at most, each minimum once: the next
/// is another if its loss is so many times the last.
pub(super) fn distinct(ranked: Vec<(f64, Minimum)>, most: f64, another: f64) -> Vec<Minimum> {
    let least = ranked.first().map_or(0.0, |(loss, _)| *loss);
    let mut last = f64::NEG_INFINITY;
    let mut distinct = Vec::new();
    for (loss, found) in ranked {
        if loss > most * least {
            break;
        }
        if loss > another * last {
            last = loss;
            distinct.push(found);
        }
    }
    distinct
}

/// The losses of fits, all weighed as the one that needs the least scale.
pub(super) fn losses(tried: &[Minimum], points: &[Vector3<f64>]) -> Vec<f64> {
    let scales = tried.iter().map(|found| found.weighing);
    let Some(weighing) = scales.min_by(|p, q| p.loss.scale.total_cmp(&q.loss.scale)) else {
        return Vec::new();
    };
    let loss = |found: &Minimum| NormalEquations::new(&found.bodies, points, &weighing).loss;
    tried.iter().map(loss).collect()
}

/// Goes down with one weighing.
pub(super) fn descended(
    mut bodies: Vec<Body>,
    points: &[Vector3<f64>],
    weighing: Weighing,
    end: End,
    context: &Context<'_>,
) -> Result<Minimum, Cancelled> {
    let mut here = NormalEquations::new(&bodies, points, &weighing);
    let [mut damping, no_more] = DAMPING;
    let mut growth = 2.0;
    let mut iterations = 0;
    while iterations < end.steps && damping < no_more {
        context.check()?;
        iterations += 1;
        let Some((step, foretold)) = damped_step(&bodies, &here, &weighing, damping) else {
            damping *= growth;
            growth *= 2.0;
            continue;
        };
        let per_body = step.as_slice().chunks(weighing.form.parameters());
        let moved = bodies.iter().zip(per_body);
        let moved: Vec<_> = moved
            .map(|(body, step)| body.moved(weighing.form, step))
            .collect();
        let there = NormalEquations::new(&moved, points, &weighing);
        let gain = here.loss - there.loss;
        if gain.is_nan() || gain <= 0.0 {
            if step.amax() < SMALL_STEP {
                break;
            }
            damping *= growth;
            growth *= 2.0;
            continue;
        }
        let is_last = step.amax() < SMALL_STEP || gain < end.gain * here.loss;
        (bodies, here) = (moved, there);
        if is_last {
            break;
        }
        damping *= (1.0 - (2.0 * gain / foretold - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
        growth = 2.0;
    }
    Ok(Minimum {
        bodies,
        iterations,
        weighing,
    })
}

/// The damped step with numbers at a bound held there, and by how much it should lower the loss; `None` where the
/// damping is too small.
fn damped_step(
    bodies: &[Body],
    here: &NormalEquations,
    weighing: &Weighing,
    damping: f64,
) -> Option<(DVector<f64>, f64)> {
    let mut matrix = here.matrix.clone();
    let mut side = -&here.gradient;
    let ties = weighing.form.ties();
    for (index, body) in bodies.iter().enumerate() {
        for (number, tie) in ties.into_iter().enumerate() {
            let place = index * weighing.form.parameters() + tie;
            if body.is_held(number, side[place]) {
                matrix.row_mut(place).fill(0.0);
                matrix.column_mut(place).fill(0.0);
                side[place] = 0.0;
            }
        }
    }
    // Parameters that nothing depends on are damped as the others are on average.
    let floor = 1e-12 * matrix.trace().max(f64::MIN_POSITIVE);
    let added = matrix.diagonal().map(|entry| damping * entry + floor);
    for (i, more) in added.iter().enumerate() {
        matrix[(i, i)] += more;
    }
    let step = Cholesky::new(matrix)?.solve(&side);
    let foretold = 0.5 * step.dot(&(added.component_mul(&step) + side));
    Some((step, foretold))
}
