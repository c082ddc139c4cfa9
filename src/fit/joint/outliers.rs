//! Samples that stand apart from a fitted surface.

use super::refine::{Round, patches};
use crate::fit::samples::Sample;

/// A sample is an outlier when its residual differs from the median of those near by (a sixteenth of
/// a cell) by more than this many standard deviations of the noise ...
const NOISES: f64 = 10.0;

/// ... and by more than this share of the mean radius: what a surface that is not fully refined yet
/// may be off by.
const LEAST: f64 = 0.03;

/// Samples near by that it takes to tell an outlier.
const FEWEST: usize = 4;

/// Outliers are alone in their patch, or at most this share of it: points that stand apart together
/// are an edge.
const LARGEST_SHARE: f64 = 0.1;

/// Positions of the outliers, ascending.
pub(super) fn outliers(
    round: &Round<'_>,
    samples: &[Sample],
    noise: f64,
    mean_radius: f64,
) -> Vec<usize> {
    let limit = (NOISES * noise).max(LEAST * mean_radius);
    let mut found = Vec::new();
    for patch in patches(&round.system, samples).into_iter().flatten() {
        let residual = |&member: &u32| round.residuals[member as usize];
        let mut near: Vec<f64> = patch.iter().map(residual).collect();
        if near.len() < FEWEST {
            continue;
        }
        let middle = near.len() / 2;
        let median = *near.select_nth_unstable_by(middle, f64::total_cmp).1;
        let is_apart = |member: &&u32| (residual(member) - median).abs() > limit;
        let apart = patch.iter().filter(is_apart);
        let count = apart.clone().count();
        if count == 1 || LARGEST_SHARE * patch.len() as f64 >= count as f64 {
            found.extend(apart.map(|&member| member as usize));
        }
    }
    found.sort_unstable();
    found
}
