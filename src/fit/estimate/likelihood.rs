//! The likelihood of a spectrum, from what the points say of each degree.
//!
//! For given variances v_l and noise s the points determine the coefficients of degree l as if each
//! had been measured N_l times: their posterior variance is C_l = 1 / (N_l / s^2 + 1 / v_l). With the
//! powers P_l of the coefficients before they were shrunk, and the squared residuals R left by these,
//!
//! ```text
//! F = 1/2 [ n log s^2 + sum (2l + 1) log(1 + N_l v_l / s^2) + R / s^2 + sum N_l P_l / (N_l v_l + s^2) ]
//! ```
//!
//! is the negative log likelihood as if N_l did not depend on the spectrum. Where the spectrum no longer
//! moves, the gradient of F is that of the exact likelihood. Exact, and in no need of rounds, where the
//! points are spread evenly: then N_l = n / 4 pi for all degrees.

use super::spectrum::{BOUNDS, Bounds, PARAMETERS, STEPS, Spectrum};
use nalgebra::{Matrix5, Vector5};

/// What the points say of each degree.
#[derive(Debug, Clone)]
pub(crate) struct Evidence {
    /// Number of points.
    pub(crate) points: f64,
    /// N_l, P_l of degrees 0, 1, ...
    pub(crate) degrees: Vec<[f64; 2]>,
    /// Weighted sum of squares of the residuals left by the coefficients before they were shrunk.
    pub(crate) residuals: f64,
}

/// Means and standard deviations of the logarithms of A, nu, l0 and s over grains of many kinds.
const HYPERPRIOR: [[f64; 2]; 4] = [[-1.897, 1.0], [0.875, 0.25], [1.0986, 0.5], [-5.298, 2.0]];

/// That is all that is known of a grain of so few points, of which the likelihood alone is too sure of itself: of 50 points, 95 %
/// intervals of the volume cover 35 % with it and 90 % with the hyperprior.
const FEW_POINTS: f64 = 100.0;

/// Of more points the standard deviations are so many times as large: they tell size and noise themselves, and a law that holds
/// for many grains may not hold for one. But where a stretched body is a ball but for noise, they leave nu and l0 open: of chance
/// some of these balls had white spectra up to degree 20, and curvatures known three times worse than those of others.
const OF_MANY_POINTS: [f64; 4] = [f64::INFINITY, 2.0, 2.0, f64::INFINITY];

/// Means of the logarithms of A, nu, l0 and s, and their precisions.
fn expected(points: f64) -> [[f64; 2]; 4] {
    let wider = match points <= FEW_POINTS {
        true => [1.0; 4],
        false => OF_MANY_POINTS,
    };
    std::array::from_fn(|at| {
        let [mean, sd] = HYPERPRIOR[at];
        [mean, (sd * wider[at]).powi(-2)]
    })
}

/// Negative logarithm of the hyperprior and its gradient.
pub(crate) fn hyperprior(points: f64, spectrum: &Spectrum) -> (f64, [f64; PARAMETERS]) {
    let (amplitude, by) = spectrum.amplitude();
    let [_, exponent, knee, noise, _] = spectrum.logarithms;
    let logarithms = [amplitude, exponent, knee, noise].into_iter().enumerate();
    let (mut value, mut gradient) = (0.0, [0.0; PARAMETERS]);
    for ((at, logarithm), [mean, precision]) in logarithms.zip(expected(points)) {
        let off = logarithm - mean;
        value += 0.5 * precision * off * off;
        match at {
            0 => (0..PARAMETERS).for_each(|i| gradient[i] += by[i] * precision * off),
            _ => gradient[at] += precision * off,
        }
    }
    (value, gradient)
}

/// Second derivatives of the negative logarithm of the hyperprior.
pub(super) fn hyperprior_curvature(points: f64, spectrum: &Spectrum) -> Matrix5<f64> {
    let by_amplitude = Vector5::from(spectrum.amplitude().1);
    let [amplitude, exponent, knee, noise] = expected(points).map(|[_, precision]| precision);
    let own = Vector5::new(0.0, exponent, knee, noise, 0.0);
    by_amplitude * by_amplitude.transpose() * amplitude + Matrix5::from_diagonal(&own)
}

/// The symmetric part of a matrix, with eigenvalues made positive.
pub(super) fn positive(matrix: &Matrix5<f64>) -> Matrix5<f64> {
    let eigen = (0.5 * (matrix + matrix.transpose())).symmetric_eigen();
    let largest = eigen.eigenvalues.amax().max(f64::MIN_POSITIVE);
    let positive = eigen
        .eigenvalues
        .map(|k| k.abs().max(LEAST_CURVATURE * largest));
    eigen.eigenvectors * Matrix5::from_diagonal(&positive) * eigen.eigenvectors.transpose()
}

impl Evidence {
    /// F and its gradient.
    pub(crate) fn value(&self, spectrum: &Spectrum) -> (f64, [f64; PARAMETERS]) {
        let noise = spectrum.noise().powi(2);
        let mut sum = self.points * noise.ln() + self.residuals / noise;
        let mut gradient = [0.0, 0.0, 0.0, self.points - self.residuals / noise, 0.0];
        let terms = spectrum.terms(self.degrees.len() - 1);
        for (l, (&[count, power], term)) in self.degrees.iter().zip(terms).enumerate() {
            let v = term.variance;
            let orders = (2 * l + 1) as f64;
            let total = count * v + noise;
            sum += orders * (count * v / noise).ln_1p() + count * power / total;
            let slope = 0.5 * count * v / total * (orders - count * power / total);
            for (gradient, by) in gradient.iter_mut().zip(term.slopes) {
                *gradient += by * slope;
            }
            gradient[3] -= count * v / total * orders + count * power * noise / total.powi(2);
        }
        let (prior, slopes) = hyperprior(self.points, spectrum);
        let value = 0.5 * sum + prior;
        for (gradient, slope) in gradient.iter_mut().zip(slopes) {
            *gradient += slope;
        }
        (value, gradient)
    }

    /// A spectrum with texture, if that shows beside the noise and makes the points clearly likelier than this one without; few
    /// points cannot tell.
    pub(crate) fn textured(&self, smooth: &Spectrum) -> Option<Spectrum> {
        if self.points <= FEW_POINTS {
            return None;
        }
        let textured = self.settled(smooth.with_some_texture());
        let is_worth = self.value(&textured).0 < self.value(smooth).0 - WORTH;
        (is_worth && textured.texture_shows()).then_some(textured)
    }

    /// The same spectrum with [waves](Spectrum::waves) of a degree that it takes for noise, where that has clearly more power, and far
    /// more than those beside it; `None` where there is none. Rims have many such degrees, every other one. Few points cannot tell.
    pub(crate) fn with_waves(&self, spectrum: &Spectrum) -> Option<Spectrum> {
        if self.points <= FEW_POINTS {
            return None;
        }
        let beyond = self.beyond(spectrum);
        let mut waves = spectrum.waves;
        for (l, &(own, is_clear)) in beyond.iter().enumerate().skip(LOWEST_WAVE) {
            let beside = beyond
                .iter()
                .enumerate()
                .skip(l - BESIDE)
                .take(2 * BESIDE + 1);
            let others = beside.filter(|(other, _)| *other != l);
            let most = others.map(|(_, (power, _))| *power).fold(0.0, f64::max);
            if is_clear && own > ALONE * most {
                waves[l] += own;
            }
        }
        (waves != spectrum.waves).then(|| spectrum.with_waves(waves))
    }

    /// Per degree, the power of a coefficient beyond noise and what a spectrum expects; and whether that is clear, of a degree that
    /// the spectrum takes for noise.
    fn beyond(&self, spectrum: &Spectrum) -> Vec<(f64, bool)> {
        let noise = spectrum.noise().powi(2);
        let variances = spectrum.variances(self.degrees.len() - 1);
        let degrees = self.degrees.iter().zip(variances).enumerate();
        degrees
            .map(|(l, (&[count, power], variance))| {
                let orders = (2 * l + 1) as f64;
                let expected = variance + noise / count;
                let own = power / orders - expected;
                let is_clear = own > largest_by_chance(orders) * expected;
                (own, variance < noise / count && is_clear)
            })
            .collect()
    }

    /// A spectrum that is flat up to some degree, if it makes the points clearly likelier than this one: a law as of other grains
    /// takes waves of many degrees for noise.
    pub(crate) fn banded(&self, smooth: &Spectrum) -> Option<Spectrum> {
        let mut beyond = self.beyond(smooth).into_iter().skip(LOWEST_WAVE);
        if self.points <= FEW_POINTS || !beyond.any(|(_, is_clear)| is_clear) {
            return None;
        }
        let most = self.value(smooth).0 - WORTH_A_BAND;
        let found = EDGES.iter().filter_map(|&edge| {
            let found = self.settled(smooth.flat_up_to(edge, self.excess(smooth, edge)?));
            Some((self.value(&found).0, found))
        });
        let likely = found.filter(|(value, _)| *value < most);
        let best = likely.min_by(|one, other| one.0.total_cmp(&other.0));
        best.map(|(_, spectrum)| spectrum)
    }

    /// By how much coefficients of the degrees up to one, but for the lowest, vary more than noise makes them; `None` if they do not.
    fn excess(&self, spectrum: &Spectrum, to: usize) -> Option<f64> {
        let noise = spectrum.noise().powi(2);
        let (mut excess, mut orders) = (0.0, 0.0);
        for (l, &[count, power]) in self
            .degrees
            .iter()
            .enumerate()
            .take(to + 1)
            .skip(LOWEST_WAVE)
        {
            orders += (2 * l + 1) as f64;
            excess += power - (2 * l + 1) as f64 * noise / count;
        }
        (excess > 0.0).then(|| excess / orders)
    }

    /// The spectrum of least F that steps from a start reach.
    fn settled(&self, start: Spectrum) -> Spectrum {
        let mut at = start;
        for _ in 0..MOST_STEPS {
            let (next, gain) = self.most_likely(&at);
            at = next;
            if gain < WORTH {
                break;
            }
        }
        at
    }

    /// The spectrum of least F that one step may reach, and by how much F is lower there: damped Newton steps
    /// (Levenberg, Marquardt).
    pub(crate) fn most_likely(&self, start: &Spectrum) -> (Spectrum, f64) {
        let bounds: Bounds = std::array::from_fn(|i| {
            let ([low, high], at, step) = (BOUNDS[i], start.logarithms[i], STEPS[i]);
            [(at - step).max(low), (at + step).min(high)]
        });
        let first = self.value(start).0;
        let (mut at, mut cost) = (*start, first);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let newton = Step::new(self, &at, &bounds);
            let lower = (0..12).find_map(|_| {
                let next = newton.to(&at, damping, &bounds)?;
                let value = self.value(&next).0;
                if value < cost {
                    damping *= 0.1;
                    return Some((next, value));
                }
                damping *= 10.0;
                None
            });
            let Some((next, value)) = lower else { break };
            let gain = cost - value;
            (at, cost) = (next, value);
            if gain < GAIN {
                break;
            }
        }
        // Costs near the least differ by rounding only, on which the place must not hang.
        for _ in 0..LAST_STEPS {
            at = Step::new(self, &at, &bounds)
                .to(&at, 0.0, &bounds)
                .unwrap_or(at);
        }
        (at, first - cost)
    }

    /// Second derivatives of F, made positive: a first guess of those of the exact likelihood.
    pub(crate) fn curvature(&self, spectrum: &Spectrum) -> Matrix5<f64> {
        let gradient = |at: Spectrum| Vector5::from(self.value(&at).1);
        let mut hessian = Matrix5::zeros();
        for i in 0..PARAMETERS {
            let moved = |by: f64| {
                let mut moved = *spectrum;
                moved.logarithms[i] += by;
                gradient(moved)
            };
            let column = (moved(DIFFERENCE) - moved(-DIFFERENCE)) / (2.0 * DIFFERENCE);
            hessian.set_column(i, &column);
        }
        positive(&hessian)
    }
}

/// A Newton step that keeps to bounds.
struct Step {
    gradient: Vector5<f64>,
    hessian: Matrix5<f64>,
}

impl Step {
    fn new(evidence: &Evidence, at: &Spectrum, bounds: &Bounds) -> Self {
        let mut gradient = Vector5::from(evidence.value(at).1);
        let mut hessian = evidence.curvature(at);
        at.hold(bounds, &mut gradient, &mut hessian);
        Self { gradient, hessian }
    }

    /// Where it leads to, damped (Levenberg, Marquardt).
    fn to(&self, at: &Spectrum, damping: f64, bounds: &Bounds) -> Option<Spectrum> {
        let scale = self.hessian.diagonal() * damping;
        let damped = self.hessian + Matrix5::from_diagonal(&scale);
        let step = damped.cholesky()?.solve(&self.gradient);
        Some(at.moved_to(std::array::from_fn(|i| {
            (at.logarithms[i] - step[i]).clamp(bounds[i][0], bounds[i][1])
        })))
    }
}

/// Texture is kept where it lowers F by this, as of a spectrum twenty times likelier.
const WORTH: f64 = 3.0;

/// Standard deviations by which the power of a degree is more than chance.
const MORE_THAN_CHANCE: f64 = 6.0;

/// By what share the power of a degree of so many orders is larger than expected by chance, at most.
pub(crate) fn largest_by_chance(orders: f64) -> f64 {
    MORE_THAN_CHANCE * (2.0 / orders).sqrt()
}

/// Degrees on either side of one with waves that have none, and so many times less power beyond noise.
const BESIDE: usize = 2;
const ALONE: f64 = 4.0;

/// Lower degrees any law suits.
const LOWEST_WAVE: usize = 5;

/// A band is looked for where it lowers F by this, up to each of these degrees.
const WORTH_A_BAND: f64 = 10.0;
const EDGES: [usize; 3] = [12, 20, 30];

/// Steps to the least F at most; ten are usual.
const MOST_STEPS: usize = 60;

/// Fall of F below which they end.
const GAIN: f64 = 1e-6;

/// Steps after that.
const LAST_STEPS: usize = 2;

/// Step of the differences by which second derivatives are found.
const DIFFERENCE: f64 = 1e-4;

/// Curvatures are at least this share of the largest.
const LEAST_CURVATURE: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;

    /// What is expected of an even cloud.
    fn evidence(spectrum: &Spectrum, points: f64, degree: usize) -> Evidence {
        let noise = spectrum.noise().powi(2);
        let count = points / (4.0 * std::f64::consts::PI);
        let variances = spectrum.variances(degree);
        let degrees = variances
            .iter()
            .enumerate()
            .map(|(l, v)| [count, (2 * l + 1) as f64 * (v + noise / count)]);
        Evidence {
            points,
            degrees: degrees.collect(),
            residuals: noise * (points - ((degree + 1) * (degree + 1)) as f64),
        }
    }

    #[test]
    fn the_gradient_is_that_of_differences() {
        let truth = Spectrum::with_amplitude([-2.0, 0.9, 1.2, -5.0]);
        for points in [60.0, 4000.0] {
            let evidence = evidence(&truth, points, 5);
            let at = textured([-2.5, 0.7, 1.0, -4.5], -12.0);
            let (_, gradient) = evidence.value(&at);
            for (i, slope) in gradient.into_iter().enumerate() {
                let moved = |by: f64| {
                    let mut moved = at;
                    moved.logarithms[i] += by;
                    evidence.value(&moved).0
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                let error = (difference - slope).abs();
                assert!(
                    error < 1e-5 * slope.abs().max(1.0),
                    "{i}: {difference} {slope}"
                );
            }
        }
    }

    /// A spectrum with so much texture.
    fn textured(shape: [f64; 4], texture: f64) -> Spectrum {
        let mut spectrum = Spectrum::with_amplitude(shape);
        *spectrum.logarithms.last_mut().unwrap() = texture;
        spectrum
    }

    #[test]
    fn the_spectrum_behind_the_evidence_is_found() {
        let truth = textured([-2.0, 1.5, 1.2, -6.0], -14.0);
        let evidence = evidence(&truth, 6000.0, 36);
        let settle = |at: Spectrum| (0..5).fold(at, |at, _| evidence.most_likely(&at).0);
        let smooth = settle(Spectrum::start());
        let at = settle(evidence.textured(&smooth).unwrap());
        // The hyperprior draws the shape off, along the valley of nearly equal spectra.
        let off_at_most = [0.5, 0.2, 0.4, 0.001, 0.03];
        let pairs = at.logarithms.iter().zip(truth.logarithms);
        for ((have, want), off_at_most) in pairs.zip(off_at_most) {
            assert!((have - want).abs() < off_at_most, "{at:?} {truth:?}");
        }
    }
}
