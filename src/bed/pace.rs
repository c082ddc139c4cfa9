//! How many steps a bed takes, and how long they may be.

use crate::digits::significant;

/// The most steps of a bed: at ten thousand steps a second, a day.
pub const BED_STEPS: u64 = 1_000_000_000;

/// How far a grain may fall from rest in one step, in its diameters.
const LONGEST_FALL: f64 = 0.1;

/// Why a bed cannot be run in steps of that length.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PaceError {
    /// More steps than are taken.
    #[error(
        "it would take up to {} steps of {} s to the end, and at most {BED_STEPS} are taken: ask for less time, or for \
         softer grains",
        significant(*steps, 3),
        significant(*step, 3)
    )]
    TooMany {
        /// The steps to the end.
        steps: f64,
        /// Seconds of a step.
        step: f64,
    },
    /// Grains that do not carry themselves.
    #[error(
        "the grains are too soft for their weight: in a step of {} s, which follows from Young's modulus and density, \
         they would fall through each other",
        significant(*step, 3)
    )]
    TooLong {
        /// Seconds of a step.
        step: f64,
    },
}

/// Refuses steps of so many seconds, of grains of a radius in metres that fall at a gravity in m/s² for some seconds.
///
/// # Errors
/// [`PaceError`].
pub(crate) fn check_pace(
    step: f64,
    radius: f64,
    gravity: f64,
    seconds: f64,
) -> Result<(), PaceError> {
    let steps = seconds / step;
    // No range holds NaN.
    if !(0.0..=BED_STEPS as f64).contains(&steps) {
        return Err(PaceError::TooMany { steps, step });
    }
    match 0.5 * gravity * step * step > LONGEST_FALL * 2.0 * radius {
        true => Err(PaceError::TooLong { step }),
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_neither_too_many_nor_too_long() {
        let check = |step, seconds| check_pace(step, 2.5e-3, 9.81, seconds);
        assert_eq!(check(4e-5, 5.0), Ok(()));
        for (step, seconds) in [(0.0, 5.0), (4e-5, 1e300), (f64::NAN, 5.0)] {
            let found = check(step, seconds);
            assert!(matches!(found, Err(PaceError::TooMany { .. })), "{found:?}");
        }
        assert_eq!(check(0.1, 5.0), Err(PaceError::TooLong { step: 0.1 }));
    }
}
