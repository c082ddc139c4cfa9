//! What lists of numbers are like.

use crate::spread::quantile;

/// Mean and standard deviation (with n - 1).
pub(super) fn moments(values: &[f64]) -> (f64, Option<f64>) {
    let count = values.len() as f64;
    // The mean of equal values is rounded, and they would be told to vary.
    let is_constant = values.windows(2).all(|pair| pair[0] == pair[1]);
    let mean = match values.first() {
        Some(&value) if is_constant => value,
        _ => values.iter().sum::<f64>() / count.max(1.0),
    };
    // Squares of moments of inertia in metres, and of some other figures, are beyond the range of numbers.
    let largest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max((value - mean).abs()));
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let squares: f64 = values
        .iter()
        .map(|value| ((value - mean) / unit).powi(2))
        .sum();
    (
        mean,
        (count > 1.0).then(|| unit * (squares / (count - 1.0)).sqrt()),
    )
}

/// Of an even number of values the mean of the two in the middle.
pub(super) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    quantile(&values, 0.5)
}

/// Correlation (Pearson) over the pairs of which both are known; none of fewer than three, or where one does not vary.
pub(super) fn correlation(one: &[Option<f64>], other: &[Option<f64>]) -> Option<f64> {
    let pairs = one
        .iter()
        .zip(other)
        .filter_map(|(one, other)| Some(((*one)?, (*other)?)));
    let (one, other): (Vec<f64>, Vec<f64>) = pairs.unzip();
    if one.len() < 3 {
        return None;
    }
    let [(mean, deviation), (other_mean, other_deviation)] = [moments(&one), moments(&other)];
    let (deviation, other_deviation) = (deviation?, other_deviation?);
    let products: f64 = one
        .iter()
        .zip(&other)
        .map(|(one, other)| (one - mean) / deviation * ((other - other_mean) / other_deviation))
        .sum();
    let found = products / (one.len() - 1) as f64;
    found.is_finite().then_some(found.clamp(-1.0, 1.0))
}
