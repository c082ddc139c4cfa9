//! The fit of one segment: every degree from one factorization, with its held-out error.

use super::Residuals;
use super::factor::{Factorization, Triangle};
use super::held_out::{HeldOut, leave_one_out};
use super::reduce::ReducedCell;
use super::row::Row;
use super::samples::{CellGrid, Sample, Samples};
use crate::sphere::{AngularPartition, Cap, CapBasis, Places, coefficient_count};
use rayon::prelude::*;
use std::num::NonZero;

/// Samples per coefficient that a degree needs. In a local basis the answer with fewer oscillates
/// between the samples (a bean of 1538 points, k = 8: area +15 %).
const SAMPLES_PER_COEFFICIENT: usize = 2;

/// Largest leverage that a degree may have anywhere in its segment: the variance of the fitted
/// radius there, in units of the variance of one sample. Beyond one the fit knows less about the
/// place than a single look at it would tell: it extrapolates.
const MAX_LEVERAGE: f64 = 10.0;

/// Nearest samples that a segment is fitted to when its whole cap holds fewer.
pub(crate) const NEAREST_SAMPLES: NonZero<usize> = NonZero::new(12).unwrap();

/// Everything the segments of one level share.
pub(crate) struct Level<'a> {
    pub(crate) partition: AngularPartition,
    pub(crate) basis: &'a CapBasis,
    /// What the segments between two polar angles share, from north to south.
    pub(crate) rows: Vec<Row>,
    pub(crate) grid: &'a CellGrid,
    pub(crate) samples: &'a Samples,
    /// The samples that are predicted from all others.
    pub(crate) probes: &'a Samples,
    pub(crate) reduced: &'a [Option<ReducedCell>],
    /// The samples of a whole cap, also outside of its segment; the nearest ones if it is empty.
    pub(crate) samples_of_cap: &'a (dyn Fn(&Cap) -> Vec<Sample> + Sync),
}

/// Memory that is reused from segment to segment.
pub(crate) struct Workspace {
    factorization: Factorization,
    values: Vec<f64>,
    places: Places,
    gathered: Vec<Sample>,
    probes: Vec<Sample>,
    probe_places: Places,
    radii_and_slopes: Vec<[f64; 2]>,
}

impl Workspace {
    pub(crate) fn new(degree: usize) -> Self {
        Self {
            factorization: Factorization::new(degree),
            values: Vec::new(),
            places: Places::default(),
            gathered: Vec::new(),
            probes: Vec::new(),
            probe_places: Places::default(),
            radii_and_slopes: Vec::new(),
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
    pub(crate) lattice: [f64; 9],
}

impl SegmentFit {
    /// The fit of the given degree, or of the largest one below that the samples support.
    pub(crate) fn at_most(&self, degree: usize) -> &DegreeFit {
        &self.degrees[degree.min(self.degrees.len() - 1)]
    }
}

impl Level<'_> {
    /// Fits one segment. Each degree is fitted to the segment's own samples where they determine it
    /// everywhere, else to the samples of the whole cap round the segment, if those do.
    pub(crate) fn fit(&self, segment: usize, workspace: &mut Workspace) -> SegmentFit {
        let row = &self.rows[segment / self.partition.per_angle()];
        let cap = self.partition.cap(segment);
        workspace.probes.clear();
        for run in self.runs(segment) {
            workspace.probes.extend_from_slice(self.probes.run(run));
        }
        cap.locate(&workspace.probes, &mut workspace.probe_places);

        workspace.factorization.clear();
        let samples = self.add_rows(segment, &cap, workspace);
        let mut degrees = Vec::new();
        self.add_degrees(&mut degrees, samples, row, workspace);
        if degrees.len() <= self.basis.degree() {
            let widened = (self.samples_of_cap)(&cap);
            workspace.factorization.clear();
            workspace
                .factorization
                .add_samples(self.basis, &cap, &widened);
            self.add_degrees(&mut degrees, widened.len(), row, workspace);
        }
        SegmentFit { degrees }
    }

    /// Appends the fits of the degrees that the factored samples support and that are still missing.
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
            probe_places,
            radii_and_slopes,
            ..
        } = workspace;
        let triangle = factorization.triangle();
        let supported = self.supported_degree(&triangle, samples, row, values);
        let Some(top) = supported.filter(|&top| top >= degrees.len()) else {
            return;
        };
        values.resize(coefficient_count(self.basis.degree()) * probes.len(), 0.0);
        self.basis.evaluate(probe_places, values, probes.len());
        let held_out = leave_one_out(&triangle, top, probes, values);
        radii_and_slopes.resize(row.weights.len(), [0.0; 2]);
        for (degree, held_out) in held_out.into_iter().enumerate().skip(degrees.len()) {
            let coefficients = triangle.solve(degree);
            self.basis
                .values_and_slopes(&row.cap, &coefficients, &row.nodes, radii_and_slopes);
            let (mut area, mut volume) = (0.0, 0.0);
            for (&[r, slope_squared], weight) in radii_and_slopes.iter().zip(&row.weights) {
                area += weight * r.abs() * (r * r + slope_squared).sqrt();
                volume += weight * r * r * r / 3.0;
            }
            let mut lattice = [0.0; 9];
            self.basis.values(&coefficients, &row.lattice, &mut lattice);
            degrees.push(DegreeFit {
                coefficients,
                residual_variance: triangle.residual_variance(degree, samples),
                held_out,
                area,
                volume,
                lattice,
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
            values,
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
                    Some(reduced) => reduced.add_to(factorization, self.basis, cap, values, places),
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
        values: &mut Vec<f64>,
    ) -> Option<usize> {
        let enough = (samples / SAMPLES_PER_COEFFICIENT).isqrt().checked_sub(1)?;
        let top = enough
            .min(triangle.full_rank_degree()?)
            .min(self.basis.degree());
        let rows = row.lattice.len();
        values.resize(coefficient_count(self.basis.degree()) * rows, 0.0);
        self.basis.evaluate(&row.lattice, values, rows);
        triangle.whiten(values, rows, rows, coefficient_count(top));
        let mut leverage = [0.0; 9];
        (0..=top)
            .take_while(|&degree| {
                for column in
                    values[degree * degree * rows..coefficient_count(degree) * rows].chunks(rows)
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
