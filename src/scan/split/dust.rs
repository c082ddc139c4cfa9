//! What is too small for a grain.

use crate::spread::middle_of_sum;

/// Points of the smallest grain of a cloud.
pub(super) const LEAST_POINTS: usize = 30;

/// Size of the smallest grain, as a share of that of the grain in which the middle of all that is found lies.
const LEAST_SHARE: f64 = 0.02;

/// Grains, and what is too small for one.
pub(super) struct Sorted<T> {
    pub(super) grains: Vec<T>,
    /// What is below the least size.
    pub(super) specks: Vec<T>,
    /// What is not, but below the share of a typical grain.
    pub(super) small: Vec<T>,
}

impl<T> Sorted<T> {
    /// The dust: specks and what is small.
    pub(super) fn dust(&self) -> impl Iterator<Item = &T> {
        self.specks.iter().chain(&self.small)
    }
}

/// Parts grains from dust. A size is an area, or what grows as one: the number of points of a cloud does.
pub(super) fn by_size<T>(
    all: impl Iterator<Item = T>,
    least: f64,
    size: impl Fn(&T) -> f64,
) -> Sorted<T> {
    let (large, specks): (Vec<T>, Vec<T>) = all.partition(|one| size(one) >= least);
    let typical = middle_of_sum(large.iter().map(&size).collect());
    let least = LEAST_SHARE * typical.unwrap_or(0.0);
    let (grains, small) = large.into_iter().partition(|one| size(one) >= least);
    Sorted {
        grains,
        specks,
        small,
    }
}
