//! Grains that are worth a look.

use super::columns::MAIN;
use super::lot::Lot;
use super::own_error::own_error;
use super::statistics::median;
use crate::spread::PER_MEDIAN;
use serde::Serialize;

/// Robust z-score beyond which a grain is worth a look (Iglewicz and Hoaglin 1993).
const OUTLYING: f64 = 3.5;

/// Standard deviation over mean absolute deviation of a normal distribution.
const PER_MEAN: f64 = 1.253_314_137_315_500_3;

/// Grains of the smallest population that has outliers.
const LEAST_GRAINS: usize = 8;

/// A grain that is unlike most others.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub(crate) struct Outlier {
    /// The scan.
    pub path: String,
    /// The measure by which it is.
    pub measure: String,
    /// Its value.
    pub value: f64,
    /// Difference from the median over 1.4826 times the median absolute deviation.
    pub z: f64,
    /// The same as a sentence.
    pub reason: String,
}

/// The grains of a lot that are unlike most others by one of its main measures.
pub(crate) fn outliers_of(lot: &Lot) -> Vec<Outlier> {
    let columns = MAIN
        .iter()
        .filter_map(|(name, _)| lot.names.iter().position(|own| own == name));
    columns
        .flat_map(|at| {
            outliers(
                &lot.names[at],
                &lot.grains,
                &lot.values[at],
                &lot.errors[at],
            )
        })
        .collect()
}

/// The grains that are unlike most others by a measure. Of each grain there are its path, its value, and the standard error of
/// that, as far as they are known.
pub(super) fn outliers(
    measure: &str,
    paths: &[String],
    values: &[Option<f64>],
    errors: &[Option<f64>],
) -> Vec<Outlier> {
    let known: Vec<f64> = values.iter().flatten().copied().collect();
    let middle = median(known.iter().copied());
    let deviation = deviation(known.iter().map(|value| (value - middle).abs()));
    if known.len() < LEAST_GRAINS || deviation <= 0.0 {
        return Vec::new();
    }
    let outlier = |at: usize| {
        let value = values[at]?;
        let off = value - middle;
        let z = off / deviation;
        let error = errors.get(at).copied().flatten();
        let is_beyond_error = off.abs() > own_error(measure, value, error);
        (z.abs() > OUTLYING && is_beyond_error).then(|| Outlier {
            path: paths[at].clone(),
            measure: measure.into(),
            value,
            z,
            reason: format!(
                "its {measure} is {} deviations {} the median",
                times(z.abs()),
                if z > 0.0 { "above" } else { "below" }
            ),
        })
    };
    (0..values.len()).filter_map(outlier).collect()
}

/// More than a thousand are no number that tells anything: the others differ by rounding alone.
fn times(z: f64) -> String {
    match z < 1e3 {
        true => ((z * 10.0).round() / 10.0).to_string(),
        false => "more than 1000".into(),
    }
}

/// Standard deviation of values whose distances from their median are given, told by the median of these; where more than half
/// are alike, by the mean (Iglewicz and Hoaglin 1993).
fn deviation(off: impl ExactSizeIterator<Item = f64> + Clone) -> f64 {
    let middle = median(off.clone());
    match middle > 0.0 {
        true => PER_MEDIAN * middle,
        false => PER_MEAN * off.clone().sum::<f64>() / off.len() as f64,
    }
}
