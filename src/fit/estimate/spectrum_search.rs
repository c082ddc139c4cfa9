//! The search for the most likely spectrum of a cloud, by rounds.
//!
//! A round conditions on a spectrum, sees what the points say of each degree, and takes a step towards the
//! most likely spectrum. Of a cloud whose matrix is not factored, the first rounds take it as even
//! (N_l = n / 4 pi); then random probes tell N_l.

use super::likelihood::{Evidence, hyperprior, hyperprior_curvature, positive};
use super::newton::{Newton, Next, Place};
use super::outcome::variance;
use super::posterior::{Conditioned, Posterior, Solved};
use super::spectrum::{NOISE, PARAMETERS, Spectrum};
use super::spectrum_fit::SpectrumFit;
use super::stopping::{GUESSED, HARD, MOST_FACTORED_DEGREE, ROUGHLY_SETTLED, SETTLED};
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
                let wavy = look.told.evidence.with_waves(&look.place.spectrum);
                if let Some(wavy) = wavy.filter(|_| round < MOST_ROUNDS) {
                    spectrum = wavy;
                    newton = None;
                    solved = look.told.solved.take();
                    coefficients = Some(look.mean);
                    continue;
                }
                let other = smooth.is_none().then(|| look.other()).flatten();
                if counted == count && other.is_none() {
                    let likelier = smooth.filter(|smooth| look.is_worse(smooth, 0.0));
                    return likelier.unwrap_or(look).fit();
                }
                counted = count;
                newton = None;
                if let Some(other) = other {
                    spectrum = other;
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

    /// A spectrum with texture, or with a band, that is clearly likelier, where this one has no texture.
    fn other(&self) -> Option<Spectrum> {
        let (spectrum, evidence) = (&self.place.spectrum, &self.told.evidence);
        if !spectrum.is_smooth() {
            return None;
        }
        let found = [evidence.textured(spectrum), evidence.banded(spectrum)];
        let value = |spectrum: &Spectrum| evidence.value(spectrum).0;
        let found = found.into_iter().flatten();
        found.min_by(|one, other| value(one).total_cmp(&value(other)))
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

/// Of a degree of which an even cloud would tell a smaller share, that is taken: single precision and probes tell no better.
const LEAST_TOLD: f64 = 1e-3;

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
    gradient[NOISE] += points - squared / noise;
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
        gradient[NOISE] -= orders * (1.0 - unlearnt);
        let even = points / (4.0 * PI) * v;
        let [learnt, unlearnt] = match even < LEAST_TOLD * noise {
            true => [even, noise].map(|part| part / (even + noise)),
            false => [1.0 - unlearnt, *unlearnt],
        };
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

#[cfg(test)]
mod tests;
