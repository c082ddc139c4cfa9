//! The fit of one segment: every degree from one factorization, with its held-out error.

use super::Residuals;
use super::factor::{Factorization, Triangle};
use super::reduce::ReducedCell;
use super::samples::{CellGrid, Sample, Samples};
use crate::sphere::{
    AngleRectangle, AngularPartition, Cap, CapBasis, GaussLegendre, coefficient_count,
};
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
    /// Gauss rules for a segment's polar angle and azimuth.
    pub(crate) rules: [GaussLegendre; 2],
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
    gathered: Vec<Sample>,
    probes: Vec<Sample>,
}

impl Workspace {
    pub(crate) fn new(degree: usize) -> Self {
        Self {
            factorization: Factorization::new(degree),
            values: Vec::new(),
            gathered: Vec::new(),
            probes: Vec::new(),
        }
    }
}

/// One segment, fitted at every degree that its samples support.
#[derive(Debug, Clone)]
pub(crate) struct SegmentFit {
    /// Samples in the segment.
    pub(crate) samples: usize,
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

/// What a fit says of samples that it has not seen.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldOut {
    /// Sum of squared errors.
    pub(crate) squared: f64,
    /// Largest error, relative to the radius.
    pub(crate) worst: f64,
    /// Number of samples predicted.
    pub(crate) count: usize,
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
        let rectangle = self.partition.rectangle(segment);
        let cap = rectangle.cap();
        workspace.probes.clear();
        for run in self.runs(segment) {
            workspace.probes.extend_from_slice(self.probes.run(run));
        }

        workspace.factorization.clear();
        let samples = self.add_rows(segment, &cap, workspace);
        let mut degrees = Vec::new();
        self.add_degrees(&mut degrees, samples, &rectangle, &cap, workspace);
        if degrees.len() <= self.basis.degree() {
            STARVED.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            let widened = (self.samples_of_cap)(&cap);
            workspace.factorization.clear();
            workspace
                .factorization
                .add_samples(self.basis, &cap, &widened);
            self.add_degrees(&mut degrees, widened.len(), &rectangle, &cap, workspace);
        }
        SegmentFit { samples, degrees }
    }

    /// Appends the fits of the degrees that the factored samples support and that are still missing.
    fn add_degrees(
        &self,
        degrees: &mut Vec<DegreeFit>,
        samples: usize,
        rectangle: &AngleRectangle,
        cap: &Cap,
        workspace: &mut Workspace,
    ) {
        let Workspace {
            factorization,
            values,
            probes,
            ..
        } = workspace;
        let triangle = factorization.triangle();
        let Some(top) = self.supported_degree(&triangle, samples, rectangle, cap, values) else {
            return;
        };
        if top < degrees.len() {
            return;
        }
        let held_out = self.predict(
            &triangle,
            top,
            cap,
            &workspace.probes,
            &mut workspace.values,
        );
        let nodes = rectangle.nodes(&self.rules[0], &self.rules[1]);
        let directions: Vec<Sample> = nodes.iter().map(|(n, _)| [n.x, n.y, n.z, 0.0]).collect();
        let mut radii_and_slopes = vec![[0.0; 2]; nodes.len()];
        for (degree, held_out) in held_out.into_iter().enumerate().skip(degrees.len()) {
            let coefficients = triangle.solve(degree);
            self.basis
                .values_and_slopes(cap, &coefficients, &directions, &mut radii_and_slopes);
            let (mut area, mut volume) = (0.0, 0.0);
            for (&[r, slope_squared], (_, weight)) in radii_and_slopes.iter().zip(&nodes) {
                area += weight * r.abs() * (r * r + slope_squared).sqrt();
                volume += weight * r * r * r / 3.0;
            }
            let mut lattice = [0.0; 9];
            self.basis
                .values(cap, &coefficients, &rectangle.lattice(), &mut lattice);
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
                let mut values = Vec::new();
                let (mut squared, mut max) = (0.0, 0.0_f64);
                for run in self.runs(segment) {
                    let samples = self.samples.run(run);
                    values.resize(samples.len(), 0.0);
                    self.basis.values(&cap, coefficients, samples, &mut values);
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
                    Some(reduced) => reduced.add_to(factorization, self.basis, cap, values),
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
        rectangle: &AngleRectangle,
        cap: &Cap,
        values: &mut Vec<f64>,
    ) -> Option<usize> {
        let enough = (samples / SAMPLES_PER_COEFFICIENT).isqrt().checked_sub(1)?;
        let top = enough
            .min(triangle.full_rank_degree()?)
            .min(self.basis.degree());
        let guards = rectangle.lattice();
        let rows = guards.len();
        values.resize(coefficient_count(self.basis.degree()) * rows, 0.0);
        self.basis.evaluate(cap, &guards, values, rows);
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

    /// Predicts every probe from the fit of all samples but itself, at all degrees up to `top`: the
    /// exact leave-one-out error e / (1 - h), with h the probe's leverage.
    fn predict(
        &self,
        triangle: &Triangle<'_>,
        top: usize,
        cap: &Cap,
        probes: &[Sample],
        values: &mut Vec<f64>,
    ) -> Vec<HeldOut> {
        let rows = probes.len();
        let count = coefficient_count(top);
        let mut out = vec![HeldOut::default(); top + 1];
        if rows == 0 {
            return out;
        }
        values.resize(coefficient_count(self.basis.degree()) * rows, 0.0);
        self.basis.evaluate(cap, probes, values, rows);
        triangle.whiten(values, rows, rows, count);
        let mut residual: Vec<f64> = probes.iter().map(|s| s[3]).collect();
        let mut spare = vec![1.0; rows];
        for (degree, out) in out.iter_mut().enumerate() {
            for j in degree * degree..coefficient_count(degree) {
                let projection = triangle.projection(j);
                let column = &values[j * rows..(j + 1) * rows];
                for ((residual, spare), z) in residual.iter_mut().zip(&mut spare).zip(column) {
                    *residual -= z * projection;
                    *spare -= z * z;
                }
            }
            out.count = rows;
            for ((residual, spare), sample) in residual.iter().zip(&spare).zip(probes) {
                let error = residual / spare.max(LEAST_SPARE);
                out.squared += error * error;
                out.worst = out.worst.max((error / sample[3]).abs());
            }
        }
        out
    }
}

/// Floor of 1 - h: rounding can take the leverage of a sample that alone decides a coefficient to 1.
const LEAST_SPARE: f64 = 1e-6;

pub static STARVED: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);
