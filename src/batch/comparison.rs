//! Two lots of grains beside each other.

use super::population::moments;
use super::table::Lot;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Share of intervals that hold the truth.
const CONFIDENCE: f64 = 0.95;

/// Two-sided quantile of the normal distribution at that share.
const NORMAL: f64 = 1.959_963_984_540_054;

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
    /// Its interval at 95 %, that of Welch 1947: the lots may vary by different amounts. `null` where neither varies.
    pub difference_interval: Option<[f64; 2]>,
    /// Effect size g of Hedges 1981: the difference over the pooled standard deviation, without the bias of small lots.
    /// `null` likewise.
    pub effect: Option<f64>,
    /// Its interval at 95 %, by the normal approximation of Hedges and Olkin 1985.
    pub effect_interval: Option<[f64; 2]>,
}

/// Compares two lots by every measure that at least two grains of each have.
pub(crate) fn compare(first: &Lot, second: &Lot) -> Vec<Comparison> {
    let columns = first.names.iter().zip(&first.values);
    columns
        .filter_map(|(name, values)| {
            let at = second.names.iter().position(|other| other == name)?;
            of_measure(name, values, &second.values[at])
        })
        .collect()
}

fn of_measure(name: &str, first: &[f64], second: &[f64]) -> Option<Comparison> {
    let ((mean, deviation), (other_mean, other_deviation)) = (moments(first), moments(second));
    let (deviation, other_deviation) = (deviation?, other_deviation?);
    let [count, other_count] = [first, second].map(|values| values.len() as f64);
    let difference = other_mean - mean;

    let [part, other_part] = [(deviation, count), (other_deviation, other_count)]
        .map(|(deviation, count)| deviation * deviation / count);
    let freedom = (part + other_part).powi(2)
        / (part * part / (count - 1.0) + other_part * other_part / (other_count - 1.0));
    let difference_interval = StudentsT::new(0.0, 1.0, freedom).ok().map(|student| {
        let half = student.inverse_cdf(0.5 + CONFIDENCE / 2.0) * (part + other_part).sqrt();
        [difference - half, difference + half]
    });

    let pooled_freedom = count + other_count - 2.0;
    let squares = (count - 1.0) * deviation.powi(2) + (other_count - 1.0) * other_deviation.powi(2);
    let pooled = (squares / pooled_freedom).sqrt();
    let unbiased = 1.0 - 3.0 / (4.0 * pooled_freedom - 1.0);
    let effect = (pooled > 0.0).then_some(unbiased * difference / pooled);
    let effect_interval = effect.map(|effect| {
        let both = count + other_count;
        let variance = both / (count * other_count) + effect * effect / (2.0 * both);
        let half = NORMAL * variance.sqrt();
        [effect - half, effect + half]
    });
    Some(Comparison {
        measure: name.into(),
        counts: [first.len(), second.len()],
        means: [mean, other_mean],
        deviations: [deviation, other_deviation],
        difference,
        difference_interval,
        effect,
        effect_interval,
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
        // Means 3 and 6; variances 2.5 and 10; five each.
        let found = compare(
            &lot(&[1.0, 2.0, 3.0, 4.0, 5.0]),
            &lot(&[2.0, 4.0, 6.0, 8.0, 10.0]),
        );
        let [area] = found.as_slice() else {
            panic!("{found:?}");
        };
        assert_eq!((area.difference, area.counts), (3.0, [5, 5]));
        // Welch: 2.5² / (0.5² / 4 + 2² / 4) = 5.88 degrees of freedom, of which t is 2.4593; times sqrt(2.5).
        let [low, high] = area.difference_interval.unwrap();
        assert_relative_eq!(high - 3.0, 2.4593 * 2.5_f64.sqrt(), max_relative = 1e-3);
        assert_relative_eq!(low + high, 6.0, epsilon = 1e-9);
        // Pooled deviation 2.5; the correction is 1 - 3 / 31.
        let effect = area.effect.unwrap();
        assert_relative_eq!(effect, 1.2 * 28.0 / 31.0, max_relative = 1e-12);
        let half = 1.959_964 * (0.4 + effect * effect / 20.0_f64).sqrt();
        let [low, high] = area.effect_interval.unwrap();
        assert_relative_eq!(high - low, 2.0 * half, max_relative = 1e-6);
    }

    #[test]
    fn lots_that_do_not_vary_have_a_difference_and_no_effect() {
        let found = compare(&lot(&[1.0, 1.0]), &lot(&[2.0, 2.0]));
        assert_eq!((found[0].difference, found[0].effect), (1.0, None));
        assert!(compare(&lot(&[1.0]), &lot(&[2.0, 3.0])).is_empty());
        // Whose sums are rounded.
        let found = compare(&lot(&[0.1; 3]), &lot(&[0.1; 7]));
        assert_eq!((found[0].difference, found[0].effect), (0.0, None));
        assert_eq!(found[0].deviations, [0.0, 0.0]);
    }
}
