//! Two lots of grains beside each other.

use super::interval::{Sample, intervals};
use super::lot::Lot;
use super::own_error::computed_to;
use super::statistics::moments;
use serde::Serialize;
use std::f64::consts::SQRT_2;

/// One measure of two lots.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub(crate) struct Comparison {
    /// Name of the column.
    pub measure: String,
    /// Grains of each lot of which it is known.
    pub counts: [usize; 2],
    /// Mean of each lot.
    pub means: [f64; 2],
    /// Standard deviation of each lot.
    pub deviations: [f64; 2],
    /// Mean of the second lot less that of the first.
    pub difference: f64,
    /// How well it is computed, where that is not in the scatter of the grains.
    pub own_error: f64,
    /// Its interval at 95 %, that of Behrens and Fisher: the lots may vary by different amounts. It is at least as wide as
    /// `own_error` to both sides. `null` where a lot does not vary.
    pub difference_interval: Option<[f64; 2]>,
    /// Effect size d of Cohen 1988 for lots that vary by different amounts: the difference over the root of the mean of
    /// both variances, whatever the sizes of the lots. `null` where neither varies, or where the difference is below
    /// `own_error`.
    pub effect: Option<f64>,
    /// Its interval at 95 %, by the same law as that of the difference: both hold zero or neither does. `null` where a
    /// lot does not vary, or there is no effect.
    pub effect_interval: Option<[f64; 2]>,
}

impl Comparison {
    /// Whether the difference is below how well it is computed.
    pub(crate) fn is_below_own_error(&self) -> bool {
        self.difference.abs() < self.own_error
    }
}

/// Compares two lots by every measure that at least two grains of each have.
pub(crate) fn compare(first: &Lot, second: &Lot) -> Vec<Comparison> {
    let columns = first.names.iter().enumerate();
    columns
        .filter_map(|(own, name)| {
            let other = second.names.iter().position(|other| other == name)?;
            of_measure(name, [first.known(own), second.known(other)])
        })
        .collect()
}

fn of_measure(name: &str, values: [Vec<f64>; 2]) -> Option<Comparison> {
    let lots = [sample(&values[0])?, sample(&values[1])?];
    let deviations = lots.map(|lot| lot.deviation);
    let difference = lots[1].mean - lots[0].mean;
    let scale = deviations[0].hypot(deviations[1]) / SQRT_2;
    let [one, other] = [0, 1].map(|i| shared_error(name, &lots[i]));
    let own_error = one.hypot(other);
    let is_effect = difference.abs() >= own_error && scale > 0.0;
    let found = intervals(lots);
    Some(Comparison {
        measure: name.into(),
        counts: lots.map(|lot| lot.count),
        means: lots.map(|lot| lot.mean),
        deviations,
        difference,
        own_error,
        difference_interval: found.map(|found| {
            let [low, high] = found.difference;
            [
                low.min(difference - own_error),
                high.max(difference + own_error),
            ]
        }),
        effect: is_effect.then_some(difference / scale),
        effect_interval: found.filter(|_| is_effect).map(|found| found.effect),
    })
}

/// How well the figures of a lot are computed, as far as that is alike for all its grains and so no better in their mean: what differs from
/// grain to grain makes figures scatter. Other errors that are alike, of the scanner or the fit, are so in both lots, and cancel.
fn shared_error(measure: &str, lot: &Sample) -> f64 {
    let error = computed_to(measure, lot.mean);
    // Squares may be beyond the range of numbers.
    match error > lot.deviation {
        true => (error - lot.deviation).sqrt() * (error + lot.deviation).sqrt(),
        false => 0.0,
    }
}

fn sample(values: &[f64]) -> Option<Sample> {
    let (mean, deviation) = moments(values);
    Some(Sample {
        count: values.len(),
        mean,
        deviation: deviation?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn lot(values: &[f64]) -> Lot {
        Lot {
            names: vec!["area".into()],
            values: vec![values.iter().copied().map(Some).collect()],
            ..Lot::default()
        }
    }

    #[test]
    fn two_lots_differ_as_worked_out_by_hand() {
        // Means 3 and 6; variances 2.5 and 10.
        let found = compare(
            &lot(&[1.0, 2.0, 3.0, 4.0, 5.0]),
            &lot(&[2.0, 4.0, 6.0, 8.0, 10.0, 6.0]),
        );
        let [area] = found.as_slice() else {
            panic!("{found:?}");
        };
        assert_eq!((area.difference, area.counts), (3.0, [5, 6]));
        // The variances are 2.5 and 8, of the mean 5.25.
        assert_relative_eq!(
            area.effect.unwrap(),
            3.0 / 5.25_f64.sqrt(),
            max_relative = 1e-12
        );
        let back = compare(
            &lot(&[2.0, 4.0, 6.0, 8.0, 10.0, 6.0]),
            &lot(&[1.0, 2.0, 3.0, 4.0, 5.0]),
        );
        for (there, back) in [
            (area.difference_interval, back[0].difference_interval),
            (area.effect_interval, back[0].effect_interval),
        ] {
            let ([low, high], [other_low, other_high]) = (there.unwrap(), back.unwrap());
            assert_relative_eq!(low, -other_high, max_relative = 1e-6);
            assert_relative_eq!(high, -other_low, max_relative = 1e-6);
        }
    }

    #[test]
    fn where_a_lot_does_not_vary_no_interval_is_told() {
        let found = compare(&lot(&[1.0, 1.0]), &lot(&[2.0, 2.0]));
        assert_eq!((found[0].difference, found[0].effect), (1.0, None));
        assert!(compare(&lot(&[1.0]), &lot(&[2.0, 3.0])).is_empty());
        // Whose sums are rounded.
        let found = compare(&lot(&[0.1; 3]), &lot(&[0.1; 7]));
        assert_eq!((found[0].difference, found[0].effect), (0.0, None));
        assert_eq!(found[0].deviations, [0.0, 0.0]);
        let found = compare(&lot(&[1.0, 1.0]), &lot(&[2.0, 4.0]));
        assert_eq!(found[0].effect, Some(2.0));
        let intervals = (found[0].difference_interval, found[0].effect_interval);
        assert_eq!(intervals, (None, None));
    }

    /// Two lots of five grains near one, an amount apart, of standard deviation 1.58 times the step.
    fn nearly_alike(apart: f64, step: f64) -> Comparison {
        let lots = [0.0, apart].map(|more| {
            let values = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|x| 1.0 + more + step * x);
            lot(&values)
        });
        compare(&lots[0], &lots[1]).remove(0)
    }

    #[test]
    fn what_is_below_how_well_it_is_computed_is_no_effect() {
        // The root of two squares of 1e-4 is 1.414e-4.
        for sign in [1.0, -1.0] {
            let found = nearly_alike(sign * 1.4e-4, 1e-7);
            assert!(found.is_below_own_error());
            assert_eq!((found.effect, found.effect_interval), (None, None));
            let [low, high] = found.difference_interval.unwrap();
            assert_relative_eq!(low, sign * 1.4e-4 - 1.414e-4, epsilon = 1e-7);
            assert_relative_eq!(high, sign * 1.4e-4 + 1.414e-4, epsilon = 1e-7);
            let found = nearly_alike(sign * 1.43e-4, 1e-7);
            assert!(!found.is_below_own_error() && found.effect_interval.is_some());
            assert!(found.effect.unwrap() * sign > 100.0);
            let ends = found.difference_interval.unwrap();
            assert!(ends.iter().all(|end| end * sign > 0.0), "{ends:?}");
        }
    }

    #[test]
    fn errors_that_scatter_are_in_the_interval_as_it_is() {
        assert_eq!(nearly_alike(1e-5, 1e-4).own_error, 0.0);
        // The standard deviation is .79e-4.
        let expected = (2.0 * (1.0 - 0.625_f64 * 1.0)).sqrt() * 1e-4;
        assert_relative_eq!(
            nearly_alike(0.0, 5e-5).own_error,
            expected,
            max_relative = 1e-6
        );
    }

    #[test]
    fn effects_do_not_depend_on_the_unit() {
        let in_unit = |unit: f64| {
            let lots =
                [[1.0, 2.0, 4.0], [3.0, 5.0, 9.0]].map(|values| lot(&values.map(|x| x * unit)));
            compare(&lots[0], &lots[1]).remove(0)
        };
        let known = in_unit(1.0);
        for unit in [1e-181, 1e181] {
            let found = in_unit(unit);
            assert_relative_eq!(
                found.effect.unwrap(),
                known.effect.unwrap(),
                max_relative = 1e-12
            );
            let ends = |found: Comparison| found.difference_interval.unwrap();
            let [low, high] = ends(found);
            let expected = ends(known.clone()).map(|end| end * unit);
            assert_relative_eq!(low, expected[0], max_relative = 1e-9);
            assert_relative_eq!(high, expected[1], max_relative = 1e-9);
        }
    }
}
