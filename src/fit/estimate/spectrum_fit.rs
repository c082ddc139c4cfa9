//! The most likely spectrum of a cloud and the mean of the coefficients under it, by rounds.
//!
//! A round conditions on a spectrum, sees what the points say of each degree, and takes a step towards the
//! most likely spectrum. Of a cloud whose matrix is not factored, the first rounds take it as even
//! (N_l = n / 4 pi); then random probes tell N_l.

use super::cloud::Cloud;
use super::dense::Factor;
use super::likelihood::{Evidence, hyperprior, hyperprior_curvature, positive};
use super::newton::{Newton, Next, Place};
use super::outcome::{learnt, variance};
use super::posterior::{Conditioned, Posterior, Solved};
use super::spectrum::{HIGHEST, PARAMETERS, Spectrum};
use super::stopping::{GUESSED, HARD, MOST_FACTORED_DEGREE, ROUGHLY_SETTLED, SETTLED};
use super::sums::Sums;
use crate::fit::prepare::Sample;
use crate::sphere::ScatteredHarmonics;
use std::f64::consts::PI;
use std::sync::Arc;

/// Rounds at most; three to six are usual.
const MOST_ROUNDS: usize = 40;

/// Where the cost may fall by more than this per point, second derivatives say little.
const FAR: f64 = 0.2;

/// The evidence of uneven points may promise texture that is not there: where the exact likelihood begins so much worse, in
/// its logarithm, the search for it is given up. Of kernels that begin 3 to 164 worse it mostly ends better, of those that
/// begin 650 to 57 000 worse it ends 9 to 50 worse, after eight rounds.
const HOPELESS: f64 = 200.0;

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
    /// Whether conjugate gradients for the mean were [hard](HARD), and the matrix is better factored.
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

    /// Whether the prior expects nothing to speak of beyond its degree.
    pub(crate) fn is_enough(&self) -> bool {
        let variance = variance(&self.spectrum, &self.unlearnt);
        self.spectrum.power(self.sums.degree(), HIGHEST) <= SMALL * SMALL * variance
    }
}

/// How the number of measurements per degree is told where no matrix is factored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    /// n / 4 pi, as of an even cloud: enough to compare.
    Even,
    /// By probes.
    Probed,
}

impl Count {
    /// When conjugate gradients for the mean end.
    fn settled(self) -> f64 {
        match self {
            Self::Even => ROUGHLY_SETTLED,
            Self::Probed => SETTLED,
        }
    }

    /// What steps promise when the search ends. A fit hardly changes with a spectrum that is as likely as the best but for a
    /// factor of three, but costs are compared closer than that.
    fn enough(self) -> f64 {
        match self {
            Self::Even => 0.3,
            Self::Probed => 1.0,
        }
    }
}

/// Finds the most likely spectrum from `start`; ends at once where conjugate gradients for the mean are [hard](HARD).
pub(crate) fn fit_spectrum(
    posterior: &Posterior<'_>,
    start: Spectrum,
    coefficients: Option<Vec<f64>>,
    count: Count,
) -> SpectrumFit {
    let is_warm = coefficients.is_some();
    let (mut spectrum, mut coefficients) = (start, coefficients);
    // From the coefficients of a lower degree the spectrum is nearly right, and better than an even cloud's.
    let mut counted = match posterior.is_factored() || is_warm {
        true => count,
        false => Count::Even,
    };
    let mut newton: Option<Newton> = None;
    let mut is_last = false;
    let mut solved = None;
    let mut smooth: Option<Look<'_>> = None;
    for round in 1.. {
        let mut look = Look::new(
            posterior,
            &spectrum,
            coefficients.as_deref(),
            solved.as_ref(),
            counted,
        );
        let is_first = newton.is_none();
        if look.is_hard() && count == Count::Probed {
            return look.fit();
        }
        if let Some(smooth) = smooth.take_if(|smooth| is_first && look.is_worse(smooth, HOPELESS)) {
            return smooth.fit();
        }
        let search = newton.get_or_insert_with(|| Newton::new(counted.enough()));
        let next = match is_last || round >= MOST_ROUNDS {
            true => Next::Here,
            false => search.next(look.place),
        };
        match next {
            Next::Here => {
                let textured = smooth.is_none().then(|| look.textured()).flatten();
                if counted == count && textured.is_none() {
                    let likelier = smooth.filter(|smooth| look.is_worse(smooth, 0.0));
                    return likelier.unwrap_or(look).fit();
                }
                counted = count;
                newton = None;
                if let Some(textured) = textured {
                    spectrum = textured;
                    solved = look.told.solved.take();
                    coefficients = Some(look.mean.clone());
                    smooth = Some(look);
                    continue;
                }
            }
            Next::Try(next) => spectrum = next,
            Next::Back(best) => {
                is_last = true;
                spectrum = best;
            }
        }
        solved = look.told.solved.take();
        coefficients = Some(look.mean);
    }
    unreachable!("rounds end")
}

/// The first step of that search: where it leads to, and the cost that it promises there. Coefficients are those of the
/// start, and nothing is factored yet.
pub(crate) fn first_step(posterior: &Posterior<'_>, start: Spectrum) -> SpectrumFit {
    let look = Look::new(posterior, &start, None, None, Count::Even);
    let mut search = Newton::new(Count::Even.enough());
    let next = search.next(look.place);
    let mut fit = look.fit();
    fit.factor = None;
    if let Next::Try(next) = next {
        fit.cost -= search.promise();
        fit.spectrum = next;
    }
    fit
}

/// A spectrum, what the points say of it, and the coefficients under it.
struct Look<'a> {
    given: Conditioned<'a>,
    place: Place,
    mean: Vec<f64>,
    /// Steps that it took.
    steps: usize,
    told: Told,
}

impl<'a> Look<'a> {
    fn new(
        posterior: &'a Posterior<'_>,
        spectrum: &Spectrum,
        coefficients: Option<&[f64]>,
        solved: Option<&Solved>,
        count: Count,
    ) -> Self {
        let points = posterior.cloud.len() as f64;
        let given = posterior.given(spectrum);
        if !posterior.is_factored() {
            posterior.make_gram();
        }
        let settled = coefficients.map_or(GUESSED, |_| count.settled());
        let ((mean, steps), shares) = rayon::join(
            || given.mean(coefficients, settled),
            || unlearnt_shares(&given, solved, count),
        );
        let told = told(posterior, &given, spectrum, &mean, shares);
        let prior = hyperprior(points, spectrum).0;
        let proposal = told.evidence.most_likely(spectrum);
        let is_near = proposal.1 < FAR * points;
        let information = is_near
            .then(|| given.information(spectrum, &mean))
            .flatten();
        let place = Place {
            spectrum: *spectrum,
            cost: given.cost(&mean).map(|cost| cost + prior),
            gradient: told.gradient.into(),
            information: information
                .map(|known| positive(&(known + hyperprior_curvature(points, spectrum)))),
            proposal,
            curvature: told.evidence.curvature(spectrum),
        };
        Self {
            given,
            place,
            mean,
            steps,
            told,
        }
    }

    fn is_hard(&self) -> bool {
        let posterior = self.given.posterior;
        let may_be_factored = posterior.degree() <= MOST_FACTORED_DEGREE;
        self.steps > HARD && may_be_factored && !posterior.is_factored()
    }

    /// A spectrum with texture that is clearly likelier, where this one has none.
    fn textured(&self) -> Option<Spectrum> {
        let spectrum = &self.place.spectrum;
        match spectrum.is_smooth() {
            true => self.told.evidence.textured(spectrum),
            false => None,
        }
    }

    /// Whether the points are less likely by more than this, as far as both likelihoods are exact.
    fn is_worse(&self, other: &Self, by: f64) -> bool {
        let costs = self.place.cost.zip(other.place.cost);
        costs.is_some_and(|(own, other)| own > other + by)
    }

    fn fit(self) -> SpectrumFit {
        let is_hard = self.is_hard();
        let Self {
            given,
            place,
            mean,
            told,
            ..
        } = self;
        let value = || told.evidence.value(&place.spectrum).0;
        SpectrumFit {
            cost: place.cost.unwrap_or_else(value) - given.posterior.cloud.compression,
            spectrum: place.spectrum,
            coefficients: mean,
            unlearnt: match given.factor.is_some()
                || are_doubtful(&given, &place.spectrum, &told.unlearnt)
            {
                true => given.unlearnt(),
                false => told.unlearnt,
            },
            sums: Arc::clone(&given.posterior.sums),
            factor: given.factor,
            is_hard,
        }
    }
}

/// Probes of the shares tell the variance of the radius of an even cloud to some percent. Of an uneven one, where
/// coefficients of low degrees depend on those of high ones, they scatter: with half of the points eight times thinner its
/// root was 2 to 7 times the true one.
const MOST_SCATTERED: f64 = 1.5;

/// Whether shares differ from those of an even cloud by enough to doubt them.
fn are_doubtful(given: &Conditioned<'_>, spectrum: &Spectrum, unlearnt: &[f64]) -> bool {
    let ratio = variance(spectrum, unlearnt) / variance(spectrum, &given.even_unlearnt());
    !(1.0 / MOST_SCATTERED..MOST_SCATTERED).contains(&ratio)
}

/// What a round says of a spectrum.
struct Told {
    evidence: Evidence,
    /// Per degree, the share of the prior variance that the points leave.
    unlearnt: Vec<f64>,
    /// Of the exact likelihood, as far as `unlearnt` is exact:
    /// d/d log v_l = 1/2 sum_m (1 - x_lm^2 / v_l - C_mm / v_l), d/d log s = n - sum (1 - C_jj / v_j) - R / s^2.
    gradient: [f64; PARAMETERS],
    /// What was solved for it, where the matrix was probed.
    solved: Option<Solved>,
}

/// Squared residuals of the unshrunk coefficients are at least this share of those of the shrunk ones.
const LEAST_RESIDUALS: f64 = 1e-3;

/// Per degree, the share of the prior variance that the points leave, and what was solved for it, from `solved` on.
fn unlearnt_shares(
    given: &Conditioned<'_>,
    solved: Option<&Solved>,
    count: Count,
) -> (Vec<f64>, Option<Solved>) {
    match given.posterior.is_factored() || count == Count::Probed {
        true => {
            let (unlearnt, solved) = given.unlearnt_shares(solved);
            (unlearnt, Some(solved))
        }
        false => (given.even_unlearnt(), None),
    }
}

fn told(
    posterior: &Posterior<'_>,
    given: &Conditioned<'_>,
    spectrum: &Spectrum,
    mean: &[f64],
    (unlearnt, solved): (Vec<f64>, Option<Solved>),
) -> Told {
    let cloud = posterior.cloud;
    let points = cloud.len() as f64;
    let noise = spectrum.noise().powi(2);
    let terms = spectrum.terms(posterior.degree());
    let squared = cloud.squares(posterior.residuals(mean));
    let mut left = squared;
    let (_, mut gradient) = hyperprior(points, spectrum);
    gradient[3] += points - squared / noise;
    let mut degrees = Vec::with_capacity(unlearnt.len());
    for (l, (term, unlearnt)) in terms.zip(&unlearnt).enumerate() {
        let v = term.variance;
        let orders = (2 * l + 1) as f64;
        let range = l * l..(l + 1) * (l + 1);
        let own = mean[range.clone()].iter().zip(&given.orders[range]);
        let power: f64 = own.map(|(x, share)| x * x / share).sum();
        let slope = 0.5 * (orders * (1.0 - unlearnt) - power / v);
        for (gradient, by) in gradient.iter_mut().zip(term.slopes) {
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
        solved,
    }
}
