//! Points that stand alone: far from the estimate, and far from what their neighbours say of it.

use super::cloud::Cloud;
use super::outcome::{Estimate, spare};
use super::posterior::Posterior;
use super::spectrum_fit::SpectrumFit;
use crate::fit::points::neighbours::Neighbours;
use crate::fit::prepare::Sample;
use crate::spread::{robust_deviation, upper_median};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Rounds of leaving out outliers.
pub(super) const ROUNDS: usize = 5;

/// Neighbours that a point is compared with.
pub(super) const NEIGHBOURS: usize = 8;

/// A point is an outlier when its residual differs from the median of its neighbours' by more than this many
/// standard deviations of such differences, of all points, of the [`VICINITY`] nearest and of as many alike in spacing (told by
/// their medians, so that outliers do not hide themselves) ...
const DEVIATIONS: f64 = 8.0;

/// Points near by that tell how rough the surface is there, and points with neighbours as far off, that tell how much what is
/// not followed differs over such distances: where a cloud is thin, more than where it is dense.
const VICINITY: usize = 32;

/// ... and by more than this share of the mean radius ...
const LEAST: f64 = 0.01;

/// ... unless so many neighbours stand off on the same side: that is an edge.
pub(super) const COMPANY: usize = 2;

/// A stray is off the estimate that was made without it by more than this many standard deviations of what that tells of a point
/// there.
const UNEXPECTED: f64 = 5.0;

/// Positions of the points of a cloud that stand alone, ascending.
pub(super) fn alone(posterior: &Posterior<'_>, fit: &SpectrumFit) -> Vec<usize> {
    // Errors of predictions from all other points, were the points spread evenly.
    let spare = spare(&fit.unlearnt, posterior.cloud.len() as f64);
    let cloud = posterior.cloud;
    let residuals = posterior.residuals(&fit.coefficients).into_iter();
    let errors = residuals.zip(&cloud.directions);
    let errors = errors.map(|(e, n)| e / spare * cloud.along_normal(n));
    outliers(&cloud.directions, &errors.collect::<Vec<_>>())
}

/// Of the samples that an estimate has left out, one round after the other, the positions of those that are strays, ascending;
/// `None` if all are. The others have [`COMPANY`] among their neighbours that were left out on the same side, or are not
/// [unexpected](UNEXPECTED), as where points are thin.
pub(super) fn strays(samples: &[Sample], estimate: &Estimate) -> Option<Vec<usize>> {
    let cloud = &estimate.cloud;
    let mapped = Cloud::mapped(samples, cloud.stretch, 1.0);
    let (directions, measured): (Vec<_>, Vec<_>) = mapped.into_iter().unzip();
    let are_kept = cloud.holds(samples);
    let left_out: Vec<usize> = (0..samples.len()).filter(|&at| !are_kept[at]).collect();
    let at: Vec<Vector3<f64>> = left_out.iter().map(|&at| directions[at]).collect();
    let fitted = estimate.stretched_radii(&at);
    let off = left_out.iter().zip(fitted);
    let off: HashMap<usize, f64> = off.map(|(&at, r)| (at, measured[at] - r)).collect();
    let posterior = estimate.posterior();
    let variances = estimate.given(&posterior).directional_variances(&at);
    let noise = estimate.spectrum.noise().powi(2);
    let expected = variances.iter().zip(&at);
    let expected = expected.map(|(v, n)| cloud.mean * (v + cloud.of_radius(n, noise)).sqrt());
    let neighbours = Neighbours::new(&directions);
    let keeps_company = |at: usize| {
        let near = neighbours.nearest(&directions[at], NEIGHBOURS + 1);
        let side = |at| off.get(at).map(|off| off.is_sign_positive());
        let alike = near.iter().filter(|&other| side(other) == side(&at));
        alike.count() > COMPANY
    };
    let strays = left_out.iter().copied().zip(expected);
    let strays: Vec<usize> = strays
        .filter(|(at, expected)| off[at].abs() > UNEXPECTED * expected && !keeps_company(*at))
        .map(|(at, _)| at)
        .collect();
    (strays.len() < left_out.len()).then_some(strays)
}

/// Positions of the outliers among points with these residuals, ascending.
fn outliers(directions: &[Vector3<f64>], residuals: &[f64]) -> Vec<usize> {
    // A contrast is at most twice the largest residual: mostly there is nothing to look for.
    let spread = robust_deviation(residuals.iter().copied());
    let limit = (DEVIATIONS * spread).max(LEAST);
    if !residuals.iter().any(|e| e.abs() > 0.5 * limit) {
        return Vec::new();
    }
    let neighbours = Neighbours::new(directions);
    let around: Vec<Vec<usize>> = directions
        .iter()
        .enumerate()
        .map(|(own, n)| {
            let mut near = neighbours.nearest(n, NEIGHBOURS + 1);
            near.retain(|&other| other != own);
            near
        })
        .collect();
    let contrasts: Vec<f64> = around
        .iter()
        .zip(residuals)
        .map(|(near, residual)| {
            let mut near: Vec<f64> = near.iter().map(|&other| residuals[other]).collect();
            residual - upper_median(&mut near).unwrap_or(0.0)
        })
        .collect();
    let limit = (DEVIATIONS * robust_deviation(contrasts.iter().copied())).max(LEAST);
    let exceeds = |at: usize, others: &[usize]| {
        let others = others.iter().map(|&other| contrasts[other]);
        contrasts[at].abs() > DEVIATIONS * robust_deviation(others)
    };
    let mut stands_off: Vec<bool> = (0..contrasts.len())
        .map(|at| {
            contrasts[at].abs() > limit
                && exceeds(at, &neighbours.nearest(&directions[at], VICINITY))
        })
        .collect();
    if stands_off.contains(&true) {
        let by_spacing = by_spacing(directions, &around);
        for (rank, &at) in by_spacing.iter().enumerate() {
            stands_off[at] = stands_off[at] && exceeds(at, alike(&by_spacing, rank));
        }
    }
    (0..residuals.len())
        .filter(|&at| stands_off[at])
        .filter(|&at| {
            let keeps_company = |&&other: &&usize| {
                stands_off[other] && contrasts[other].signum() == contrasts[at].signum()
            };
            around[at].iter().filter(keeps_company).count() < COMPANY
        })
        .collect()
}

/// The points by the distance of the farthest of their neighbours, nearest first.
fn by_spacing(directions: &[Vector3<f64>], around: &[Vec<usize>]) -> Vec<usize> {
    let spacings = directions.iter().zip(around).map(|(n, near)| {
        let distances = near.iter().map(|&other| (directions[other] - n).norm());
        distances.fold(0.0, f64::max)
    });
    let mut order: Vec<(f64, usize)> = spacings.zip(0..).collect();
    order.sort_by(|one, other| one.0.total_cmp(&other.0));
    order.into_iter().map(|(_, at)| at).collect()
}

/// The [`VICINITY`] points in this order about one of them.
fn alike(order: &[usize], rank: usize) -> &[usize] {
    let last = order.len().saturating_sub(VICINITY);
    let first = rank.saturating_sub(VICINITY / 2).min(last);
    &order[first..order.len().min(first + VICINITY)]
}

#[cfg(test)]
mod tests;
