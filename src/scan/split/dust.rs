//! What is too small for a grain.

use crate::spread::middle_of_sum;

/// Points of the smallest grain of a cloud.
pub(super) const LEAST_POINTS: usize = 30;

/// Size of the smallest grain, as a share of that of the grain in which the middle of all that is found lies.
const LEAST_SHARE: f64 = 0.02;

/// What is large enough for a grain, and the dust: what is below the least size, or below the share of a typical one. A
/// size is an area, or what grows as one: the number of points of a cloud does.
pub(super) fn without_dust<T>(
    all: impl Iterator<Item = T>,
    least: f64,
    size: impl Fn(&T) -> f64,
) -> (Vec<T>, Vec<T>) {
    let (large, mut dust): (Vec<T>, Vec<T>) = all.partition(|one| size(one) >= least);
    let typical = middle_of_sum(large.iter().map(&size).collect());
    let least = LEAST_SHARE * typical.unwrap_or(0.0);
    let (large, small): (Vec<T>, Vec<T>) = large.into_iter().partition(|one| size(one) >= least);
    dust.extend(small);
    (large, dust)
}
