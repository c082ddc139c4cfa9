//! One level of a search: all segments of one partition, at every degree at once.

use super::reference::Reference;
use super::search::{Candidate, Rejection};
use super::segment::{HeldOut, Level, SegmentFit, Workspace};
use crate::sphere::{GaussLegendre, coefficient_count};
use rayon::prelude::*;
use std::f64::consts::PI;

/// A candidate that misses a held-out sample, or tears at a seam, by more than this fraction of the
/// radius is no model of the grain, whatever its mean error. Between the samples the truth can be
/// missed by a little more: of 1200 candidates on synthetic grains (all samplings, with and without
/// noise) those that pass miss it by at most 8.3 % anywhere; with 10 % here it would be 11.3 %.
const LARGEST_MISS: f64 = 0.08;

/// All segments of one partition.
#[derive(Clone)]
pub(crate) struct FittedLevel {
    pub(crate) segments: Vec<SegmentFit>,
}

impl FittedLevel {
    /// Fits every segment of a level.
    pub(crate) fn new(level: &Level<'_>) -> Self {
        let segments = (0..level.partition.segments())
            .into_par_iter()
            .map_init(
                || Workspace::new(level.basis.degree()),
                |workspace, segment| level.fit(segment, workspace),
            )
            .collect();
        Self { segments }
    }

    /// What becomes of the level at the given degree.
    pub(crate) fn candidate(
        &self,
        level: &Level<'_>,
        degree: usize,
        reference: &Reference,
    ) -> Candidate {
        let held_out = self
            .segments
            .iter()
            .map(|segment| segment.at_most(degree).held_out)
            .fold(HeldOut::default(), |sum, part| HeldOut {
                squared: sum.squared + part.squared,
                worst: sum.worst.max(part.worst),
                count: sum.count + part.count,
            });
        let reduced_segments = self
            .segments
            .iter()
            .filter(|segment| segment.degrees.len() <= degree)
            .count();
        let tear = self.largest_tear(level, degree);
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
        let [area, volume] = self.area_and_volume(level, degree);
        Candidate {
            degree,
            segments: self.segments.len(),
            coefficients: self.segments.len() * coefficient_count(degree),
            reduced_segments,
            area_error: Some(area / reference.area - 1.0),
            volume_error: Some(volume / reference.volume - 1.0),
            heldout_rms: Some((held_out.squared / held_out.count.max(1) as f64).sqrt()),
            rejected,
        }
    }

    /// The largest difference, relative to the radius, between the expansions that meet at a corner
    /// or in the middle of a border.
    fn largest_tear(&self, level: &Level<'_>, degree: usize) -> f64 {
        let k = level.partition.per_angle();
        let columns = 2 * k;
        let mut least = vec![f64::INFINITY; (2 * k + 1) * columns];
        let mut most = vec![f64::NEG_INFINITY; least.len()];
        let mut values = [0.0; 9];
        for (segment, fit) in self.segments.iter().enumerate() {
            let rectangle = level.partition.rectangle(segment);
            let directions = rectangle.lattice();
            let coefficients = &fit.at_most(degree).coefficients;
            level
                .basis
                .values(&rectangle.cap(), coefficients, &directions, &mut values);
            for (i, &value) in values.iter().enumerate() {
                let row = 2 * (segment / k) + i / 3;
                let column = match row {
                    0 => 0,
                    row if row == 2 * k => 0,
                    _ => (2 * (segment % k) + i % 3) % columns,
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
        let middle = variances.len() / 2;
        if variances.is_empty() {
            return 0.0;
        }
        *variances.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Area and volume by Gauss quadrature per segment, to 1e-6 or better: enough to compare with a
    /// reference surface, whose own error is 1e-4 to 1e-2.
    fn area_and_volume(&self, level: &Level<'_>, degree: usize) -> [f64; 2] {
        let k = level.partition.per_angle();
        // r^3 sin(theta) is a trigonometric polynomial of degree 3L + 1; n nodes on an interval of
        // width h integrate degree d to rounding once n is well above d h / 4.
        let nodes = |width: f64| 4 + ((3 * degree + 1) as f64 * width / 4.0).ceil() as usize;
        let (polar, azimuthal) = (
            GaussLegendre::new(nodes(PI / k as f64)),
            GaussLegendre::new(nodes(2.0 * PI / k as f64)),
        );
        let mut sums = [0.0; 2];
        let mut values = Vec::new();
        for (segment, fit) in self.segments.iter().enumerate() {
            let rectangle = level.partition.rectangle(segment);
            let nodes = rectangle.nodes(&polar, &azimuthal);
            let directions: Vec<_> = nodes.iter().map(|(n, _)| [n.x, n.y, n.z, 0.0]).collect();
            let cap = rectangle.cap();
            let coefficients = &fit.at_most(degree).coefficients;
            values.resize(nodes.len(), [0.0; 2]);
            level
                .basis
                .values_and_slopes(&cap, coefficients, &directions, &mut values);
            for (&[r, slope_squared], (_, weight)) in values.iter().zip(&nodes) {
                sums[0] += weight * r.abs() * (r * r + slope_squared).sqrt();
                sums[1] += weight * r * r * r / 3.0;
            }
        }
        sums
    }
}
