//! The fit of one segment: every degree from one factorization, with its held-out error.

use super::Residuals;
use super::factor::{Factorization, Triangle};
use super::held_out::{HeldOut, leave_one_out};
use super::reduce::ReducedCell;
use super::row::{LATTICE, Row};
use super::samples::{CellGrid, Sample, Samples};
use crate::sphere::{AngularPartition, Cap, CapBasis, Places, coefficient_count};
use rayon::prelude::*;

/// Samples per coefficient that a degree needs. In a local basis the answer with fewer oscillates
/// between the samples (a bean of 1538 points, k = 8: area +15 %).
const SAMPLES_PER_COEFFICIENT: usize = 2;

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
    /// What the segments between two polar angles share, from north to south.
    pub(crate) rows: Vec<Row>,
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
    /// everywhere, else to the samples of the whole cap round the segment, if those do.
    pub(crate) fn fit(&self, segment: usize, workspace: &mut Workspace) -> SegmentFit {
        let row = &self.rows[segment / self.partition.per_angle()];
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
            let widened = self.probes.of_cap(&cap, self.grid);
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
        triangle.whiten(&mut values, LATTICE, LATTICE, coefficient_count(top));
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
mod tests {
    use super::*;
    use crate::fit::reduce::reduce_cells;
    use crate::fit::row::rows;
    use crate::model::Frame;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
    use crate::sphere::{CapBasis, harmonics};
    use nalgebra::{Matrix3, Point3, Vector3};

    const PARTS: usize = 3;

    fn samples(points: usize, grid: &CellGrid) -> Samples {
        let options = SynthOptions {
            points,
            sampling: Sampling::Fibonacci,
            noise: 0.01,
            ..SynthOptions::clean(Body::Maize)
        };
        let frame = Frame {
            centre: Point3::origin(),
            axes: Matrix3::identity(),
        };
        let made = synthesize(&options).expect("valid options");
        Samples::new(&made.points, &frame, grid)
    }

    fn level<'a>(
        grid: &'a CellGrid,
        basis: &'a CapBasis,
        samples: &'a Samples,
        reduced: &'a [Option<ReducedCell>],
    ) -> Level<'a> {
        let partition = AngularPartition::new(PARTS);
        Level {
            partition,
            basis,
            rows: rows(partition, basis),
            grid,
            samples,
            probes: samples,
            reduced,
        }
    }

    /// Least squares in the plain harmonics by SVD, an independent route to the same function.
    fn by_harmonics(samples: &[Sample], degree: usize) -> impl Fn(&Sample) -> f64 {
        let row = move |s: &Sample| harmonics(degree, &Vector3::new(s[0], s[1], s[2]));
        let values: Vec<Vec<f64>> = samples.iter().map(row).collect();
        let design =
            nalgebra::DMatrix::from_fn(samples.len(), values[0].len(), |i, j| values[i][j]);
        let radii = nalgebra::DVector::from_fn(samples.len(), |i, _| samples[i][3]);
        let solution = design.svd(true, true).solve(&radii, 1e-13).expect("solved");
        move |s: &Sample| row(s).iter().zip(&solution).map(|(y, a)| y * a).sum()
    }

    #[test]
    fn a_segment_is_the_least_squares_fit_in_the_harmonics_at_every_degree() {
        let grid = CellGrid::new([PARTS]);
        let basis = CapBasis::new(3);
        let samples = samples(2000, &grid);
        let level = level(&grid, &basis, &samples, &[]);
        let segment = 4;
        let fit = level.fit(segment, &mut Workspace::new(3));
        let own: Vec<Sample> = level
            .runs(segment)
            .flat_map(|run| samples.run(run).to_vec())
            .collect();
        let cap = level.partition.cap(segment);
        for (degree, fit) in fit.degrees.iter().enumerate() {
            let reference = by_harmonics(&own, degree);
            for s in &own {
                let n = Vector3::new(s[0], s[1], s[2]);
                let value = basis.value(&cap, &fit.coefficients, &n);
                assert!((value - reference(s)).abs() < 1e-9, "degree {degree}");
            }
        }
    }

    #[test]
    fn the_held_out_error_is_that_of_fits_without_the_sample() {
        let grid = CellGrid::new([PARTS]);
        let basis = CapBasis::new(2);
        let samples = samples(900, &grid);
        let level = level(&grid, &basis, &samples, &[]);
        let segment = 4;
        let fit = level.fit(segment, &mut Workspace::new(2));
        let own: Vec<Sample> = level
            .runs(segment)
            .flat_map(|run| samples.run(run).to_vec())
            .collect();
        for (degree, fit) in fit.degrees.iter().enumerate() {
            let (mut squared, mut worst) = (0.0, 0.0_f64);
            for i in 0..own.len() {
                let mut others = own.clone();
                let left_out = others.remove(i);
                let error = left_out[3] - by_harmonics(&others, degree)(&left_out);
                squared += error * error;
                worst = worst.max(error.abs() / left_out[3]);
            }
            assert!((fit.held_out.squared / squared - 1.0).abs() < 1e-8);
            assert!((fit.held_out.worst / worst - 1.0).abs() < 1e-8);
            assert_eq!(fit.held_out.count, own.len());
        }
    }

    #[test]
    fn reduced_cells_give_the_fit_of_their_samples() {
        let grid = CellGrid::new([2, PARTS]);
        let basis = CapBasis::new(3);
        let samples = samples(20_000, &grid);
        let reduced = reduce_cells(&samples, &grid, &basis);
        assert!(reduced.iter().all(Option::is_some));
        let direct = level(&grid, &basis, &samples, &[]);
        let by_cells = level(&grid, &basis, &samples, &reduced);
        for segment in 0..PARTS * PARTS {
            let a = direct.fit(segment, &mut Workspace::new(3));
            let b = by_cells.fit(segment, &mut Workspace::new(3));
            assert_eq!(a.degrees.len(), b.degrees.len());
            for (a, b) in a.degrees.iter().zip(&b.degrees) {
                for (x, y) in a.coefficients.iter().zip(&b.coefficients) {
                    assert!((x - y).abs() < 1e-9 * a.coefficients[0].abs(), "{x} {y}");
                }
                assert!((a.held_out.squared / b.held_out.squared - 1.0).abs() < 1e-9);
            }
        }
    }
}
