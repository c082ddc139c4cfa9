//! The most likely spectrum of a cloud and the mean of the coefficients under it, by rounds.
//!
//! A round conditions on a spectrum, sees what the points say of each degree, and takes a step towards the
//! most likely spectrum. Of a cloud whose matrix is not factored, the first rounds take it as even
//! (N_l = n / 4 pi); then random probes tell N_l.

use super::dense::Factor;
use super::likelihood::{Evidence, hyperprior, hyperprior_curvature, positive};
use super::newton::{Newton, Next, Place};
use super::posterior::{Conditioned, Posterior};
use super::spectrum::Spectrum;
use super::stopping::SETTLED as MEAN_SETTLED;
use super::sums::Sums;
use std::sync::Arc;

/// Rounds at most; three to six are usual.
const MOST_ROUNDS: usize = 40;

/// Where the cost may fall by more than this per point, second derivatives say little.
const FAR: f64 = 0.2;

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
}

/// How the number of measurements per degree is told where no matrix is factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    /// n / 4 pi, as of an even cloud: enough to compare.
    Even,
    /// By probes.
    Probed,
}

/// Finds the most likely spectrum from `start`.
pub(crate) fn fit_spectrum(
    posterior: &Posterior<'_>,
    start: Spectrum,
    coefficients: Option<Vec<f64>>,
    count: Count,
) -> SpectrumFit {
    let points = posterior.cloud.len() as f64;
    let mut spectrum = start;
    let is_warm = coefficients.is_some();
    let mut coefficients = coefficients;
    // From the coefficients of a lower degree the spectrum is nearly right, and better than an even cloud's.
    let mut counted = match posterior.is_factored() || is_warm {
        true => count,
        false => Count::Even,
    };
    let mut newton: Option<Newton> = None;
    let mut is_last = false;
    for round in 1.. {
        let given = posterior.given(&spectrum);
        let (mean, _) = given.mean(coefficients.as_deref(), MEAN_SETTLED);
        let Told {
            evidence,
            unlearnt,
            gradient,
        } = told(posterior, &given, &spectrum, &mean, counted);
        let value = evidence.value(&spectrum).0;
        let prior = hyperprior(points, &spectrum).0;
        let cost = given.cost(&mean).map(|cost| cost + prior);
        let proposal = evidence.most_likely(&spectrum);
        let is_near = proposal.1 < FAR * points;
        let information = is_near
            .then(|| given.information(&spectrum, &mean))
            .flatten();
        let place = Place {
            spectrum,
            cost,
            gradient: gradient.into(),
            information: information
                .map(|known| positive(&(known + hyperprior_curvature(points, &spectrum)))),
            proposal,
        };
        let search = newton.get_or_insert_with(|| Newton::new(evidence.curvature(&spectrum)));
        let next = match is_last || round >= MOST_ROUNDS {
            true => Next::Here,
            false => search.next(place),
        };
        if counted == count && matches!(next, Next::Here) {
            return SpectrumFit {
                cost: cost.unwrap_or(value) - posterior.cloud.compression,
                spectrum,
                coefficients: mean,
                unlearnt: match count {
                    Count::Probed if given.factor.is_some() => given.unlearnt(),
                    _ => unlearnt,
                },
                sums: Arc::clone(&posterior.sums),
                factor: given.factor,
            };
        }
        match next {
            Next::Here => {
                counted = count;
                newton = None;
            }
            Next::Try(next) => spectrum = next,
            Next::Back(best) => {
                is_last = true;
                spectrum = best;
            }
        }
        coefficients = Some(mean);
    }
    unreachable!("rounds end")
}

/// What a round says of a spectrum.
struct Told {
    evidence: Evidence,
    /// Per degree, the share of the prior variance that the points leave.
    unlearnt: Vec<f64>,
    /// Of the exact likelihood, as far as `unlearnt` is exact:
    /// d/d log v_l = 1/2 sum_m (1 - x_lm^2 / v_l - C_mm / v_l), d/d log s = n - sum (1 - C_jj / v_j) - R / s^2.
    gradient: [f64; 4],
}

/// Squared residuals of the unshrunk coefficients are at least this share of those of the shrunk ones.
const LEAST_RESIDUALS: f64 = 1e-3;

fn told(
    posterior: &Posterior<'_>,
    given: &Conditioned<'_>,
    spectrum: &Spectrum,
    mean: &[f64],
    count: Count,
) -> Told {
    let cloud = posterior.cloud;
    let points = cloud.len() as f64;
    let noise = spectrum.noise().powi(2);
    let variances = spectrum.variances(posterior.degree());
    let unlearnt = match posterior.is_factored() || count == Count::Probed {
        true => given.probed_unlearnt(),
        false => given.even_unlearnt(),
    };
    let residuals = posterior.residuals(mean);
    let squares = residuals.iter().zip(&cloud.weights);
    let squared: f64 = squares.map(|(e, w)| w * e * e).sum();
    let mut left = squared;
    let (_, mut gradient) = hyperprior(points, spectrum);
    gradient[3] += points - squared / noise;
    let mut degrees = Vec::with_capacity(variances.len());
    for (l, (v, unlearnt)) in variances.iter().zip(&unlearnt).enumerate() {
        let orders = (2 * l + 1) as f64;
        let power: f64 = mean[l * l..(l + 1) * (l + 1)].iter().map(|x| x * x).sum();
        let slope = 0.5 * (orders * (1.0 - unlearnt) - power / v);
        for (gradient, by) in gradient.iter_mut().zip(spectrum.slopes(l)) {
            *gradient += by * slope;
        }
        let learnt = 1.0 - unlearnt;
        gradient[3] -= orders * learnt;
        let measured = noise / v * (learnt / unlearnt);
        let unshrunk = power / (learnt * learnt);
        left -= measured * unshrunk * unlearnt * unlearnt;
        degrees.push([measured, unshrunk]);
    }
    Told {
        evidence: Evidence {
            points,
            degrees,
            residuals: left.max(LEAST_RESIDUALS * squared),
        },
        unlearnt,
        gradient,
    }
}
