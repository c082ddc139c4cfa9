//! Middle and spread of values, which a few wild ones do not move, and of points.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Standard deviation over median absolute deviation of a normal distribution.
pub(crate) const PER_MEDIAN: f64 = 1.4826;

/// Standard deviation of values round zero, told by the median of their sizes.
pub(crate) fn robust_deviation(values: impl Iterator<Item = f64>) -> f64 {
    let mut sizes: Vec<f64> = values.map(f64::abs).collect();
    PER_MEDIAN * upper_median(&mut sizes).unwrap_or(0.0)
}

/// Standard deviations from the middle beyond which a value does not count.
const COUNTS: f64 = 3.5;

/// Rounds in which the middle settles: each takes it nearer by a factor of four or so.
const MIDDLE_ROUNDS: usize = 20;

/// The middle of values near zero that those far off do not move, and their standard deviation about zero, told by the
/// median: Tukey's biweight.
pub(crate) fn biweight(values: &[f64]) -> (f64, f64) {
    let deviation = robust_deviation(values.iter().copied());
    let limit = (COUNTS * deviation).max(f64::MIN_POSITIVE);
    let mut middle = 0.0;
    for _ in 0..MIDDLE_ROUNDS {
        let (mut sum, mut weights) = (0.0, f64::MIN_POSITIVE);
        for value in values {
            let share = (value - middle) / limit;
            let weight = (1.0 - share * share).max(0.0).powi(2);
            sum += weight * value;
            weights += weight;
        }
        middle = sum / weights;
    }
    (middle, deviation)
}

/// The mean of points, and their covariance about it.
pub(crate) fn covariance(
    points: impl ExactSizeIterator<Item = Vector3<f64>> + Clone,
) -> (Vector3<f64>, Matrix3<f64>) {
    let count = points.len() as f64;
    let mean = points.clone().sum::<Vector3<f64>>() / count;
    let squares = points.map(|point| (point - mean) * (point - mean).transpose());
    (mean, squares.sum::<Matrix3<f64>>() / count)
}

/// Iterations allowed for the eigenvalues of a 3 x 3 matrix, which takes fewer than ten.
const MAX_EIGEN_ITERATIONS: usize = 100;

/// Eigenvalues of a symmetric matrix, ascending, and unit eigenvectors in the columns; `None` where it is not finite.
pub(crate) fn principal(matrix: &Matrix3<f64>) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let is_finite = matrix.iter().all(|entry| entry.is_finite());
    is_finite.then_some(())?;
    let eigen = SymmetricEigen::try_new(*matrix, f64::EPSILON, MAX_EIGEN_ITERATIONS)?;
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let columns = order.map(|i| eigen.eigenvectors.column(i).into_owned());
    Some((
        Vector3::from(order.map(|i| eigen.eigenvalues[i])),
        Matrix3::from_columns(&columns),
    ))
}

/// The median, the upper one of two.
pub(crate) fn upper_median(values: &mut [f64]) -> Option<f64> {
    in_order(values, values.len() / 2)
}

/// The value before which so many of them come.
fn in_order(values: &mut [f64], at: usize) -> Option<f64> {
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(at, f64::total_cmp).1)
}

/// The root of the mean of the squares; zero of none.
pub(crate) fn root_mean_square(values: impl IntoIterator<Item = f64>) -> f64 {
    let squares = values.into_iter().map(|x| x * x);
    let (count, sum) = squares.fold((0.0, 0.0), |(count, sum), x| (count + 1.0, sum + x));
    (sum / f64::max(count, 1.0)).sqrt()
}

/// The value that a quarter of them are below.
pub(crate) fn lower_quartile(values: &mut [f64]) -> Option<f64> {
    in_order(values, values.len() / 4)
}

/// The value that a quarter of them are above.
pub(crate) fn upper_quartile(values: &mut [f64]) -> Option<f64> {
    in_order(values, 3 * values.len() / 4)
}

/// The number below which a share of sorted ones lies, between neighbours by linear interpolation; of none zero.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (at.floor() as usize, at.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(one), Some(other)) => one + (other - one) * at.fract(),
        _ => 0.0,
    }
}

/// Of values that are not negative the one of which those that are less have half of the sum: many small ones hardly move it.
pub(crate) fn middle_of_sum(mut values: Vec<f64>) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    let half = 0.5 * values.iter().sum::<f64>();
    let mut sum = 0.0;
    values.into_iter().find(|value| {
        sum += value;
        sum >= half
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_deviation_is_told_by_the_median_size() {
        let sizes = [3.0, -1.0, 2.0, -100.0, 0.5];
        assert_eq!(robust_deviation(sizes.into_iter()), 1.4826 * 2.0);
        assert_eq!(upper_median(&mut [4.0, 1.0, 3.0, 2.0]), Some(3.0));
        assert_eq!(upper_median(&mut []), None);
    }

    #[test]
    fn half_of_the_sum_is_below_the_middle() {
        assert_eq!(middle_of_sum(vec![1.0, 5.0, 2.0, 1.0, 3.0]), Some(3.0));
        assert_eq!(middle_of_sum(vec![1.0; 5]), Some(1.0));
        assert_eq!(middle_of_sum(Vec::new()), None);
    }
}
