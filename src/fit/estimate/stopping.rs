//! When conjugate gradients end.

/// Conjugate gradients end when the last [`LOOK_BACK`] steps together removed less than this of the squared error, in
/// units of the posterior variance of one coefficient. (The usual test, of the preconditioned residual, ends 2.5
/// standard deviations off where the scan has a hole.)
pub(crate) const SETTLED: f64 = 0.1;

/// The same where the mean is only to be compared, or to be found again under a better spectrum.
pub(super) const ROUGHLY_SETTLED: f64 = 2.0;

/// The same where the spectrum is but a guess. Under it the matrix is ill-conditioned, and a mean that settles further takes more
/// than 30 steps, over which rounding grows from 1e-16 to 1e-6.
pub(super) const GUESSED: f64 = 200.0;

/// Of points that lie alike everywhere a mean takes 8 to 30 steps. Where they are many times denser on one side, or in rows far
/// apart, it takes 100 to 1000, and ends before the thin side is right: beyond so many the matrix is better factored, ...
pub(super) const HARD: usize = 100;

/// ... up to this degree: it takes 30 MB then, and half a second.
pub(super) const MOST_FACTORED_DEGREE: usize = 60;

/// Steps that are looked back on.
const LOOK_BACK: usize = 8;

/// Systems for a variance are solved to this share of it, by the sum of the last [`LOOK_BACK`] steps but the first.
pub(super) const SHARE: f64 = 0.01;

/// Steps of less than this share of the squared size of the first move nothing but the last digits.
const LEAST_MOVE: f64 = 1e-24;

/// When conjugate gradients end.
#[derive(Debug, Clone, Copy)]
pub(super) enum Enough {
    /// When the energy that the last steps removed is below this.
    Energy(f64),
    /// When it is below this share of what all steps removed.
    Share(f64),
    /// When the last step moved nothing beyond rounding.
    Rounding,
}

impl Enough {
    /// `energies` of the steps so far; `promise`: of the last one, by the preconditioner.
    pub(super) fn is_reached(self, energies: &[f64], promise: f64) -> bool {
        let steps = energies.len();
        match self {
            Self::Energy(settled) => {
                let recent = &energies[steps.saturating_sub(LOOK_BACK)..];
                (steps >= LOOK_BACK || promise < 1e-6 * settled)
                    && recent.iter().sum::<f64>() < settled
            }
            Self::Share(share) => {
                let recent = &energies[steps.saturating_sub(LOOK_BACK).max(1)..];
                let all: f64 = energies.iter().sum();
                steps > 1 && recent.iter().sum::<f64>() < share * all
            }
            Self::Rounding => promise < LEAST_MOVE * energies[0],
        }
    }
}
