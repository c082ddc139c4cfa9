//! One level of a search: all segments of one partition, at every degree at once.

use super::held_out::HeldOut;
use super::row::rows;
use super::segment::{DegreeFit, Level, SegmentFit, Workspace};
use crate::fit::candidate::{Candidate, Rejection};
use crate::fit::prepare::Reference;
use crate::sphere::coefficient_count;
use crate::spread::upper_median;
use rayon::prelude::*;

/// A candidate that misses a held-out sample, or tears at a seam, by more than this fraction of the
/// radius is no model of the grain, whatever its mean error. Between the samples the truth can be
/// missed by a little more: of 1200 candidates on synthetic grains (all samplings, with and without
/// noise) those that pass miss it by at most 8.3 % anywhere; with 10 % here it would be 11.3 %.
pub(crate) const LARGEST_MISS: f64 = 0.08;

/// All segments of one partition.
#[derive(Clone)]
pub(crate) struct FittedLevel {
    pub(crate) segments: Vec<SegmentFit>,
}

impl FittedLevel {
    /// Fits every segment of a level.
    pub(crate) fn new(level: &Level<'_>) -> Self {
        let rows = rows(level.partition, level.basis);
        let segments = (0..level.partition.segments())
            .into_par_iter()
            .map_init(
                || Workspace::new(level.basis.degree()),
                |workspace, segment| level.fit(segment, &rows, workspace),
            )
            .collect();
        Self { segments }
    }

    /// What becomes of the level at the given degree.
    pub(crate) fn candidate(&self, degree: usize, reference: &Reference) -> Candidate {
        let held_out = self
            .at(degree)
            .map(|fit| fit.held_out)
            .fold(HeldOut::default(), HeldOut::and);
        let reduced_segments = self
            .segments
            .iter()
            .filter(|segment| segment.degrees.len() <= degree)
            .count();
        let tear = self.largest_tear(degree);
        let rejected = if reduced_segments == self.segments.len() {
            Some(Rejection::Unsupported { degree })
        } else if held_out.worst > LARGEST_MISS {
            Some(Rejection::Misses {
                worst: held_out.worst,
            })
        } else if tear > LARGEST_MISS {
            Some(Rejection::Tears { by: tear })
        } else {
            None
        };
        let area: f64 = self.at(degree).map(|fit| fit.area).sum();
        let volume: f64 = self.at(degree).map(|fit| fit.volume).sum();
        Candidate {
            degree,
            segments: self.segments.len(),
            coefficients: self.segments.len() * coefficient_count(degree),
            reduced_segments,
            area_error: Some(area / reference.area - 1.0),
            volume_error: Some(volume / reference.volume - 1.0),
            heldout_rms: Some((held_out.squared / held_out.count.max(1) as f64).sqrt()),
            estimate_rms: None,
            rejected,
        }
    }

    /// The segments' fits at the given degree, or the largest below that each supports.
    fn at(&self, degree: usize) -> impl Iterator<Item = &DegreeFit> {
        self.segments
            .iter()
            .map(move |segment| segment.at_most(degree))
    }

    /// The largest difference, relative to the radius, between the expansions that meet at a corner
    /// or in the middle of a border.
    fn largest_tear(&self, degree: usize) -> f64 {
        let k = self.segments.len().isqrt();
        let columns = 2 * k;
        let mut least = vec![f64::INFINITY; (2 * k + 1) * columns];
        let mut most = vec![f64::NEG_INFINITY; least.len()];
        for (segment, fit) in self.at(degree).enumerate() {
            for (i, &value) in fit.lattice.iter().enumerate() {
                let row = 2 * (segment / k) + i / 3;
                let is_pole = row == 0 || row == 2 * k;
                let column = if is_pole {
                    0
                } else {
                    (2 * (segment % k) + i % 3) % columns
                };
                let at = row * columns + column;
                least[at] = least[at].min(value);
                most[at] = most[at].max(value);
            }
        }
        least
            .iter()
            .zip(&most)
            .filter(|(least, most)| least < most)
            .map(|(least, most)| 2.0 * (most - least) / (most + least).abs())
            .fold(0.0, f64::max)
    }

    /// The variance of the samples round the fit: the median over the segments of the residual
    /// variance at the largest degree each supports, so that a few creases do not count as noise.
    pub(crate) fn residual_variance(&self) -> f64 {
        let mut variances: Vec<f64> = self
            .segments
            .iter()
            .filter_map(|segment| segment.degrees.last()?.residual_variance)
            .collect();
        upper_median(&mut variances).unwrap_or(0.0)
    }
}
