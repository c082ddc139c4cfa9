//! Points that stand alone: far from the estimate, and far from what their neighbours say of it.

use super::cloud::Cloud;
use super::outcome::{Estimate, spare};
use super::posterior::Posterior;
use super::spectrum_fit::SpectrumFit;
use crate::fit::neighbours::Neighbours;
use crate::fit::prepare::Sample;
use crate::spread::{median, robust_deviation};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Rounds of leaving out outliers.
pub(super) const ROUNDS: usize = 5;

/// Neighbours that a point is compared with.
pub(super) const NEIGHBOURS: usize = 8;

/// A point is an outlier when its residual differs from the median of its neighbours' by more than this many
/// standard deviations of such differences, of all points and of the [`VICINITY`] nearest (told by their medians, so
/// that outliers do not hide themselves) ...
const DEVIATIONS: f64 = 8.0;

/// Points near by that tell how rough the surface is there.
const VICINITY: usize = 32;

/// ... and by more than this share of the mean radius ...
const LEAST: f64 = 0.01;

/// ... unless so many neighbours stand off on the same side: that is an edge.
pub(super) const COMPANY: usize = 2;

/// Positions of the points of a cloud that stand alone, ascending.
pub(super) fn alone(posterior: &Posterior<'_>, fit: &SpectrumFit) -> Vec<usize> {
    // Errors of predictions from all other points, were the points spread evenly.
    let spare = spare(&fit.unlearnt, posterior.cloud.len() as f64);
    let mut errors = posterior.residuals(&fit.coefficients);
    errors.iter_mut().for_each(|e| *e /= spare);
    outliers(&posterior.cloud.directions, &errors)
}

/// Of the samples that an estimate has left out, one round after the other, the positions of those that are strays, ascending;
/// `None` if all are. The others have [`COMPANY`] among their neighbours that were left out on the same side.
pub(super) fn strays(samples: &[Sample], estimate: &Estimate) -> Option<Vec<usize>> {
    let cloud = &estimate.cloud;
    let mapped = Cloud::mapped(samples, cloud.stretch, 1.0);
    let (directions, measured): (Vec<_>, Vec<_>) = mapped.into_iter().unzip();
    let mut kept = cloud.directions.iter().peekable();
    let is_left_out = |&at: &usize| kept.next_if_eq(&&directions[at]).is_none();
    let left_out: Vec<usize> = (0..samples.len()).filter(is_left_out).collect();
    let at = left_out.iter().map(|&at| directions[at]);
    let fitted = estimate.stretched_radii(&at.collect::<Vec<_>>());
    let sides = left_out.iter().zip(fitted);
    let sides: HashMap<usize, bool> = sides.map(|(&at, r)| (at, measured[at] > r)).collect();
    let neighbours = Neighbours::new(&directions);
    let is_stray = |at: &usize| {
        let near = neighbours.nearest(&directions[*at], NEIGHBOURS + 1);
        let alike = near
            .iter()
            .filter(|other| sides.get(other) == sides.get(at));
        alike.count() <= COMPANY
    };
    let strays: Vec<usize> = left_out.iter().copied().filter(is_stray).collect();
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
            residual - median(&mut near).unwrap_or(0.0)
        })
        .collect();
    let limit = (DEVIATIONS * robust_deviation(contrasts.iter().copied())).max(LEAST);
    let stands_off: Vec<bool> = (0..contrasts.len())
        .map(|at| {
            contrasts[at].abs() > limit && {
                let near = neighbours.nearest(&directions[at], VICINITY);
                let near = near.into_iter().map(|other| contrasts[other]);
                contrasts[at].abs() > DEVIATIONS * robust_deviation(near)
            }
        })
        .collect();
    (0..residuals.len())
        .filter(|&at| stands_off[at])
        .filter(|&at| {
            let alike = |&&other: &&usize| {
                stands_off[other] && contrasts[other].signum() == contrasts[at].signum()
            };
            around[at].iter().filter(alike).count() < COMPANY
        })
        .collect()
}

#[cfg(test)]
mod tests;
