//! The least-squares problem of a surface r = sum of shares times expansions, in which every sample
//! ties the few cells it touches.

use super::groups::{Group, group};
use crate::fit::samples::Sample;
use crate::fit::search::Candidate;
use crate::sphere::{CapBasis, Cover, Places, coefficient_count};
use crate::vectorize::vectorize;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Samples evaluated at once: their part of the design matrix fits in the cache.
const BLOCK_ROWS: usize = 512;

/// Weights of samples stay within this factor of the mean, so that the few points of a thin region
/// do not outweigh the noise of the many elsewhere.
const LARGEST_WEIGHT: f64 = 4.0;

/// Coefficients of every cell, ordered by degree.
pub(crate) type Coefficients = Vec<Vec<f64>>;

/// Samples of a cover, ready to be fitted.
#[derive(Clone)]
pub(crate) struct System<'a> {
    pub(crate) cover: Cover,
    /// The basis of each degree.
    bases: &'a [CapBasis],
    /// Degree of every cell.
    pub(crate) degrees: Vec<usize>,
    pub(super) samples: &'a [Sample],
    pub(super) groups: Vec<Group>,
    /// Weight of every sample: solid angle per sample, relative to the mean.
    pub(super) weights: Vec<f64>,
    /// Sum of the shares of every cell: how many samples it holds.
    pub(crate) held: Vec<f64>,
}

/// Memory of a task.
#[derive(Default)]
pub(super) struct Workspace {
    pub(super) rows: Vec<Sample>,
    places: Places,
    pub(super) design: Vec<f64>,
}

impl<'a> System<'a> {
    pub(crate) fn new(
        cover: Cover,
        bases: &'a [CapBasis],
        degrees: Vec<usize>,
        samples: &'a [Sample],
    ) -> Self {
        let groups = group(&cover, samples);
        let mut held = vec![0.0; degrees.len()];
        for group in &groups {
            for (at, &cell) in group.cells.iter().enumerate() {
                held[usize::from(cell)] += group.shares(at).iter().sum::<f64>();
            }
        }
        let mut system = Self {
            cover,
            bases,
            degrees,
            samples,
            groups,
            weights: Vec::new(),
            held,
        };
        system.weights = system.sample_weights();
        system
    }

    /// The model as a candidate, of which nothing is known but its size.
    pub(super) fn candidate(&self) -> Candidate {
        let degrees = &self.degrees;
        let degree = degrees.iter().copied().max().unwrap_or(0);
        Candidate {
            degree,
            segments: degrees.len(),
            coefficients: self.sizes().iter().sum(),
            reduced_segments: degrees.iter().filter(|&&d| d < degree).count(),
            area_error: None,
            volume_error: None,
            heldout_rms: None,
            rejected: None,
        }
    }

    /// The same samples with lower degrees.
    pub(super) fn lowered(&self, degrees: Vec<usize>) -> Self {
        Self {
            degrees,
            ..self.clone()
        }
    }

    /// Solid angle per sample, told by the number of samples per cell and blended like the radius.
    fn sample_weights(&self) -> Vec<f64> {
        let mean = self.samples.len() as f64 / (4.0 * std::f64::consts::PI);
        let density: Vec<f64> = self
            .held
            .iter()
            .zip(self.cover.cells())
            .map(|(held, cell)| held / cell.solid_angle() / mean)
            .collect();
        let mut weights = vec![1.0; self.samples.len()];
        for group in &self.groups {
            for (row, &member) in group.members.iter().enumerate() {
                let here: f64 = group
                    .cells
                    .iter()
                    .enumerate()
                    .map(|(at, &cell)| group.shares(at)[row] * density[usize::from(cell)])
                    .sum();
                weights[member as usize] = (1.0 / here).clamp(1.0 / LARGEST_WEIGHT, LARGEST_WEIGHT);
            }
        }
        weights
    }

    /// The cell with the largest share at every sample.
    pub(super) fn nearest(&self) -> Vec<u16> {
        let mut nearest = vec![0; self.samples.len()];
        for group in &self.groups {
            for (row, &member) in group.members.iter().enumerate() {
                let shares = (0..group.cells.len()).map(|at| (group.shares(at)[row], at));
                let largest = shares.fold(
                    (0.0, 0),
                    |most, share| {
                        if share.0 > most.0 { share } else { most }
                    },
                );
                nearest[member as usize] = group.cells[largest.1];
            }
        }
        nearest
    }

    /// The cells that overlap with each cell where there are samples.
    pub(super) fn neighbours(&self) -> Vec<BTreeSet<u16>> {
        let mut neighbours = vec![BTreeSet::new(); self.degrees.len()];
        for group in &self.groups {
            for &cell in &group.cells {
                let others = group.cells.iter().filter(|&&other| other != cell);
                neighbours[usize::from(cell)].extend(others.copied());
            }
        }
        neighbours
    }

    pub(super) fn sizes(&self) -> Vec<usize> {
        self.degrees.iter().map(|&d| coefficient_count(d)).collect()
    }

    /// Writes the design matrix of some members of a group: columns by cell and degree.
    pub(super) fn design(
        &self,
        group: &Group,
        from: usize,
        to: usize,
        workspace: &mut Workspace,
    ) -> usize {
        let rows = to - from;
        workspace.rows.clear();
        workspace.rows.extend(
            group.members[from..to]
                .iter()
                .map(|&m| self.samples[m as usize]),
        );
        let columns: usize = group
            .cells
            .iter()
            .map(|&cell| coefficient_count(self.degrees[usize::from(cell)]))
            .sum();
        workspace.design.resize(columns * rows, 0.0);
        let mut start = 0;
        for (at, &cell) in group.cells.iter().enumerate() {
            let cell = usize::from(cell);
            self.cover
                .cap(cell)
                .locate(&workspace.rows, &mut workspace.places);
            let design = &mut workspace.design[start * rows..];
            let degree = self.degrees[cell];
            self.bases[degree].evaluate(&workspace.places, design, rows);
            let count = coefficient_count(degree);
            let shares = &group.shares(at)[from..to];
            vectorize(
                #[inline(always)]
                || {
                    for column in design[..count * rows].chunks_exact_mut(rows) {
                        for (value, share) in column.iter_mut().zip(shares) {
                            *value *= share;
                        }
                    }
                },
            );
            start += count;
        }
        columns
    }

    /// Runs `work` on every block of every group in parallel and gives the results in order.
    pub(super) fn blocks<T: Send>(
        &self,
        work: impl Fn(&Group, usize, usize, &mut Workspace) -> T + Sync,
    ) -> Vec<(usize, T)> {
        let blocks: Vec<(usize, usize, usize)> = self
            .groups
            .iter()
            .enumerate()
            .flat_map(|(number, group)| {
                let count = group.members.len();
                (0..count)
                    .step_by(BLOCK_ROWS)
                    .map(move |from| (number, from, count.min(from + BLOCK_ROWS)))
            })
            .collect();
        blocks
            .into_par_iter()
            .with_min_len(8)
            .map_init(Workspace::default, |workspace, (number, from, to)| {
                (number, work(&self.groups[number], from, to, workspace))
            })
            .collect()
    }

    /// Residuals of the samples of a block whose design stands in the workspace.
    pub(super) fn residual(
        &self,
        group: &Group,
        coefficients: &Coefficients,
        workspace: &Workspace,
        rows: usize,
    ) -> Vec<f64> {
        let mut residual: Vec<f64> = workspace.rows.iter().map(|sample| sample[3]).collect();
        let flat = group
            .cells
            .iter()
            .flat_map(|&cell| &coefficients[usize::from(cell)]);
        for (column, factor) in workspace.design.chunks_exact(rows).zip(flat) {
            for (residual, value) in residual.iter_mut().zip(column) {
                *residual -= factor * value;
            }
        }
        residual
    }

    /// Means per cell of a figure of the samples: every sample counts in the cells it touches by
    /// their shares. 0 in cells without samples.
    pub(crate) fn cell_means(&self, figure: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.degrees.len()];
        for group in &self.groups {
            for (at, &cell) in group.cells.iter().enumerate() {
                let members = group.shares(at).iter().zip(&group.members);
                sums[usize::from(cell)] += members
                    .map(|(share, &member)| share * figure(member as usize))
                    .sum::<f64>();
            }
        }
        sums.iter()
            .zip(&self.held)
            .map(|(sum, held)| if *held > 0.0 { sum / held } else { 0.0 })
            .collect()
    }
}

#[cfg(test)]
mod tests;
