//! Samples of the radius, sorted into the cells of the angle domain that every partition of a
//! search is made of.
//!
//! The boundaries i/k of all the partitions searched (k = 1..10: 32 intervals per angle) cut the
//! angle domain into cells. Sorted by cell, and within a cell by value, the samples of any segment
//! of any partition are a few contiguous runs, duplicates stand side by side, and no result depends
//! on the order in which the points came.

use super::bin::{BINS, bin};
use crate::model::Frame;
use crate::sphere::{AngleRectangle, Cap, azimuth_fraction, polar_fraction};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Unit direction (x, y, z in the grain's frame) and radius.
pub(crate) type Sample = [f64; 4];

/// The cuts that the boundaries of several partitions make in each angle.
#[derive(Debug, Clone)]
pub(crate) struct CellGrid {
    cuts: Vec<f64>,
}

impl CellGrid {
    /// The common refinement of the partitions with the given parts per angle.
    pub(crate) fn new(per_angle: impl IntoIterator<Item = usize>) -> Self {
        let mut cuts: Vec<f64> = per_angle
            .into_iter()
            .flat_map(|k| (0..=k).map(move |i| i as f64 / k as f64))
            .collect();
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup();
        Self { cuts }
    }

    /// Cells per angle.
    pub(crate) fn per_angle(&self) -> usize {
        self.cuts.len() - 1
    }

    /// The cells of one angle that make part i of k.
    pub(crate) fn range(&self, i: usize, k: usize) -> Range<usize> {
        let at = |i: usize| {
            let cut = i as f64 / k as f64;
            self.cuts.partition_point(|&c| c < cut)
        };
        at(i)..at(i + 1)
    }

    /// The bounds of a cell, numbered row by row from the north pole.
    pub(crate) fn rectangle(&self, cell: usize) -> AngleRectangle {
        let (row, column) = (cell / self.per_angle(), cell % self.per_angle());
        let bounds = |i: usize, whole: f64| [whole * self.cuts[i], whole * self.cuts[i + 1]];
        AngleRectangle {
            theta: bounds(row, PI),
            phi: bounds(column, TAU),
        }
    }

    /// The rows of cells between two polar angles.
    fn rows_between(&self, theta: [f64; 2]) -> Range<usize> {
        let [first, last] = theta.map(|t| self.cuts.partition_point(|&c| c <= t / PI));
        first.clamp(1, self.per_angle()) - 1..last.clamp(1, self.per_angle())
    }

    fn cell_of(&self, n: &Vector3<f64>) -> usize {
        let at = |t: f64| (self.cuts.partition_point(|&c| c <= t)).clamp(1, self.per_angle()) - 1;
        at(polar_fraction(n)) * self.per_angle() + at(azimuth_fraction(n))
    }
}

/// Samples sorted by cell.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    rows: Vec<Sample>,
    /// Cell c holds rows `starts[c]..starts[c + 1]`.
    starts: Vec<usize>,
}

/// Points per task: small enough to share out, large enough to hide the cost of sharing.
const CHUNK: usize = 1 << 14;

impl Samples {
    /// Directions and radii of `points` in `frame`, in the cells of `grid`. Points that coincide
    /// count once; a point at the centre has no direction and is left out.
    pub(crate) fn new(points: &[Point3<f64>], frame: &Frame, grid: &CellGrid) -> Self {
        let cells = grid.per_angle() * grid.per_angle();
        Self::sorted(points, frame, cells, |n| grid.cell_of(n))
    }

    /// The same in cells that are found and sorted faster.
    pub(crate) fn by_place(points: &[Point3<f64>], frame: &Frame) -> Self {
        Self::sorted(points, frame, BINS, bin)
    }

    fn sorted(
        points: &[Point3<f64>],
        frame: &Frame,
        cells: usize,
        cell: impl Fn(&Vector3<f64>) -> usize + Sync,
    ) -> Self {
        let sample = |point: &Point3<f64>| {
            let local = frame.to_local(point);
            let radius = local.norm();
            (radius > 0.0).then(|| (local / radius, radius))
        };
        let cell_of: Vec<u32> = points
            .par_iter()
            .with_min_len(CHUNK)
            .map(|p| sample(p).map_or(cells as u32, |(n, _)| cell(&n) as u32))
            .collect();
        let mut starts = vec![0; cells + 2];
        for &cell in &cell_of {
            starts[cell as usize + 1] += 1;
        }
        for c in 0..=cells {
            starts[c + 1] += starts[c];
        }
        starts.truncate(cells + 1);
        let mut rows = vec![[0.0; 4]; starts[cells]];
        let mut next = starts.clone();
        for (point, &cell) in points.iter().zip(&cell_of) {
            if let Some((n, radius)) = sample(point) {
                let at = &mut next[cell as usize];
                rows[*at] = [n.x, n.y, n.z, radius];
                *at += 1;
            }
        }
        let mut samples = Self { rows, starts };
        samples.sort_and_drop_duplicates();
        samples
    }

    fn sort_and_drop_duplicates(&mut self) {
        let mut rest = self.rows.as_mut_slice();
        let mut slices = Vec::with_capacity(self.starts.len());
        for pair in self.starts.windows(2) {
            let (cell, tail) = std::mem::take(&mut rest).split_at_mut(pair[1] - pair[0]);
            slices.push(cell);
            rest = tail;
        }
        let distinct: Vec<usize> = slices
            .into_par_iter()
            .with_min_len(64)
            .map(|cell| {
                cell.sort_unstable_by(order);
                let mut kept = 0;
                for i in 0..cell.len() {
                    if i == 0 || cell[i] != cell[kept - 1] {
                        cell[kept] = cell[i];
                        kept += 1;
                    }
                }
                kept
            })
            .collect();
        let mut end = 0;
        for (cell, kept) in distinct.into_iter().enumerate() {
            let start = self.starts[cell];
            self.rows.copy_within(start..start + kept, end);
            self.starts[cell] = end;
            end += kept;
        }
        *self.starts.last_mut().expect("starts ends with the total") = end;
        self.rows.truncate(end);
    }

    /// All samples, cell by cell.
    pub(crate) fn rows(&self) -> &[Sample] {
        &self.rows
    }

    /// The samples of a run of adjacent cells.
    pub(crate) fn run(&self, cells: Range<usize>) -> &[Sample] {
        &self.rows[self.starts[cells.start]..self.starts[cells.end]]
    }

    /// The samples of a whole cap; where it holds few, the nearest to its centre.
    pub(crate) fn of_cap(&self, cap: &Cap, grid: &CellGrid) -> Vec<Sample> {
        let theta = cap.centre.z.clamp(-1.0, 1.0).acos();
        let height = cap.height * BEYOND_THE_RIM;
        let reach = (1.0 - height).clamp(-1.0, 1.0).acos();
        let rows = grid.rows_between([theta - reach, theta + reach]);
        let run = self.run(rows.start * grid.per_angle()..rows.end * grid.per_angle());
        // |n - c|^2 = 2 (1 - n.c)
        let distance = |&[x, y, z, _]: &Sample| (Vector3::new(x, y, z) - cap.centre).norm_squared();
        let within = |sample: &&Sample| distance(sample) <= 2.0 * height;
        let found: Vec<Sample> = run.iter().filter(within).copied().collect();
        if found.len() >= FEWEST_OF_CAP {
            return found;
        }
        let mut all = self.rows.clone();
        if all.len() <= FEWEST_OF_CAP {
            return all;
        }
        all.select_nth_unstable_by(FEWEST_OF_CAP - 1, |a, b| {
            distance(a).total_cmp(&distance(b)).then(order(a, b))
        });
        all.truncate(FEWEST_OF_CAP);
        all.sort_unstable_by(order);
        all
    }
}

/// A cap's samples are looked for a little beyond its rim, on which the corners of the segment lie:
/// a sample at a corner belongs to the cap whatever the rounding.
const BEYOND_THE_RIM: f64 = 1.013;

/// Samples that a cap should hold, else the nearest outside are taken too.
const FEWEST_OF_CAP: usize = 12;

/// An order of samples by value, radius first, in which equal samples stand together.
pub(crate) fn order(a: &Sample, b: &Sample) -> Ordering {
    let at = |i: usize| (a[i] + 0.0).total_cmp(&(b[i] + 0.0));
    at(3).then_with(|| at(0).then(at(1)).then(at(2)))
}
