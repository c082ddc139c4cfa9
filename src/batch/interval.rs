//! Intervals of what two normal lots differ by, where each varies by an amount of its own that its few grains tell badly.
//!
//! Of a lot of n grains with mean m and standard deviation s, what its population may be is told by Fisher's fiducial
//! law: its variance is V = s² (n - 1) / χ², χ² of n - 1 degrees of freedom, and its mean is normal about m with the
//! variance V / n. From both lots follow the law of the difference of the means, that of Behrens and Fisher, and by the
//! same rule that of any other figure of the two: these are generalised confidence intervals (Weerahandi 1993). The
//! difference and the effect size so have the same odds of being below zero, and their intervals agree about its sign.

use std::f64::consts::FRAC_1_SQRT_2;

/// Share of intervals that hold the truth.
const CONFIDENCE: f64 = 0.95;

/// Logarithm of the least weight that counts beside the largest.
const LEAST: f64 = -14.0;

/// The most steps in place of one in which a variance is taken where the odds of an effect size change from 0 to 1 within one.
const MOST_STEPS: f64 = 16.0;

/// Halvings of the reach in which the end of an interval is looked for.
const HALVINGS: usize = 30;

/// Doublings of that reach.
const DOUBLINGS: i32 = 64;

/// What is known of a measure of a lot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// Number of grains, two or more.
    pub(super) count: usize,
    /// Their mean.
    pub(super) mean: f64,
    /// Their standard deviation (with n - 1).
    pub(super) deviation: f64,
}

/// Intervals at 95 %, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Intervals {
    /// Of the difference of the means, second less first.
    pub(super) difference: [f64; 2],
    /// Of that over the root of the mean of both variances.
    pub(super) effect: [f64; 2],
}

/// What two populations may be.
struct Case {
    weight: f64,
    /// Standard deviation of the difference of the means.
    error: f64,
    /// Root of the mean of both variances.
    scale: f64,
}

/// The intervals of two lots; none where a lot does not vary, and so does not tell by how much its population does.
pub(super) fn intervals(lots: [Sample; 2]) -> Option<Intervals> {
    if lots.iter().any(|lot| lot.deviation <= 0.0) {
        return None;
    }
    // In a unit of their own, that their squares are within the range of numbers.
    let unit = lots[0].deviation.max(lots[1].deviation);
    let lots = lots.map(|lot| Sample {
        mean: (lot.mean - lots[0].mean) / unit,
        deviation: lot.deviation / unit,
        ..lot
    });
    let [one, other] = lots;
    let own = case(
        lots,
        (1.0, one.deviation.powi(2)),
        (1.0, other.deviation.powi(2)),
    );
    let difference = other.mean - one.mean;
    // Of the lot that tells more of the scale the steps are finer, and what is summed over them is smooth in the other's.
    let steepness = lots.map(|lot| {
        let scale = lot.deviation.powi(2) / (4.0 * own.scale.powi(2));
        step(&lot) * scale * difference.abs() / own.error
    });
    let finer = usize::from(steepness[1] > steepness[0]);
    let steps = |i: usize| match i == finer {
        true => steepness[i].ceil().clamp(1.0, MOST_STEPS),
        false => 1.0,
    };
    let [first, second] = [0, 1].map(|i| variances(&lots[i], steps(i)));
    let cases: Vec<Case> = first
        .iter()
        .flat_map(|one| second.iter().map(|other| case(lots, *one, *other)))
        .collect();
    let below = |value: f64| share(&cases, |case| (value - difference) / case.error);
    let effect_below = |value: f64| {
        share(&cases, |case| {
            (value * case.scale - difference) / case.error
        })
    };
    Some(Intervals {
        difference: interval(below, difference, own.error)?.map(|end| unit * end),
        effect: interval(effect_below, difference / own.scale, own.error / own.scale)?,
    })
}

/// Variances that a population may have, each with its weight, which has no unit.
///
/// With χ² = k exp(y) of k degrees of freedom the density of y is as exp(k / 2 (y - exp(y))): smooth, and nil far out,
/// so that sums at equal steps of y are integrals: at so many in place of one.
fn variances(lot: &Sample, steps: f64) -> Vec<(f64, f64)> {
    let freedom = lot.count as f64 - 1.0;
    let step = step(lot) / steps;
    let weight = |y: f64| 0.5 * freedom * (y + 1.0 - y.exp());
    let counts = |y: &f64| weight(*y) > LEAST;
    let up = (0..).map(|i| step * f64::from(i)).take_while(counts);
    let down = (1..).map(|i| -step * f64::from(i)).take_while(counts);
    up.chain(down)
        .map(|y| (weight(y).exp(), lot.deviation.powi(2) / y.exp()))
        .collect()
}

/// Half a standard deviation of y.
fn step(lot: &Sample) -> f64 {
    (0.5 / (lot.count as f64 - 1.0)).sqrt()
}

fn case(lots: [Sample; 2], one: (f64, f64), other: (f64, f64)) -> Case {
    let [count, other_count] = lots.map(|lot| lot.count as f64);
    Case {
        weight: one.0 * other.0,
        error: (one.1 / count + other.1 / other_count).sqrt(),
        scale: (0.5 * (one.1 + other.1)).sqrt(),
    }
}

/// Odds of a normal variable that is below `z` in each case.
fn share(cases: &[Case], z: impl Fn(&Case) -> f64) -> f64 {
    let normal = |z: f64| 0.5 * libm::erfc(-FRAC_1_SQRT_2 * z);
    let below: f64 = cases.iter().map(|case| case.weight * normal(z(case))).sum();
    below / cases.iter().map(|case| case.weight).sum::<f64>()
}

/// Between which values those that are not among the odds of either end lie, looked for around one of them.
fn interval(below: impl Fn(f64) -> f64, around: f64, width: f64) -> Option<[f64; 2]> {
    let odds = 0.5 * (1.0 - CONFIDENCE);
    let reach = (0..DOUBLINGS)
        .map(|doubling| width * 2_f64.powi(doubling))
        .find(|reach| below(around - reach) < odds && below(around + reach) > 1.0 - odds)?;
    let end = |odds: f64| {
        let (mut low, mut high) = (around - reach, around + reach);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match below(middle) < odds {
                true => low = middle,
                false => high = middle,
            }
        }
        0.5 * (low + high)
    };
    Some([end(odds), end(1.0 - odds)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    fn sample(count: usize, mean: f64, deviation: f64) -> Sample {
        Sample {
            count,
            mean,
            deviation,
        }
    }

    #[test]
    fn the_interval_of_the_difference_is_that_of_behrens_and_fisher() {
        // Of two equal lots of 6 degrees of freedom each, by numerical integration of the difference of two t; the tables
        // of Fisher and Yates have 2.435.
        let lots = [sample(7, 3.0, 2.0), sample(7, 4.0, 2.0)];
        let [low, high] = intervals(lots).unwrap().difference;
        let error = (8.0_f64 / 7.0).sqrt();
        assert_relative_eq!((high - low) / (2.0 * error), 2.435_925, max_relative = 1e-5);
        assert_relative_eq!(high + low, 2.0, max_relative = 1e-6);
    }

    #[test]
    fn beside_a_lot_that_hardly_varies_the_intervals_are_those_of_students_t() {
        // 2.776445 is the quantile of 4 degrees of freedom, 12.706205 that of one; 0.470896 and 4.818324 are sqrt(2 / 5)
        // times the noncentralities by which a t of 3 sqrt(2) is at either quantile.
        let still = sample(9, 0.0, 1e-9);
        let found = intervals([still, sample(5, 3.0, 2.5_f64.sqrt())]).unwrap();
        let half = 2.776_445 * 0.5_f64.sqrt();
        assert_relative_eq!(found.difference[0], 3.0 - half, max_relative = 1e-5);
        assert_relative_eq!(found.difference[1], 3.0 + half, max_relative = 1e-5);
        assert_relative_eq!(found.effect[0], 0.470_896, max_relative = 1e-4);
        assert_relative_eq!(found.effect[1], 4.818_324, max_relative = 1e-4);
        let found = intervals([still, sample(2, 0.0, 2_f64.sqrt())]).unwrap();
        assert_relative_eq!(found.difference[1], 12.706_205, max_relative = 1e-4);
    }

    /// The difference is known well, and the effect size is as the scale: beside a still lot as the root of χ², whose quantiles
    /// of 29 degrees of freedom are 16.0471 and 45.7223; of two alike by twenty million draws.
    #[test]
    fn large_effects_are_as_uncertain_as_the_scale() {
        let end = |quantile: f64| 1e4 * (2.0 * quantile / 29.0).sqrt();
        for (deviation, ends) in [
            (1e-9, [16.0471, 45.7223].map(end)),
            (1.0, [7978.0, 11664.2]),
        ] {
            for (one, other) in [(deviation, 1.0), (1.0, deviation)] {
                let lots = [sample(30, 0.0, one), sample(30, 1e4, other)];
                let found = intervals(lots).unwrap().effect;
                for (found, end) in found.into_iter().zip(ends) {
                    assert_relative_eq!(found, end, max_relative = 3e-3);
                }
            }
        }
    }

    /// Pairs of normal lots.
    const PAIRS: usize = 200;

    /// Shares of their intervals that hold the truth, of the difference and of the effect.
    fn coverage(counts: [usize; 2], ratio: f64, effect: f64) -> [f64; 2] {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let difference = effect * (0.5 * (1.0 + ratio * ratio)).sqrt();
        let mut lot = |count: usize, mean: f64, deviation: f64| {
            let values: Vec<f64> = (0..count)
                .map(|_| {
                    let normal: f64 = StandardNormal.sample(&mut random);
                    mean + deviation * normal
                })
                .collect();
            let (mean, deviation) = crate::batch::statistics::moments(&values);
            sample(count, mean, deviation.unwrap())
        };
        let mut held = [0_usize; 2];
        for _ in 0..PAIRS {
            let lots = [lot(counts[0], 0.0, 1.0), lot(counts[1], difference, ratio)];
            let found = intervals(lots).unwrap();
            let sign = |[low, high]: [f64; 2]| [low > 0.0, high < 0.0];
            assert_eq!(sign(found.difference), sign(found.effect), "{lots:?}");
            let truths = [(found.difference, difference), (found.effect, effect)];
            for (held, ([low, high], truth)) in held.iter_mut().zip(truths) {
                *held += usize::from(low < truth && truth < high);
            }
        }
        held.map(|held| held as f64 / PAIRS as f64)
    }
    #[test]
    fn of_a_hundred_intervals_95_or_more_hold_the_truth() {
        // The largest difference from .95 by chance: three standard errors.
        let least = 0.95 - 3.0 * (0.95_f64 * 0.05 / PAIRS as f64).sqrt();
        for (counts, ratio, effect) in [
            ([2, 2], 0.2, 5.0),
            ([2, 20], 0.2, 1.0),
            ([3, 3], 1.0, 5.0),
            ([4, 40], 0.2, 2.0),
            ([10, 80], 0.5, 1.0),
            ([20, 20], 5.0, 0.0),
        ] {
            let shares = coverage(counts, ratio, effect);
            assert!(
                shares.iter().all(|share| *share > least),
                "{counts:?} {ratio} {effect}: {shares:?}"
            );
        }
        // Where the lots tell enough, they are no wider than need be.
        let most = coverage([20, 40], 2.0, 1.0);
        assert!(most.iter().all(|share| *share < 0.975), "{most:?}");
    }
}
