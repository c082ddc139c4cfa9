//! Places of points along an axis that are equal steps apart, as those of voxels are.

use crate::spread::upper_median;
use nalgebra::{Point3, Vector3};

/// Points that are looked at first, and the share of them that may differ in a coordinate: of other points nearly all do.
const LOOKED_AT: usize = 5000;
const MOST_DISTINCT: f64 = 0.6;

/// Coordinates this near, as a share of the extent, are one.
const SAME: f64 = 1e-4;

/// Places along an axis that are equal steps apart.
pub(super) struct Steps {
    pub(super) along: Vector3<f64>,
    pub(super) first: f64,
    pub(super) step: f64,
    /// The steps from the first place to all of them, ascending.
    pub(super) numbers: Vec<i64>,
}

impl Steps {
    /// Those that all points are at, but for this share of a step. The step is the usual one from a place to the next, cut in the first of
    /// these numbers of parts that will do.
    pub(super) fn new(
        points: &[Point3<f64>],
        along: Vector3<f64>,
        but_for: f64,
        parts: &[f64],
    ) -> Option<Self> {
        let level = |point: &Point3<f64>| along.dot(&point.coords);
        let every = points.len().div_ceil(LOOKED_AT).max(1);
        let some: Vec<f64> = points.iter().step_by(every).map(level).collect();
        let most = (MOST_DISTINCT * some.len() as f64) as usize;
        if levels(some).len() > most {
            return None;
        }
        let levels = levels(points.iter().map(level).collect());
        let mut gaps: Vec<f64> = levels.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let usual = upper_median(&mut gaps)?;
        let (&first, &last) = (levels.first()?, levels.last()?);
        parts.iter().find_map(|parts| {
            let step = (last - first) / ((last - first) * parts / usual).round();
            let numbers = levels.iter().map(|level| (level - first) / step);
            let are_on_steps = numbers.clone().all(|n| (n - n.round()).abs() < but_for);
            are_on_steps.then(|| Self {
                along,
                first,
                step,
                numbers: numbers.map(|n| n.round() as i64).collect(),
            })
        })
    }

    /// The steps from the first place to that of a point.
    pub(super) fn number(&self, point: &Point3<f64>) -> i64 {
        ((self.along.dot(&point.coords) - self.first) / self.step).round() as i64
    }
}

/// The means of values that are one, ascending.
fn levels(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_unstable_by(f64::total_cmp);
    let ends = values.first().zip(values.last());
    let same = SAME * ends.map_or(0.0, |(first, last)| last - first);
    let levels = values.chunk_by(|one, next| next - one <= same);
    levels
        .map(|level| level.iter().sum::<f64>() / level.len() as f64)
        .collect()
}
