//! The prior of an estimate: how large harmonics of each degree are, and how large the noise.
//!
//! Coefficients of degree l, in units of the mean radius, are normal with variance
//!
//! ```text
//! v_l = A (1 + (l / l0)^2)^-nu + B (l / 24)^-3.5 + w_l
//! ```
//!
//! The first term is the shape's: flat up to the knee l0, then falling with the slope -2 nu. The second is that of the
//! surface's texture, which falls more slowly: rough natural surfaces are nearly self-affine, with spectra that fall by
//! powers of 3 to 4 (Hurst exponents of .5 to 1). Of one term alone it was taken for noise, where the shape is smooth.
//! Powers of 3, 3.5 and 4 suit hidden points of kernels alike. w_l is that of waves of one width, as ribs are: zero but for degrees that
//! the first two take for noise, and which have clearly more power than noise has.
//!
//! Degrees 0, 1 and 2 (size, place and proportions) are free: proportions are taken by the stretch, which is found from
//! the same points, so that what is left of degree 2 in the stretched space says nothing of what may be left. (With a variance
//! learnt from it, the extents of noisy ellipsoids were 5 standard errors off.)
//!
//! Along a kernel's crease the radius varies less than across it: of one degree the orders m do not vary alike about the
//! grain's longest axis, its z. The variance of order m is that of its degree times a share, exp(t |m| / l) over the mean
//! of these, with the tilt t: 0 where no direction differs from another, above 0 where furrows lie along the axis.

use nalgebra::{Matrix5, Vector5};

/// The spectrum of a grain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spectrum {
    /// Logarithms of the shape's variance at degree [`PIVOT`], exponent nu, knee l0, standard deviation s of the noise, and
    /// the texture's variance at [`TEXTURE_PIVOT`].
    ///
    /// The points tell the variance in the middle of the degrees far better than the amplitude A, which a low knee and a
    /// steep slope leave open: a search among amplitudes creeps along a valley.
    pub(crate) logarithms: [f64; PARAMETERS],
    /// The tilt t.
    pub(crate) tilt: f64,
    /// Variance of each degree beside that of shape and texture: of ribs, and of waves of one width, which no law tells.
    pub(crate) waves: [f64; HIGHEST + 1],
}

/// The logarithms of a spectrum.
pub(crate) const PARAMETERS: usize = 5;

/// Which of them is the noise's.
pub(crate) const NOISE: usize = 3;

/// The degree whose variance stands for the amplitude: grains are told from noise up to degrees 10 to 40.
const PIVOT: usize = 12;

/// The degree whose variance stands for the texture's.
const TEXTURE_PIVOT: usize = 24;

/// Beyond this degree nothing to speak of is expected of the radius.
pub(super) const HIGHEST: usize = 80;

/// Variance of a texture's degree over that of another, which falls by the power 3.5.
pub(super) fn texture_fall(from: usize, to: usize) -> f64 {
    let ratio = from as f64 / to as f64;
    ratio.powi(3) * ratio.sqrt()
}

/// Which of the logarithms is the texture's, where there is none, and where a search for it starts: at a fifth of a percent
/// of the radius.
pub(crate) const TEXTURE: usize = 4;
const NO_TEXTURE: f64 = -40.0;
const SOME_TEXTURE: f64 = -18.0;

/// Bounds of the logarithms.
pub(crate) type Bounds = [[f64; 2]; PARAMETERS];

/// Those of a search: variances from none to those of a star of spikes, slopes 1.2 to 50, knees .5 to 60, noise
/// 3e-6 to .5 of the mean radius, texture from none on.
pub(crate) const BOUNDS: Bounds = [
    [-150.0, 2.0],
    [-0.51, 3.22],
    [-0.69, 4.1],
    [-12.7, -0.69],
    [NO_TEXTURE, 2.0],
];

/// Farthest that one step of a search may move the logarithms.
pub(crate) const STEPS: [f64; PARAMETERS] = [4.0, 0.5, 0.7, 1.5, 4.0];

/// Variances of degrees 0, 1 and 2, in squares of the mean radius: of size and place far above anything a grain has,
/// of proportions as of a grain of which nothing is known (the middle of the hyperprior).
const FREE: [f64; 3] = [100.0, 1.0, 0.06];

/// Detail of textured kernels falls more slowly with the degree than a lower one tells: of that one's noise so much is left,
/// where it is above this share of the mean radius.
const LEFT_BY_TEXTURE: f64 = 0.8;
const TEXTURED_NOISE: f64 = 1e-3;

/// Least share of the noise's variance that is left when a higher degree takes its part.
const LEAST_LEFT: f64 = 0.5;

/// Newton steps to what points tell of a degree, from what they would tell without a tilt.
const NEWTON_STEPS: usize = 6;

impl Spectrum {
    /// Where a search starts: the slope and knee of a kernel, noise of one percent.
    pub(crate) fn start() -> Self {
        Self::with_amplitude([-4.0, 1.0, 4.0_f64.ln(), 0.01_f64.ln()])
    }

    /// From the logarithms of A, nu, l0 and s; without texture.
    pub(crate) fn with_amplitude([amplitude, exponent, knee, noise]: [f64; 4]) -> Self {
        let even = |pivot: f64| Self {
            logarithms: [pivot, exponent, knee, noise, NO_TEXTURE],
            tilt: 0.0,
            waves: [0.0; HIGHEST + 1],
        };
        even(amplitude - even(0.0).fall().at(PIVOT)[0])
    }

    /// Whether nothing is expected of texture.
    pub(crate) fn is_smooth(&self) -> bool {
        self.logarithms[TEXTURE] <= NO_TEXTURE
    }

    /// Whether texture adds more to the radius than noise, beyond [`PIVOT`]. Less is told by the middle degrees alone, and may
    /// be no more than a shape whose spectrum is no power law, as of a smooth bean.
    pub(crate) fn texture_shows(&self) -> bool {
        let degrees = PIVOT + 1..=HIGHEST;
        let sum: f64 = degrees.map(|l| (2 * l + 1) as f64 * self.texture(l)).sum();
        sum > 4.0 * std::f64::consts::PI * self.noise().powi(2)
    }

    /// With variances of about this size up to a degree, where they have fallen to a half, as steeply as the bounds allow.
    pub(crate) fn flat_up_to(&self, edge: usize, variance: f64) -> Self {
        let [[_, most], _, [_, knee], ..] = BOUNDS;
        let knee = knee.exp();
        // (1 + (l / l0)^2)^-nu is about a half where nu (l / l0)^2 is log 2.
        let exponent = std::f64::consts::LN_2 * (knee / edge as f64).powi(2);
        let [fall, _] = Fall { exponent, knee }.at(PIVOT);
        let pivot = (variance.ln() - fall).min(most);
        let mut logarithms = self.logarithms;
        logarithms[..3].copy_from_slice(&[pivot, exponent.ln(), knee.ln()]);
        self.moved_to(logarithms)
    }

    /// With these waves.
    pub(crate) fn with_waves(&self, waves: [f64; HIGHEST + 1]) -> Self {
        Self { waves, ..*self }
    }

    /// With as much texture as a search starts with.
    pub(crate) fn with_some_texture(&self) -> Self {
        let mut logarithms = self.logarithms;
        logarithms[TEXTURE] = SOME_TEXTURE;
        self.moved_to(logarithms)
    }

    /// Takes the logarithms that a step would lead out of bounds out of the equations of a Newton step, by the gradient here.
    /// Of texture that is not there nothing can be told.
    pub(crate) fn hold(
        &self,
        bounds: &Bounds,
        gradient: &mut Vector5<f64>,
        hessian: &mut Matrix5<f64>,
    ) {
        for (i, &[low, high]) in bounds.iter().enumerate() {
            let is_held = self.logarithms[i] <= low && (gradient[i] > 0.0 || i == TEXTURE)
                || self.logarithms[i] >= high && gradient[i] < 0.0;
            if is_held {
                hessian.fill_row(i, 0.0);
                hessian.fill_column(i, 0.0);
                hessian[(i, i)] = 1.0;
                gradient[i] = 0.0;
            }
        }
    }

    /// Other logarithms, the same tilt.
    pub(crate) fn moved_to(&self, logarithms: [f64; PARAMETERS]) -> Self {
        Self {
            logarithms,
            ..*self
        }
    }

    /// Another tilt.
    pub(crate) fn tilted(&self, tilt: f64) -> Self {
        Self { tilt, ..*self }
    }

    /// The variances of the orders -l to l of degree l over that of the degree; their mean is 1.
    pub(crate) fn orders(&self, l: usize) -> impl Iterator<Item = f64> {
        let tilt = match l < FREE.len() {
            true => 0.0,
            false => self.tilt / l as f64,
        };
        let share = move |order: usize| (tilt * order as f64).exp();
        let sum: f64 = share(0) + 2.0 * (1..=l).map(share).sum::<f64>();
        let mean = sum / (2 * l + 1) as f64;
        (0..=2 * l).map(move |at| share(at.abs_diff(l)) / mean)
    }

    /// log A, and its derivatives by the logarithms.
    pub(crate) fn amplitude(&self) -> (f64, [f64; PARAMETERS]) {
        let [fall, by_knee] = self.fall().at(PIVOT);
        (self.logarithms[0] + fall, [1.0, fall, by_knee, 0.0, 0.0])
    }

    /// The shares of their variances that even points leave of the orders -l to l of degree l, where these have this mean,
    /// between 0 and 1.
    pub(crate) fn left(&self, l: usize, mean: f64) -> Vec<f64> {
        let orders: Vec<f64> = self.orders(l).collect();
        if self.tilt == 0.0 {
            return vec![mean; orders.len()];
        }
        let mut told = (1.0 - mean) / mean;
        for _ in 0..NEWTON_STEPS {
            let left = orders.iter().map(|order| 1.0 / (1.0 + told * order));
            let (excess, slope) = left.fold((0.0, 0.0), |(excess, slope), q| {
                (excess + q - mean, slope + q * (1.0 - q))
            });
            told *= (excess / slope).exp();
        }
        orders
            .iter()
            .map(|order| 1.0 / (1.0 + told * order))
            .collect()
    }

    /// Standard deviation of the noise of one point, in units of the mean radius.
    pub(crate) fn noise(&self) -> f64 {
        self.logarithms[3].exp()
    }

    /// The exponent of the power law that the shape's variances end in: v_l ~ l^-slope.
    pub(crate) fn slope(&self) -> f64 {
        2.0 * self.logarithms[1].exp()
    }

    /// Where to start the search for that of an expansion of a higher degree: what this adds was noise to the lower one,
    /// unless it would be most of it, more than such a spectrum can tell.
    pub(crate) fn raised(&self, from: usize, to: usize) -> Self {
        if from == to {
            return *self;
        }
        let [pivot, exponent, knee, noise, texture] = self.logarithms;
        let left = 1.0 - self.power(from, to) / self.noise().powi(2);
        let noise = match left > LEAST_LEFT {
            true => noise + 0.5 * left.ln(),
            false => noise,
        };
        let noise = match noise > TEXTURED_NOISE.ln() {
            true => noise + LEFT_BY_TEXTURE.ln(),
            false => noise,
        };
        self.moved_to([pivot, exponent, knee, noise, texture])
    }

    /// Expected square of what the degrees above `from`, up to `to`, add to the radius.
    pub(crate) fn power(&self, from: usize, to: usize) -> f64 {
        let variances = self.variances(to).into_iter().enumerate();
        let sum: f64 = variances
            .skip(from + 1)
            .map(|(l, v)| (2 * l + 1) as f64 * v)
            .sum();
        sum / (4.0 * std::f64::consts::PI)
    }

    /// v_l of degrees 0 to `degree`.
    pub(crate) fn variances(&self, degree: usize) -> Vec<f64> {
        self.terms(degree).map(|term| term.variance).collect()
    }

    /// Degrees 0 to `degree`.
    pub(crate) fn terms(&self, degree: usize) -> impl Iterator<Item = Term> + use<> {
        let (amplitude, [_, at_pivot, knee_at_pivot, ..]) = self.amplitude();
        let fall = self.fall();
        let texture = self.logarithms[TEXTURE].exp();
        let waves = self.waves;
        (0..=degree).map(move |l| {
            if let Some(&variance) = FREE.get(l) {
                return Term {
                    variance,
                    slopes: [0.0; PARAMETERS],
                };
            }
            let [own, by_knee] = fall.at(l);
            let shape = (amplitude - own).exp();
            let texture = texture * texture_fall(TEXTURE_PIVOT, l);
            let variance = shape + texture + waves.get(l).unwrap_or(&0.0);
            let share = shape / variance;
            Term {
                variance,
                slopes: [
                    share,
                    share * (at_pivot - own),
                    share * (knee_at_pivot - by_knee),
                    0.0,
                    texture / variance,
                ],
            }
        })
    }

    /// The texture's part of v_l.
    fn texture(&self, l: usize) -> f64 {
        self.logarithms[TEXTURE].exp() * texture_fall(TEXTURE_PIVOT, l)
    }

    fn fall(&self) -> Fall {
        Fall {
            exponent: self.logarithms[1].exp(),
            knee: self.logarithms[2].exp(),
        }
    }
}

/// A degree l of a spectrum.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Term {
    /// v_l.
    pub(crate) variance: f64,
    /// d log v_l by the logarithms.
    pub(crate) slopes: [f64; PARAMETERS],
}

/// How the shape's variances fall.
#[derive(Debug, Clone, Copy)]
struct Fall {
    exponent: f64,
    knee: f64,
}

impl Fall {
    /// By how much the logarithm of the shape's v_l is below log A, nu log(1 + (l / l0)^2), which is also its derivative by
    /// the logarithm of the exponent, and that by the logarithm of the knee.
    fn at(&self, l: usize) -> [f64; 2] {
        let q = (l as f64 / self.knee).powi(2);
        [
            self.exponent * q.ln_1p(),
            -2.0 * self.exponent * q / (1.0 + q),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_higher_degree_adds_was_noise_to_the_lower_one() {
        let spectrum = Spectrum::with_amplitude([-8.0, 1.0, 4.0_f64.ln(), 5e-4_f64.ln()]);
        let noise = spectrum.noise().powi(2);
        let share = |from: usize| spectrum.power(from, from + 20) / noise;
        let from = (3..80).find(|&from| share(from) < 0.4).unwrap();
        assert!(share(from) > 0.1);
        let left = spectrum.raised(from, from + 20).noise().powi(2);
        assert!((left / noise + share(from) - 1.0).abs() < 1e-12);
        assert_eq!(spectrum.raised(from, from), spectrum);
    }
}
