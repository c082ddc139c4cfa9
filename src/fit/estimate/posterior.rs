//! What is known of the coefficients once a spectrum is given: their mean and covariance.
//!
//! With Y the harmonics in the points' directions, W the weights and V the variances of the spectrum, the
//! coefficients given the radii y are normal with the covariance C = (Y'WY / s^2 + V^-1)^-1 and the mean
//! C Y'W y / s^2. Either the matrix is formed and factored, scaled by V so that it is safe
//! (I + V^1/2 Y'WY V^1/2 / s^2, condition bounded by the data), or systems are solved by conjugate
//! gradients, preconditioned by the matrix of an even cloud.

use super::cloud::Cloud;
use super::spectrum::Spectrum;
use super::stopping::{Enough, SHARE};
use super::sums::Sums;
use crate::sphere::{HarmonicBasis, coefficient_count};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::solvers::{Llt, Solve};
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::{Accum, Mat, MatMut, MatRef, Par, Side};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::sync::{Arc, OnceLock};

/// A cloud ready to be conditioned on.
pub(crate) struct Posterior<'a> {
    pub(crate) cloud: &'a Cloud,
    pub(super) sums: Arc<Sums>,
    /// Y'WY, where systems are solved by factoring.
    gram: Option<Mat<f64>>,
    /// Y'W y, once it is asked for.
    right: OnceLock<Vec<f64>>,
}

/// The matrix is factored where there are more coefficients per point than this: beyond .6 the cheap way fails on
/// uneven clouds; ...
const FACTORED: f64 = 0.45;

/// ... but only of clouds up to this size, whose matrices of degree 36 take 30 ms.
const MOST_FACTORED: usize = 3000;

/// Whether the matrix of so many points should be formed and factored.
pub(super) fn is_factored(points: usize, degree: usize) -> bool {
    points <= MOST_FACTORED && coefficient_count(degree) as f64 > FACTORED * points as f64
}

/// Points whose part of the design matrix is formed at once.
const BLOCK: usize = 512;

impl<'a> Posterior<'a> {
    /// Prepares a cloud for harmonics up to `degree`; `factored` says whether to form and factor the matrix.
    pub(crate) fn new(cloud: &'a Cloud, degree: usize, factored: bool) -> Self {
        let gram = factored.then(|| gram(cloud, degree));
        Self {
            gram,
            ..Self::with(cloud, Arc::new(Sums::new(degree)))
        }
    }

    /// The same of a cloud whose sums are at hand; nothing is factored.
    pub(super) fn with(cloud: &'a Cloud, sums: Arc<Sums>) -> Self {
        Self {
            cloud,
            sums,
            gram: None,
            right: OnceLock::new(),
        }
    }

    /// The posterior for a spectrum.
    pub(crate) fn given(&self, spectrum: &Spectrum) -> Conditioned<'_> {
        let mut given = self.given_factored(spectrum, None);
        given.factor = self
            .gram
            .as_ref()
            .and_then(|gram| factor(gram, &given.variances, given.noise))
            .map(Arc::new);
        given
    }

    /// The posterior for a spectrum whose matrix has been factored before, or is not.
    pub(crate) fn given_factored(
        &self,
        spectrum: &Spectrum,
        factor: Option<Arc<Llt<f64>>>,
    ) -> Conditioned<'_> {
        let degrees = spectrum.variances(self.degree());
        let variances = degrees
            .iter()
            .enumerate()
            .flat_map(|(l, &v)| std::iter::repeat_n(v, 2 * l + 1));
        Conditioned {
            posterior: self,
            variances: variances.collect(),
            degrees,
            noise: spectrum.noise().powi(2),
            factor,
        }
    }

    /// The largest degree.
    pub(crate) fn degree(&self) -> usize {
        self.sums.degree()
    }

    /// Whether the matrix is formed and factored.
    pub(crate) fn is_factored(&self) -> bool {
        self.gram.is_some()
    }

    /// The radii that coefficients give at the points.
    pub(crate) fn radii(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut radii = vec![0.0; self.cloud.len()];
        self.sums
            .harmonics(self.cloud)
            .synthesis(coefficients, &mut radii);
        radii
    }

    /// Y' times a value per point.
    pub(super) fn adjoint(&self, values: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; coefficient_count(self.degree())];
        self.sums.harmonics(self.cloud).adjoint(values, &mut sums);
        sums
    }

    /// Measured less fitted radii.
    pub(crate) fn residuals(&self, coefficients: &[f64]) -> Vec<f64> {
        let fitted = self.radii(coefficients);
        let pairs = self.cloud.radii.iter().zip(fitted);
        pairs.map(|(measured, fitted)| measured - fitted).collect()
    }
}

/// The Cholesky factor of I + V^1/2 Y'WY V^1/2 / s^2.
fn factor(gram: &Mat<f64>, variances: &[f64], noise: f64) -> Option<Llt<f64>> {
    let root: Vec<f64> = variances.iter().map(|v| v.sqrt()).collect();
    let count = root.len();
    let mut matrix = Mat::zeros(count, count);
    for j in 0..count {
        let (from, to) = (gram.col_as_slice(j), matrix.col_as_slice_mut(j));
        let scale = root[j] / noise;
        for i in j..count {
            to[i] = from[i] * root[i] * scale;
        }
        to[j] += 1.0;
    }
    matrix.llt(Side::Lower).ok()
}

/// Y'WY, lower triangle.
fn gram(cloud: &Cloud, degree: usize) -> Mat<f64> {
    let basis = HarmonicBasis::new(degree);
    let count = coefficient_count(degree);
    let mut gram = Mat::zeros(count, count);
    let mut rows = vec![0.0; BLOCK * count];
    let points = cloud
        .directions
        .chunks(BLOCK)
        .zip(cloud.weights.chunks(BLOCK));
    for (directions, weights) in points {
        let block = directions.len();
        for ((n, weight), row) in directions
            .iter()
            .zip(weights)
            .zip(rows.chunks_exact_mut(count))
        {
            basis.evaluate(n, row);
            let root = weight.sqrt();
            row.iter_mut().for_each(|value| *value *= root);
        }
        // One column per point.
        let design = MatRef::from_column_major_slice(&rows[..block * count], count, block);
        triangular::matmul(
            gram.as_mut(),
            BlockStructure::TriangularLower,
            Accum::Add,
            design,
            BlockStructure::Rectangular,
            design.transpose(),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
    }
    gram
}

/// The posterior for a spectrum.
pub(crate) struct Conditioned<'a> {
    pub(super) posterior: &'a Posterior<'a>,
    /// v_l per degree, and of every coefficient.
    degrees: Vec<f64>,
    pub(super) variances: Vec<f64>,
    /// s^2.
    pub(super) noise: f64,
    /// The Cholesky factor of I + V^1/2 Y'WY V^1/2 / s^2.
    pub(super) factor: Option<Arc<Llt<f64>>>,
}

/// Random vectors by which traces are estimated.
const PROBES: usize = 4;

/// They are solved for until so much of the squared error per coefficient is left: the traces are then good to a
/// percent, far less than by what four vectors scatter.
const PROBES_SETTLED: f64 = 2e-3;

impl Conditioned<'_> {
    /// The mean of the coefficients, found from `start`, and the number of steps that it took.
    pub(crate) fn mean(&self, start: Option<&[f64]>, settled: f64) -> (Vec<f64>, usize) {
        let Posterior {
            cloud, sums, right, ..
        } = self.posterior;
        let right = right.get_or_init(|| sums.weighted(cloud, &cloud.radii));
        let right: Vec<f64> = right.iter().map(|b| b / self.noise).collect();
        self.solve(&right, start, settled)
    }

    /// The exact negative logarithm of the likelihood, where the matrix is factored:
    /// 1/2 [n log s^2 + log det(I + V^1/2 Y'WY V^1/2 / s^2) + (y'Wy - y'WY x) / s^2].
    pub(crate) fn cost(&self, mean: &[f64]) -> Option<f64> {
        let factor = self.factor.as_ref()?.L();
        let cloud = self.posterior.cloud;
        let log_determinant: f64 = (0..factor.nrows()).map(|j| factor[(j, j)].ln()).sum();
        // y'Wy - y'WY x without cancellation: the weighted squares of the residuals and x'V^-1 x s^2.
        let residuals = self.posterior.residuals(mean);
        let squared = residuals.iter().zip(&cloud.weights);
        let squared: f64 = squared.map(|(e, w)| w * e * e).sum();
        let shrunk = mean.iter().zip(&self.variances);
        let shrunk: f64 = shrunk.map(|(x, v)| x * x / v).sum();
        Some(
            0.5 * (cloud.len() as f64 * self.noise.ln() + squared / self.noise + shrunk)
                + log_determinant,
        )
    }

    /// C g: the covariances of linear functionals g with every coefficient, good to a few percent of the variances.
    pub(crate) fn covariances(&self, functionals: &[Vec<f64>]) -> Vec<Vec<f64>> {
        match &self.factor {
            Some(factor) => self.solve_factored(factor, functionals),
            None => functionals
                .iter()
                .map(|g| self.conjugate_gradients(g, None, Enough::Share(SHARE)).0)
                .collect(),
        }
    }

    fn solve(&self, right: &[f64], start: Option<&[f64]>, settled: f64) -> (Vec<f64>, usize) {
        let Some(factor) = &self.factor else {
            return self.conjugate_gradients(right, start, Enough::Energy(settled));
        };
        let found = self.solve_factored(factor, &[right]);
        (found.into_iter().next().unwrap_or_default(), 0)
    }

    fn solve_factored(&self, factor: &Llt<f64>, rights: &[impl AsRef<[f64]>]) -> Vec<Vec<f64>> {
        let count = self.variances.len();
        let roots: Vec<f64> = self.variances.iter().map(|v| v.sqrt()).collect();
        let mut all: Vec<f64> = rights
            .iter()
            .flat_map(|right| right.as_ref().iter().zip(&roots).map(|(b, root)| b * root))
            .collect();
        factor.solve_in_place(MatMut::from_column_major_slice_mut(
            &mut all,
            count,
            rights.len(),
        ));
        all.chunks_exact(count)
            .map(|x| x.iter().zip(&roots).map(|(x, root)| x * root).collect())
            .collect()
    }

    /// Per degree, the share of the prior variance that the points leave: the mean of C_mm / v_l.
    pub(crate) fn unlearnt(&self) -> Vec<f64> {
        let diagonal = match &self.factor {
            Some(factor) => inverse_diagonal(factor),
            None => self.probed_diagonal(),
        };
        (0..self.degrees.len())
            .map(|l| {
                let own = &diagonal[l * l..(l + 1) * (l + 1)];
                own.iter().sum::<f64>() / own.len() as f64
            })
            .collect()
    }

    /// Estimates of C_jj / v_j whose means are right: h'C h of random signs h over the roots of v.
    fn probed_diagonal(&self) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let mut diagonal = vec![0.0; self.variances.len()];
        let settled = PROBES_SETTLED * diagonal.len() as f64;
        for _ in 0..PROBES {
            let probe: Vec<f64> = self
                .variances
                .iter()
                .map(|v| if random.next_u32() & 1 == 0 { 1.0 } else { -1.0 } / v.sqrt())
                .collect();
            let (solution, _) = self.solve(&probe, None, settled);
            for ((diagonal, h), z) in diagonal.iter_mut().zip(&probe).zip(&solution) {
                *diagonal += h * z / PROBES as f64;
            }
        }
        diagonal
    }
}

/// The diagonal of the inverse of a factored matrix.
fn inverse_diagonal(factor: &Llt<f64>) -> Vec<f64> {
    let l = factor.L();
    let count = l.nrows();
    let mut inverse = Mat::zeros(count, count);
    invert_lower_triangular(inverse.as_mut(), l, Par::Seq);
    (0..count)
        .map(|j| inverse.col_as_slice(j)[j..].iter().map(|x| x * x).sum())
        .collect()
}
