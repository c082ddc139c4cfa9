//! The fit of one segment: every degree from one factorization, with its held-out error.

use super::held_out::{HeldOut, leave_one_out};
use super::reduce::ReducedCell;
use super::row::{LATTICE, Row};
use crate::fit::linear::{Factorization, Triangle};
use crate::fit::outcome::Residuals;
use crate::fit::prepare::{CellGrid, Sample, Samples};
use crate::sphere::{AngularPartition, Cap, CapBasis, Places, coefficient_count};
use rayon::prelude::*;

/// Samples per coefficient that a degree needs. In a local basis the answer with fewer oscillates
/// between the samples (a bean of 1538 points, k = 8: area +15 %).
pub(crate) const SAMPLES_PER_COEFFICIENT: usize = 2;

/// Largest leverage that a degree may have anywhere in its segment: the variance of the fitted
/// radius there, in units of the variance of one sample. Samples stop half a spacing short of the
/// corners, so some extrapolation is usual: 5 to 20 at degree 3 with 60 samples. At 10 half of the
/// segments of the finest partition are refitted for nothing, at 100 and with noise some corners
/// are off by several percent of the radius.
const MAX_LEVERAGE: f64 = 30.0;

/// Everything the segments of one level share.
pub(crate) struct Level<'a> {
    pub(crate) partition: AngularPartition,
    pub(crate) basis: &'a CapBasis,
    pub(crate) grid: &'a CellGrid,
    pub(crate) samples: &'a Samples,
    /// The samples that are predicted from all others.
    pub(crate) probes: &'a Samples,
    pub(crate) reduced: &'a [Option<ReducedCell>],
}

/// Memory that is reused from segment to segment.
pub(crate) struct Workspace {
    factorization: Factorization,
    values: Vec<f64>,
    table: Vec<f64>,
    places: Places,
    gathered: Vec<Sample>,
    probes: Vec<Sample>,
    probe_places: Places,
}

impl Workspace {
    pub(crate) fn new(degree: usize) -> Self {
        Self {
            factorization: Factorization::new(degree),
            values: Vec::new(),
            table: Vec::new(),
            places: Places::default(),
            gathered: Vec::new(),
            probes: Vec::new(),
            probe_places: Places::default(),
        }
    }
}

/// One segment, fitted at every degree that its samples support.
#[derive(Debug, Clone)]
pub(crate) struct SegmentFit {
    /// One fit per degree, from 0 to the largest that the samples support.
    pub(crate) degrees: Vec<DegreeFit>,
}

/// The fit of one degree in one segment.
#[derive(Debug, Clone)]
pub(crate) struct DegreeFit {
    pub(crate) coefficients: Vec<f64>,
    /// Variance of the fitted samples round the fit; `None` if too few are left to tell.
    pub(crate) residual_variance: Option<f64>,
    pub(crate) held_out: HeldOut,
    /// Area and volume over the segment.
    pub(crate) area: f64,
    pub(crate) volume: f64,
    /// Radius at the corners, middles of the borders and middle of the segment, row by row.
    pub(crate) lattice: [f64; LATTICE],
}

impl SegmentFit {
    /// The fit of the given degree, or of the largest one below that the samples support.
    pub(crate) fn at_most(&self, degree: usize) -> &DegreeFit {
        &self.degrees[degree.min(self.degrees.len() - 1)]
    }
}

impl Level<'_> {
    /// Fits one segment. Each degree is fitted to the segment's own samples where they determine it
    /// everywhere, else to the samples of the whole cap round the segment, if those do. `rows` are
    /// the tables of the level's rows.
    pub(crate) fn fit(
        &self,
        segment: usize,
        rows: &[Row],
        workspace: &mut Workspace,
    ) -> SegmentFit {
        let row = &rows[segment / self.partition.per_angle()];
        let cap = self.partition.cap(segment);
        workspace.probes.clear();
        for run in self.runs(segment) {
            workspace.probes.extend_from_slice(self.probes.run(run));
        }
        cap.locate(&workspace.probes, &mut workspace.probe_places);
        self.evaluate_probes(workspace);

        workspace.factorization.clear();
        let samples = if std::ptr::eq(self.samples, self.probes) && self.reduced.is_empty() {
            let Workspace {
                factorization,
                values,
                probes,
                ..
            } = workspace;
            factorization.add_evaluated(values, probes);
            probes.len()
        } else {
            self.add_rows(segment, &cap, workspace)
        };
        let mut degrees = Vec::new();
        self.add_degrees(&mut degrees, samples, row, workspace);
        if degrees.len() <= self.basis.degree() {
            let widened = self.samples.of_cap(&cap, self.grid);
            self.evaluate_probes(workspace);
            workspace.factorization.clear();
            workspace
                .factorization
                .add_samples(self.basis, &cap, &widened);
            self.add_degrees(&mut degrees, widened.len(), row, workspace);
        }
        SegmentFit { degrees }
    }

    /// Writes the basis at the probes into `values`.
    fn evaluate_probes(&self, workspace: &mut Workspace) {
        let rows = workspace.probes.len();
        workspace
            .values
            .resize(coefficient_count(self.basis.degree()) * rows, 0.0);
        self.basis
            .evaluate(&workspace.probe_places, &mut workspace.values, rows);
    }

    /// Appends the fits of the degrees that the factored samples support and that are still missing.
    /// The basis at the probes stands in `values` and is used up.
    fn add_degrees(
        &self,
        degrees: &mut Vec<DegreeFit>,
        samples: usize,
        row: &Row,
        workspace: &mut Workspace,
    ) {
        let Workspace {
            factorization,
            values,
            probes,
            ..
        } = workspace;
        let triangle = factorization.triangle();
        let supported = self.supported_degree(&triangle, samples, row);
        let Some(top) = supported.filter(|&top| top >= degrees.len()) else {
            return;
        };
        let held_out = leave_one_out(&triangle, top, probes, values);
        for (degree, held_out) in held_out.into_iter().enumerate().skip(degrees.len()) {
            let coefficients = triangle.solve(degree);
            let [area, volume] = row.area_and_volume(&coefficients);
            degrees.push(DegreeFit {
                residual_variance: triangle.residual_variance(degree, samples),
                held_out,
                area,
                volume,
                lattice: row.lattice_radii(&coefficients),
                coefficients,
            });
        }
    }

    /// Residuals of all samples against the segments' fits at the level's degree.
    pub(crate) fn residuals(&self, segments: &[SegmentFit]) -> Residuals {
        let parts: Vec<(f64, f64)> = segments
            .par_iter()
            .enumerate()
            .map(|(segment, fit)| {
                let cap = self.partition.cap(segment);
                let coefficients = &fit.at_most(self.basis.degree()).coefficients;
                let (mut values, mut places) = (Vec::new(), Places::default());
                let (mut squared, mut max) = (0.0, 0.0_f64);
                for run in self.runs(segment) {
                    let samples = self.samples.run(run);
                    values.resize(samples.len(), 0.0);
                    cap.locate(samples, &mut places);
                    self.basis.values(coefficients, &places, &mut values);
                    for (value, sample) in values.iter().zip(samples) {
                        let residual = sample[3] - value;
                        squared += residual * residual;
                        max = max.max(residual.abs());
                    }
                }
                (squared, max)
            })
            .collect();
        let squared: f64 = parts.iter().map(|(squared, _)| squared).sum();
        Residuals {
            rms: (squared / self.samples.rows().len() as f64).sqrt(),
            max: parts.iter().map(|(_, max)| *max).fold(0.0, f64::max),
        }
    }

    /// Factors what the segment's cells hold; returns the number of samples. Cells that are not
    /// reduced are gathered first, so that the basis is evaluated along long columns.
    fn add_rows(&self, segment: usize, cap: &Cap, workspace: &mut Workspace) -> usize {
        let Workspace {
            factorization,
            table,
            gathered,
            places,
            ..
        } = workspace;
        gathered.clear();
        let mut samples = 0;
        for run in self.runs(segment) {
            samples += self.samples.run(run.clone()).len();
            if self.reduced.is_empty() {
                gathered.extend_from_slice(self.samples.run(run));
                continue;
            }
            for cell in run {
                match &self.reduced[cell] {
                    Some(reduced) => reduced.add_to(factorization, self.basis, cap, table, places),
                    None => gathered.extend_from_slice(self.samples.run(cell..cell + 1)),
                }
            }
        }
        factorization.add_samples(self.basis, cap, gathered);
        samples
    }

    /// The runs of adjacent cells that make a segment.
    fn runs(&self, segment: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
        let k = self.partition.per_angle();
        let columns = self.grid.range(segment % k, k);
        let per_angle = self.grid.per_angle();
        self.grid
            .range(segment / k, k)
            .map(move |row| row * per_angle + columns.start..row * per_angle + columns.end)
    }

    /// The largest degree that the samples determine everywhere in the segment: enough samples, full
    /// rank, and no extrapolation at the corners, edges and middle.
    fn supported_degree(
        &self,
        triangle: &Triangle<'_>,
        samples: usize,
        row: &Row,
    ) -> Option<usize> {
        let enough = (samples / SAMPLES_PER_COEFFICIENT).isqrt().checked_sub(1)?;
        let top = enough
            .min(triangle.full_rank_degree()?)
            .min(self.basis.degree());
        let mut values = row.lattice.clone();
        triangle.whiten(&mut values, LATTICE, coefficient_count(top));
        let mut leverage = [0.0; LATTICE];
        (0..=top)
            .take_while(|&degree| {
                let functions = degree * degree..coefficient_count(degree);
                for column in values
                    .chunks(LATTICE)
                    .skip(functions.start)
                    .take(functions.len())
                {
                    for (leverage, z) in leverage.iter_mut().zip(column) {
                        *leverage += z * z;
                    }
                }
                leverage.iter().all(|&leverage| leverage <= MAX_LEVERAGE)
            })
            .last()
    }
}

#[cfg(test)]
mod tests;
