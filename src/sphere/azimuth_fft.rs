//! Fourier series of the azimuth on a ring of equispaced points.

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::f64::consts::PI;
use std::sync::Arc;

/// The series of c_m cos(m phi) + s_m sin(m phi), m = 0, 1, ..., at phi = 2 pi t / n,
/// t = 0, ..., n - 1. Terms are given as c_m + i s_m, for fewer than n / 2 + 1 orders; s_0 is not
/// read, and zero where it is written. Error: rounding.
pub(crate) struct AzimuthFft {
    points: usize,
    to_values: Arc<dyn ComplexToReal<f64>>,
    to_terms: Arc<dyn RealToComplex<f64>>,
}

/// What a transform writes to on its way: one for each thread.
pub(crate) struct Workspace {
    spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl AzimuthFft {
    /// Transforms of `points` > 0 points.
    pub(crate) fn new(points: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        Self {
            points,
            to_values: planner.plan_fft_inverse(points),
            to_terms: planner.plan_fft_forward(points),
        }
    }

    /// Number of points.
    pub(crate) fn points(&self) -> usize {
        self.points
    }

    /// Azimuth of point t.
    pub(crate) fn azimuth(&self, t: usize) -> f64 {
        2.0 * PI * t as f64 / self.points as f64
    }

    pub(crate) fn workspace(&self) -> Workspace {
        let scratch = self.to_values.get_scratch_len();
        Workspace {
            spectrum: self.to_values.make_input_vec(),
            scratch: vec![Complex::ZERO; scratch.max(self.to_terms.get_scratch_len())],
        }
    }

    /// Values of the series at all points.
    pub(crate) fn synthesis(
        &self,
        terms: &[Complex<f64>],
        values: &mut [f64],
        workspace: &mut Workspace,
    ) {
        let Workspace { spectrum, scratch } = workspace;
        spectrum.fill(Complex::ZERO);
        for (out, term) in spectrum.iter_mut().zip(terms) {
            *out = 0.5 * term.conj();
        }
        spectrum[0] = Complex::new(terms[0].re, 0.0);
        self.to_values
            .process_with_scratch(spectrum, values, scratch)
            .expect("a real series, of the lengths that were planned");
    }

    /// The transpose: the sums of `values[t] cos(m phi_t) + i values[t] sin(m phi_t)`. Overwrites
    /// `values`.
    pub(crate) fn adjoint(
        &self,
        values: &mut [f64],
        terms: &mut [Complex<f64>],
        workspace: &mut Workspace,
    ) {
        let Workspace { spectrum, scratch } = workspace;
        self.to_terms
            .process_with_scratch(values, spectrum, scratch)
            .expect("the lengths that were planned");
        for (term, sum) in terms.iter_mut().zip(spectrum) {
            *term = sum.conj();
        }
    }
}

/// The least even number from `least` that has no prime factors but 2, 3 and 5.
pub(super) fn even_smooth_number(least: usize) -> usize {
    let is_smooth = |n: usize| {
        let rest = [2, 3, 5].iter().fold(n, |mut rest, prime| {
            while rest.is_multiple_of(*prime) {
                rest /= prime;
            }
            rest
        });
        rest == 1
    };
    (least.max(2)..)
        .find(|n| n.is_multiple_of(2) && is_smooth(*n))
        .expect("there is a power of two above any number")
}
