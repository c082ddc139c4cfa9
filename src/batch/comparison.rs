//! Two lots of grains beside each other.

use super::interval::{Sample, intervals};
use super::population::moments;
use super::table::Lot;
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
    /// Its interval at 95 %, that of Behrens and Fisher: the lots may vary by different amounts. `null` where a lot does
    /// not vary.
    pub difference_interval: Option<[f64; 2]>,
    /// Effect size d of Cohen 1988 for lots that vary by different amounts: the difference over the root of the mean of
    /// both variances, whatever the sizes of the lots. `null` where neither varies.
    pub effect: Option<f64>,
    /// Its interval at 95 %, by the same law as that of the difference: both hold zero or neither does. `null` where a
    /// lot does not vary.
    pub effect_interval: Option<[f64; 2]>,
}

/// Compares two lots by every measure that at least two grains of each have.
pub(crate) fn compare(first: &Lot, second: &Lot) -> Vec<Comparison> {
    let columns = first.names.iter().zip(&first.values);
    columns
        .filter_map(|(name, values)| {
            let at = second.names.iter().position(|other| other == name)?;
            of_measure(name, [values, &second.values[at]])
        })
        .collect()
}

fn of_measure(name: &str, values: [&[f64]; 2]) -> Option<Comparison> {
    let lots = [sample(values[0])?, sample(values[1])?];
    let deviations = lots.map(|lot| lot.deviation);
    let difference = lots[1].mean - lots[0].mean;
    let scale = deviations[0].hypot(deviations[1]) / SQRT_2;
    let found = intervals(lots);
    Some(Comparison {
        measure: name.into(),
        counts: lots.map(|lot| lot.count),
        means: lots.map(|lot| lot.mean),
        deviations,
        difference,
        difference_interval: found.map(|found| found.difference),
        effect: (scale > 0.0).then_some(difference / scale),
        effect_interval: found.map(|found| found.effect),
    })
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
            values: vec![values.into()],
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
