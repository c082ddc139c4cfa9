//! Patches of a dense cloud: means of the points of small regions stand for them.
//!
//! A mean over a patch is biased by slope and curvature inside it. One correction removes that: the patch
//! means of the residuals against a first estimate are added to what it says at the patches. These means are taken over
//! six places with the mean and the covariance of the patch's points: they are those over all points but for fourth
//! derivatives, and for how far the points of a patch lean to one side. These places are not on the surface, so the noise is
//! told by points themselves, a few of each patch.

use super::posterior::MOST_FACTORED;
use crate::buckets::Buckets;
use crate::fit::prepare::Sample;
use crate::sphere::CubeCell;
use crate::spread::{covariance, robust_deviation, upper_median};
use nalgebra::{Matrix3, Vector3};
use std::iter::once;

/// Clouds up to this size are used point by point.
pub(crate) const WHOLE_CLOUD: usize = 30_000;

/// Patches along an edge of the cube: 6 x 64^2 = 24 576 in all.
const PER_EDGE: u16 = 64;

/// Of so many cells as there are points, even points hold .7 to .9 and random ones .63. Where they hold less than this share the
/// points lie in rows or heaps, and conjugate gradients hardly tell what is between: then they are gathered in so few
/// patches that the matrix is factored.
const UNEVEN: f64 = 0.4;

/// Points by which this is told, at most.
const LOOKED_AT: usize = 30_000;

/// The fewest patches along an edge.
const FEWEST_PER_EDGE: u16 = 16;

/// Points of a patch that stand apart from its median radius by more than this many standard deviations, its own and those of
/// most patches, are left out, ...
const DEVIATIONS: f64 = 6.0;

/// ... if they also do by this share of the radius.
const LEAST: f64 = 0.01;

/// Points that it takes to tell.
const FEWEST: usize = 8;

/// One patch in so many tells how far points of most patches stand apart.
const EVERY_PATCH: usize = 16;

/// Places that stand for the points of a patch; fewer points stand for themselves.
const PLACES: usize = 6;

/// Points of a patch that tell how far its points are off, ...
const TELLING: usize = 2;

/// ... in one of so many patches that these are so many: enough to tell the noise to .6 %.
const TELLING_PATCHES: usize = 6144;

/// A cloud in patches.
#[derive(Default)]
pub(crate) struct Patches {
    /// Mean direction and radius per patch that holds points.
    pub(crate) means: Vec<Sample>,
    /// Points per patch.
    pub(crate) counts: Vec<f64>,
    /// Points left out.
    pub(crate) left_out: usize,
    /// The places of each patch, and where they are not its points, [`TELLING`] of these behind them.
    places: Vec<Sample>,
    /// Those of a patch begin where those of the one before end.
    ends: Vec<usize>,
}

/// Along how many patches of an edge samples of a grain with these semi-axes are gathered; `None` where they are used one by one.
pub(crate) fn patches_per_edge(samples: &[Sample], axes: &Vector3<f64>) -> Option<u16> {
    if samples.len() <= MOST_FACTORED {
        return None;
    }
    let some = samples.iter().step_by(samples.len().div_ceil(LOOKED_AT));
    let directions: Vec<Vector3<f64>> = some
        .map(|&[x, y, z, _]| Vector3::new(x, y, z).component_div(axes))
        .collect();
    let held = |per_edge: u16| {
        let mut cells: Vec<usize> = directions
            .iter()
            .map(|n| CubeCell::position(per_edge, n))
            .collect();
        cells.sort_unstable();
        cells.dedup();
        cells.len()
    };
    let as_many = (directions.len() as f64 / 6.0).sqrt() as u16;
    match (held(as_many) as f64) < UNEVEN * directions.len() as f64 {
        true => {
            let mut sizes = (FEWEST_PER_EDGE..=PER_EDGE).rev();
            sizes.find(|&per_edge| held(per_edge) <= MOST_FACTORED)
        }
        false => (samples.len() > WHOLE_CLOUD).then_some(PER_EDGE),
    }
}

impl Patches {
    /// Gathers samples of a grain with these semi-axes, in any unit, so many along an edge. Its directions are stretched halfway to where it is round:
    /// unstretched, one patch would hold all of a long grain's tip (of a slender lemon of 40 000 points the area was .15 % off,
    /// and is .05 %); stretched all the way, patches along its sides were too long for their texture.
    pub(crate) fn new(samples: &[Sample], axes: &Vector3<f64>, per_edge: u16) -> Self {
        let stretched = axes.map(f64::sqrt);
        let place: Vec<u32> = samples
            .iter()
            .map(|&[x, y, z, _]| {
                CubeCell::position(per_edge, &Vector3::new(x, y, z).component_div(&stretched))
                    as u32
            })
            .collect();
        let sorted = Buckets::new(patch_count(per_edge), &place);
        let mut patches = Self::default();
        let cells = sorted.iter();
        let tells = |members: &&[u32]| members.len() >= FEWEST;
        let some = cells.clone().filter(tells).step_by(EVERY_PATCH);
        let mut spreads: Vec<f64> = some
            .map(|members| middle_and_spread(samples, members).1)
            .collect();
        let usual = upper_median(&mut spreads).unwrap_or(0.0);
        let every = patch_count(per_edge).div_ceil(TELLING_PATCHES);
        for (at, members) in cells.filter(|members| !members.is_empty()).enumerate() {
            patches.add(samples, members, usual, at.is_multiple_of(every));
        }
        patches
    }

    /// `usual`: standard deviation of the radii in most patches; `is_telling`: whether it tells how far its points are off.
    fn add(&mut self, samples: &[Sample], members: &[u32], usual: f64, is_telling: bool) {
        let (middle, spread) = middle_and_spread(samples, members);
        let limit = match members.len() < FEWEST {
            true => f64::INFINITY,
            false => (DEVIATIONS * spread.max(usual)).max(LEAST * middle),
        };
        let kept = members.iter().map(|&index| samples[index as usize]);
        let kept: Vec<Sample> = kept.filter(|[.., r]| (r - middle).abs() <= limit).collect();
        self.left_out += members.len() - kept.len();
        let (mean, count) = (mean(&kept), kept.len());
        let places = match count <= PLACES {
            true => kept,
            false => {
                let every = count / TELLING;
                let telling = kept.iter().skip(every / 2).step_by(every);
                let telling = telling.filter(|_| is_telling).copied();
                places(&kept).into_iter().chain(telling).collect()
            }
        };
        self.push(mean, count as f64, places);
    }

    /// Whether some patches have too few points to tell which of them stand apart.
    pub(crate) fn are_some_thin(&self) -> bool {
        self.counts.iter().any(|&count| count <= PLACES as f64)
    }

    /// Leaves out one point each, the farthest from a surface, of those of these patches, ascending, that have few of them.
    /// `off`: by how much samples are off the surface.
    pub(crate) fn leave_out(
        &mut self,
        patches: &[usize],
        off: impl FnOnce(&[Sample]) -> Vec<f64>,
    ) -> usize {
        if patches.is_empty() {
            return 0;
        }
        let off = off(&self.places);
        let mut patches = patches.iter().peekable();
        let before = std::mem::take(self);
        self.left_out = before.left_out;
        let mut start = 0;
        for (at, &end) in before.ends.iter().enumerate() {
            let own = std::mem::replace(&mut start, end)..end;
            let mut kept = before.places[own.clone()].to_vec();
            let count = before.counts[at];
            if patches.next_if_eq(&&at).is_none() || count > PLACES as f64 {
                self.push(before.means[at], count, kept);
                continue;
            }
            let farthest = own
                .clone()
                .max_by(|&a, &b| off[a].abs().total_cmp(&off[b].abs()));
            kept.remove(farthest.map_or(0, |at| at - own.start));
            self.left_out += 1;
            if !kept.is_empty() {
                self.push(mean(&kept), count - 1.0, kept);
            }
        }
        self.left_out - before.left_out
    }

    fn push(&mut self, mean: Sample, count: f64, places: Vec<Sample>) {
        self.means.push(mean);
        self.counts.push(count);
        self.places.extend(places);
        self.ends.push(self.places.len());
    }

    /// What stands for the points, and what tells how far they are off.
    pub(crate) fn places(&self) -> &[Sample] {
        &self.places
    }

    /// Means of values at these places over the points of each patch.
    pub(crate) fn means_of(&self, values: &[f64]) -> Vec<f64> {
        self.of_patches(values).map(mean_over_points).collect()
    }

    /// Mean square, over all points, of what their values differ by from the means of their patches: of patches whose points are
    /// seen, or some of them.
    pub(crate) fn spread_of(&self, values: &[f64]) -> f64 {
        let (mut squares, mut points) = (0.0, 0.0);
        for (own, &count) in self.of_patches(values).zip(&self.counts) {
            let mean = mean_over_points(own);
            let seen = if own.len() > PLACES {
                &own[PLACES..]
            } else if count <= PLACES as f64 {
                own
            } else {
                continue;
            };
            let off: Vec<f64> = seen.iter().map(|x| (x - mean).powi(2)).collect();
            squares += count * mean_of(&off);
            points += count;
        }
        squares / points
    }

    /// Number of the points.
    pub(crate) fn points(&self) -> f64 {
        self.counts.iter().sum()
    }

    /// The values at the places and telling points of each patch.
    fn of_patches<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = &'a [f64]> {
        let starts = once(0).chain(self.ends.iter().copied());
        let ends = self.ends.iter().copied();
        starts.zip(ends).map(|(start, end)| &values[start..end])
    }
}

/// Patches of the whole sphere.
fn patch_count(per_edge: u16) -> usize {
    6 * usize::from(per_edge).pow(2)
}

/// The mean over the points of a patch, from the values at its places.
fn mean_over_points(own: &[f64]) -> f64 {
    mean_of(&own[..own.len().min(PLACES)])
}

fn mean_of(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The median radius of a patch's points, and their standard deviation about it, told by the median.
fn middle_and_spread(samples: &[Sample], members: &[u32]) -> (f64, f64) {
    let mut radii: Vec<f64> = members.iter().map(|&i| samples[i as usize][3]).collect();
    let middle = upper_median(&mut radii).unwrap_or(0.0);
    (middle, robust_deviation(radii.iter().map(|r| r - middle)))
}

/// Mean direction and radius.
fn mean(samples: &[Sample]) -> Sample {
    let (mut direction, mut radius) = (Vector3::zeros(), 0.0);
    for &[x, y, z, r] in samples {
        direction += Vector3::new(x, y, z);
        radius += r;
    }
    let n = direction.normalize();
    [n.x, n.y, n.z, radius / samples.len() as f64]
}

/// Places with the mean and the covariance of some samples as points: from the mean, up and down the columns of the
/// covariance's Cholesky factor.
fn places(samples: &[Sample]) -> [Sample; PLACES] {
    let point = |[x, y, z, r]: &Sample| Vector3::new(*x, *y, *z) * *r;
    let (mean, covariance) = covariance(samples.iter().map(point));
    let columns = factor(covariance * 3.0);
    std::array::from_fn(|i| {
        let column = columns.column(i / 2);
        let place = mean + column * [1.0, -1.0][i % 2];
        let radius = place.norm();
        let n = place / radius;
        [n.x, n.y, n.z, radius]
    })
}

/// The Cholesky factor of a covariance, which may be singular.
fn factor(mut rest: Matrix3<f64>) -> Matrix3<f64> {
    let mut factor = Matrix3::zeros();
    for i in 0..3 {
        let pivot = rest[(i, i)];
        if pivot > 0.0 {
            let column = rest.column(i) / pivot.sqrt();
            rest -= column * column.transpose();
            factor.set_column(i, &column);
        }
    }
    factor
}

#[cfg(test)]
mod tests;
