//! When a bed has come to its end.

use super::settings::BedError;
use super::settle::Bed;

/// Steps between two looks at the bed.
const LOOK: u64 = 50;

/// Looks in a row at which a bed must be at rest.
const QUIET: u32 = 5;

/// Why a bed ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// It is at rest.
    AtRest,
    /// It is not, but its time is up.
    TimeIsUp,
}

impl Bed {
    /// Goes on by 50 steps, and looks whether the grains are at rest.
    ///
    /// # Errors
    /// [`BedError::Unstable`] if they run away.
    pub fn go_on(&mut self) -> Result<(), BedError> {
        for _ in 0..LOOK {
            self.advance();
        }
        let liveliness = self.liveliness();
        if !liveliness.is_finite() {
            return Err(BedError::Unstable {
                seconds: self.seconds(),
            });
        }
        self.state.quiet = match liveliness < self.settings.rest {
            true => self.state.quiet.saturating_add(1),
            false => 0,
        };
        Ok(())
    }

    /// Whether the bed has come to its end: at rest at five looks in a row, or its time is up.
    pub fn rest(&self) -> Option<Rest> {
        if self.state.quiet >= QUIET {
            return Some(Rest::AtRest);
        }
        (self.seconds() >= self.settings.most_seconds).then_some(Rest::TimeIsUp)
    }
}
