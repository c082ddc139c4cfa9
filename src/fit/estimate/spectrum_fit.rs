//! A spectrum of a cloud, and the mean of the coefficients under it.

use super::cloud::Cloud;
use super::dense::Factor;
use super::likelihood::largest_by_chance;
use super::outcome::{learnt, variance};
use super::posterior::Posterior;
use super::spectrum::{HIGHEST, Spectrum};
use super::sums::Sums;
use crate::fit::prepare::Sample;
use crate::sphere::{ScatteredHarmonics, coefficient_count};
use std::f64::consts::PI;
use std::sync::Arc;

/// A spectrum and the coefficients under it.
#[derive(Debug, Clone)]
pub(crate) struct SpectrumFit {
    pub(crate) spectrum: Spectrum,
    /// Mean of the coefficients, in units of the mean radius.
    pub(crate) coefficients: Vec<f64>,
    /// Per degree, the share of the prior variance that the points leave.
    pub(crate) unlearnt: Vec<f64>,
    /// Negative logarithm of the likelihood.
    pub(crate) cost: f64,
    /// Sums over the harmonics in the directions of its cloud.
    pub(crate) sums: Arc<Sums>,
    /// The factored matrix, where it is factored.
    pub(crate) factor: Option<Arc<Factor>>,
    /// Whether conjugate gradients for the mean were hard, and the matrix is better factored.
    pub(crate) is_hard: bool,
}

/// A surface is small when it is so, as RMS, beside this share of the standard deviation of the estimate ...
const SMALL: f64 = 0.1;

/// ... or beside this share of the mean radius.
const SMALLEST: f64 = 2e-5;

/// What is expected may be so much more than what is small: a power law goes on where the spectrum of a smooth body ends.
const NOT_MUCH: f64 = 1.5;

impl SpectrumFit {
    /// Whether a surface of so large a mean square is small beside the error of the estimate.
    pub(crate) fn hides(&self, square: f64) -> bool {
        let variance = variance(&self.spectrum, &self.unlearnt);
        square <= (SMALL * SMALL * variance).max(SMALLEST * SMALLEST)
    }

    /// Whether an estimate of degree `to`, of so many points, is expected to find little above `from`, beside its error, or not
    /// much more.
    pub(crate) fn expects_little(&self, from: usize, to: usize, points: usize) -> bool {
        let spectrum = self.spectrum.raised(self.sums.degree(), to);
        let of_one = 4.0 * PI / points as f64 * spectrum.noise().powi(2);
        let learnt = |(l, v): (usize, f64)| (2 * l + 1) as f64 * v * v / (v + of_one);
        let variances = spectrum.variances(to).into_iter().enumerate();
        let found: f64 = variances.skip(from + 1).map(learnt).sum();
        self.hides(found / (4.0 * PI * NOT_MUCH))
    }

    /// By how much points of its cloud that are left out are missed, as RMS: generalized cross-validation (Golub, Heath, Wahba
    /// 1979).
    pub(crate) fn held_out(&self, cloud: &Cloud) -> f64 {
        let posterior = Posterior::with(cloud, Arc::clone(&self.sums));
        let left = posterior.mean_square(&self.coefficients).sqrt();
        left / (1.0 - learnt(&self.unlearnt) / cloud.len() as f64)
    }

    /// Measured less fitted radii of samples, in the cloud's stretched space and unit.
    pub(super) fn residuals(&self, samples: &[Sample], cloud: &Cloud) -> Vec<f64> {
        let mapped = Cloud::mapped(samples, cloud.stretch, cloud.mean);
        let (directions, measured): (Vec<_>, Vec<_>) = mapped.into_iter().unzip();
        let mut fitted = vec![0.0; directions.len()];
        let harmonics = ScatteredHarmonics::new(self.sums.degree(), &directions);
        harmonics.synthesis(&self.coefficients, &mut fitted);
        let pairs = measured.iter().zip(fitted);
        pairs.map(|(measured, fitted)| measured - fitted).collect()
    }

    /// Whether residuals hold more of some degree above its own, up to one, than chance puts there of residuals that have nothing
    /// to do with each other: (2l + 1) / 4 pi of the sum of their weighted squares.
    pub(crate) fn leaves_waves(&self, cloud: &Cloud, to: usize) -> bool {
        let own = self.sums.degree();
        let mut coefficients = self.coefficients.clone();
        coefficients.resize(coefficient_count(to), 0.0);
        let posterior = Posterior::with(cloud, Arc::new(Sums::new(to)));
        let residuals = posterior.residuals(&coefficients).into_iter();
        let weighted: Vec<f64> = residuals.zip(&cloud.weights).map(|(e, w)| e * w).collect();
        let squares: f64 = weighted.iter().map(|x| x * x).sum();
        let sums = posterior.adjoint(&weighted);
        (own + 1..=to).any(|l| {
            let orders = (2 * l + 1) as f64;
            let power: f64 = sums[l * l..(l + 1) * (l + 1)].iter().map(|x| x * x).sum();
            let expected = orders / (4.0 * PI) * squares;
            power > expected * (1.0 + largest_by_chance(orders))
        })
    }

    /// Whether the prior expects nothing to speak of beyond its degree.
    pub(crate) fn is_enough(&self) -> bool {
        let variance = variance(&self.spectrum, &self.unlearnt);
        self.spectrum.power(self.sums.degree(), HIGHEST) <= SMALL * SMALL * variance
    }
}
