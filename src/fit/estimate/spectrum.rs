//! The prior of an estimate: how large harmonics of each degree are, and how large the noise.
//!
//! Coefficients of degree l, in units of the mean radius, are normal with variance
//! v_l = A (1 + (l / l0)^2)^-nu: flat up to the knee l0, then falling with the slope -2 nu. Degrees 0, 1 and 2
//! (size, place and proportions) are free: proportions are taken by the stretch, which is found from the same
//! points, so that what is left of degree 2 in the stretched space says nothing of what may be left. (With a variance
//! learnt from it, the extents of noisy ellipsoids were 5 standard errors off.)

/// Logarithms of amplitude A, exponent nu, knee l0, and standard deviation s of the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spectrum(pub(crate) [f64; 4]);

/// Bounds of the logarithms: slopes 1.2 to 50, knees .5 to 60, noise 3e-6 to .5 of the mean radius.
pub(crate) const BOUNDS: [[f64; 2]; 4] =
    [[-25.0, 6.0], [-0.51, 3.22], [-0.69, 4.1], [-12.7, -0.69]];

/// Farthest that one step of a search may move the logarithms.
pub(crate) const STEPS: [f64; 4] = [2.0, 0.5, 0.7, 0.7];

/// Variances of degrees 0, 1 and 2, in squares of the mean radius: of size and place far above anything a grain has,
/// of proportions as of a grain of which nothing is known (the middle of the hyperprior).
const FREE: [f64; 3] = [100.0, 1.0, 0.06];

impl Spectrum {
    /// Where a search starts: the slope and knee of a kernel, noise of one percent.
    pub(crate) fn start() -> Self {
        Self([-4.0, 1.0, 4.0_f64.ln(), 0.01_f64.ln()])
    }

    /// Standard deviation of the noise of one point, in units of the mean radius.
    pub(crate) fn noise(&self) -> f64 {
        self.0[3].exp()
    }

    /// The exponent of the power law that the variances end in: v_l ~ l^-slope.
    pub(crate) fn slope(&self) -> f64 {
        2.0 * self.0[1].exp()
    }

    /// v_l of degrees 0 to `degree`.
    pub(crate) fn variances(&self, degree: usize) -> Vec<f64> {
        (0..=degree).map(|l| self.variance(l)).collect()
    }

    fn variance(&self, l: usize) -> f64 {
        match FREE.get(l) {
            Some(&free) => free,
            None => (self.0[0] - self.0[1].exp() * self.knees(l).ln_1p()).exp(),
        }
    }

    /// (l / l0)^2.
    fn knees(&self, l: usize) -> f64 {
        (l as f64 / self.0[2].exp()).powi(2)
    }

    /// d log v_l by the logarithms of amplitude, exponent and knee.
    pub(crate) fn slopes(&self, l: usize) -> [f64; 3] {
        if l < FREE.len() {
            return [0.0; 3];
        }
        let (nu, q) = (self.0[1].exp(), self.knees(l));
        [1.0, -nu * q.ln_1p(), 2.0 * nu * q / (1.0 + q)]
    }
}
