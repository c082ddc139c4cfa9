//! Samples that stand apart from a fitted surface.

use super::refine::{Round, patches};
use crate::fit::samples::Sample;

/// A sample is an outlier when its residual differs from the median of those near by (a sixteenth of
/// a cell) by more than this many standard deviations of the noise ...
const NOISES: f64 = 10.0;

/// ... and by more than this share of the mean radius: what a surface that is not fully refined yet
/// may be off by.
const LEAST: f64 = 0.03;

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
        if near.is_empty() {
            continue;
        }
        let middle = near.len() / 2;
        let median = *near.select_nth_unstable_by(middle, f64::total_cmp).1;
        let apart = |member: &&u32| (residual(member) - median).abs() > limit;
        found.extend(patch.iter().filter(apart).map(|&member| member as usize));
    }
    found.sort_unstable();
    found
}
