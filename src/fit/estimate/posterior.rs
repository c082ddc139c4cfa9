//! What is known of the coefficients once a spectrum is given: their mean and covariance.
//!
//! With Y the harmonics in the points' directions, W the weights and V the variances of the spectrum, the
//! coefficients given the radii y are normal with the covariance C = (Y'WY / s^2 + V^-1)^-1 and the mean
//! C Y'W y / s^2. Either C^-1 is formed and factored, of few points and where conjugate gradients turn out to be
//! [hard](super::stopping::HARD), or systems are solved by these, preconditioned by the matrix of an even cloud.

use super::cloud::Cloud;
use super::dense::Factor;
use super::spectrum::Spectrum;
use super::stopping::{Enough, SHARE};
use super::sums::Sums;
use crate::sphere::{LowerTriangle, coefficient_count};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// A cloud ready to be conditioned on.
pub(crate) struct Posterior<'a> {
    pub(crate) cloud: &'a Cloud,
    pub(super) sums: Arc<Sums>,
    /// Y'WY, where systems are solved by factoring.
    gram: Option<Gram>,
    /// Y'W y, once it is asked for.
    right: OnceLock<Vec<f64>>,
}

/// Y'WY in memory: in single precision, and in double from when that is not enough.
struct Gram {
    single: LowerTriangle<f32>,
    double: OnceLock<LowerTriangle<f64>>,
}

/// The matrix is factored where there are more coefficients per point than this: beyond .6 the cheap way fails on
/// uneven clouds; ...
const FACTORED: f64 = 0.45;

/// ... but only of clouds up to this size, whose matrices of degree 36 take 30 ms.
pub(super) const MOST_FACTORED: usize = 3000;

/// 1 or -1, as often.
pub(super) fn sign(random: &mut ChaCha8Rng) -> f64 {
    match random.next_u32() & 1 {
        0 => 1.0,
        _ => -1.0,
    }
}

/// Whether the matrix of so many points may be formed and factored.
pub(super) fn is_small(points: usize) -> bool {
    points <= MOST_FACTORED
}

/// Whether it must be.
pub(super) fn is_factored(points: usize, degree: usize) -> bool {
    is_small(points) && coefficient_count(degree) as f64 > FACTORED * points as f64
}

impl<'a> Posterior<'a> {
    /// Prepares a cloud for harmonics up to `degree`; `factored` says whether to form and factor the matrix.
    pub(crate) fn new(cloud: &'a Cloud, degree: usize, factored: bool) -> Self {
        let posterior = Self::with(cloud, Arc::new(Sums::new(degree)));
        let gram = factored.then(|| Gram {
            single: posterior.sums.gram(cloud).lower_triangle(),
            double: OnceLock::new(),
        });
        Self { gram, ..posterior }
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
            .and_then(|gram| self.factor(gram, &given))
            .map(Arc::new);
        given
    }

    fn factor(&self, gram: &Gram, given: &Conditioned<'_>) -> Option<Factor> {
        let (variances, noise) = (&given.variances, given.noise);
        let is_enough = gram.double.get().is_none();
        let single = is_enough.then(|| Factor::single(&gram.single, variances, noise));
        single.flatten().or_else(|| {
            let double = || self.sums.gram(self.cloud).lower_triangle();
            Factor::double(gram.double.get_or_init(double), variances, noise)
        })
    }

    /// The posterior for a spectrum whose matrix has been factored before, or is not.
    pub(crate) fn given_factored(
        &self,
        spectrum: &Spectrum,
        factor: Option<Arc<Factor>>,
    ) -> Conditioned<'_> {
        let degrees = spectrum.variances(self.degree());
        let orders: Vec<f64> = (0..degrees.len())
            .flat_map(|l| spectrum.orders(l))
            .collect();
        let own = degrees.iter().enumerate();
        let own = own.flat_map(|(l, &v)| std::iter::repeat_n(v, 2 * l + 1));
        Conditioned {
            posterior: self,
            variances: own.zip(&orders).map(|(v, share)| v * share).collect(),
            degrees,
            orders,
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

    /// Makes what is needed to multiply by Y'WY. Threads that waited for one of them to make it could be given each other's
    /// work and wait for ever, so it is made before they share any.
    pub(super) fn make_gram(&self) {
        self.sums.gram(self.cloud);
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

    /// Weighted mean square of the residuals.
    pub(super) fn mean_square(&self, coefficients: &[f64]) -> f64 {
        self.cloud.mean_square(self.residuals(coefficients))
    }

    /// Measured less fitted radii.
    pub(crate) fn residuals(&self, coefficients: &[f64]) -> Vec<f64> {
        let fitted = self.radii(coefficients);
        let pairs = self.cloud.radii.iter().zip(fitted);
        pairs.map(|(measured, fitted)| measured - fitted).collect()
    }
}

/// The posterior for a spectrum.
pub(crate) struct Conditioned<'a> {
    pub(super) posterior: &'a Posterior<'a>,
    /// v_l per degree, the share of every coefficient in it, and its own variance.
    pub(super) degrees: Vec<f64>,
    pub(super) orders: Vec<f64>,
    pub(super) variances: Vec<f64>,
    /// s^2.
    pub(super) noise: f64,
    /// C^-1, factored.
    pub(super) factor: Option<Arc<Factor>>,
}

/// What was solved for probes, in units of the prior standard deviations, in which it changes little with the spectrum.
pub(super) struct Solved(Vec<Vec<f64>>);

/// Random vectors by which traces are estimated.
const PROBES: usize = 4;

/// The same where the matrix is factored, and each costs little.
const FACTORED_PROBES: usize = 16;

/// Shares that the points leave are kept within these bounds, whatever the probes say.
const SHARES: [f64; 2] = [1e-15, 1.0 - 1e-9];

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
        let log_determinant = self.factor.as_ref()?.log_root_determinant();
        let cloud = self.posterior.cloud;
        // y'Wy - y'WY x without cancellation: the weighted squares of the residuals and x'V^-1 x s^2.
        let squared = cloud.squares(self.posterior.residuals(mean));
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
            None => self.solve_each(functionals, |_| None, Enough::Share(SHARE)),
        }
    }

    fn solve(&self, right: &[f64], start: Option<&[f64]>, settled: f64) -> (Vec<f64>, usize) {
        match &self.factor {
            None => self.conjugate_gradients(right, start, Enough::Energy(settled)),
            Some(factor) if factor.is_double() => {
                let mut solved = right.to_vec();
                factor.solve(&mut solved);
                (solved, 0)
            }
            Some(factor) => self.refined(factor, right),
        }
    }

    pub(super) fn solve_factored(
        &self,
        factor: &Factor,
        rights: &[impl AsRef<[f64]>],
    ) -> Vec<Vec<f64>> {
        let rights: Vec<&[f64]> = rights.iter().map(AsRef::as_ref).collect();
        let mut all = rights.concat();
        factor.solve(&mut all);
        let columns = all.chunks_exact(self.variances.len());
        columns.map(<[f64]>::to_vec).collect()
    }

    /// Per degree, the share of the prior variance that the points leave: the mean of C_mm over the variance of the order,
    /// by probes of the variances themselves. The mean variance of the radius is then good to a percent.
    pub(crate) fn unlearnt(&self) -> Vec<f64> {
        self.per_degree(&self.probed_diagonal(|_| 1.0, None).0)
    }

    /// The same by probes of the shares: their sum is good to a percent, and so is a step of a search. Also tells what was
    /// solved for them, from which another spectrum may start.
    pub(super) fn unlearnt_shares(&self, start: Option<&Solved>) -> (Vec<f64>, Solved) {
        let (diagonal, solved) = self.probed_diagonal(|v| 1.0 / v.sqrt(), start);
        let solved = solved.iter().map(|x| self.whitened(x)).collect();
        (self.per_degree(&diagonal), Solved(solved))
    }

    /// The same, as of an even cloud.
    pub(super) fn even_unlearnt(&self) -> Vec<f64> {
        let even = self.posterior.cloud.len() as f64 / (4.0 * PI);
        let share = |v: &f64| self.noise / (even * v + self.noise);
        let shares = self.degrees.iter().map(share);
        shares.map(|q| q.clamp(SHARES[0], SHARES[1])).collect()
    }

    fn per_degree(&self, diagonal: &[f64]) -> Vec<f64> {
        (0..self.degrees.len())
            .map(|l| {
                let own = &diagonal[l * l..(l + 1) * (l + 1)];
                let mean = own.iter().sum::<f64>() / own.len() as f64;
                mean.clamp(SHARES[0], SHARES[1])
            })
            .collect()
    }

    /// Estimates of C_jj / v_j whose means are right: h_j (C h)_j over the square of h_j, where h has random signs and a
    /// size by the variance v_j. Its scatter is that of all variances in units of these sizes. Also C h.
    fn probed_diagonal(
        &self,
        size: impl Fn(&f64) -> f64,
        start: Option<&Solved>,
    ) -> (Vec<f64>, Vec<Vec<f64>>) {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let count = self.variances.len();
        let probes = match self.factor {
            Some(_) => FACTORED_PROBES,
            None => PROBES,
        };
        let sizes: Vec<f64> = self.variances.iter().map(size).collect();
        let probes: Vec<Vec<f64>> = (0..probes)
            .map(|_| {
                let signs = sizes.iter().map(|size| sign(&mut random) * size);
                signs.collect()
            })
            .collect();
        let settled = Enough::Energy(PROBES_SETTLED * count as f64);
        let solved = match &self.factor {
            Some(factor) => self.solve_factored(factor, &probes),
            None => {
                let start = |i: usize| start.map(|solved| self.unwhitened(&solved.0[i]));
                self.solve_each(&probes, start, settled)
            }
        };
        let mut diagonal = vec![0.0; count];
        for (probe, solution) in probes.iter().zip(&solved) {
            for ((diagonal, h), z) in diagonal.iter_mut().zip(probe).zip(solution) {
                *diagonal += z / (h * probes.len() as f64);
            }
        }
        for (diagonal, v) in diagonal.iter_mut().zip(&self.variances) {
            *diagonal /= v;
        }
        (diagonal, solved)
    }

    /// Coefficients in units of their prior standard deviations.
    fn whitened(&self, x: &[f64]) -> Vec<f64> {
        x.iter()
            .zip(&self.variances)
            .map(|(x, v)| x / v.sqrt())
            .collect()
    }

    /// Coefficients from what they are in these units.
    fn unwhitened(&self, x: &[f64]) -> Vec<f64> {
        x.iter()
            .zip(&self.variances)
            .map(|(x, v)| x * v.sqrt())
            .collect()
    }
}
