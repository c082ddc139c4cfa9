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
    /// Goes on to the next of the steps 50, 100 and so on, and looks whether the grains are at rest; or until its time is
    /// up, if that is before.
    ///
    /// # Errors
    /// [`BedError::Unstable`] if they run away.
    pub fn go_on(&mut self) -> Result<(), BedError> {
        loop {
            self.advance();
            if self.is_looked_at() || self.is_over() {
                break;
            }
        }
        let liveliness = self.liveliness();
        if !liveliness.is_finite() {
            return Err(BedError::Unstable {
                seconds: self.seconds(),
            });
        }
        if self.is_looked_at() {
            self.state.quiet = match liveliness < self.settings.rest {
                true => self.state.quiet.saturating_add(1),
                false => 0,
            };
        }
        Ok(())
    }

    /// Whether the bed has come to its end: at rest at five looks in a row, or its time is up.
    pub fn rest(&self) -> Option<Rest> {
        if self.state.quiet >= QUIET {
            return Some(Rest::AtRest);
        }
        self.is_over().then_some(Rest::TimeIsUp)
    }

    /// Whether this is a step at which it is looked whether the grains are at rest: the same ones however often a bed is
    /// stopped.
    fn is_looked_at(&self) -> bool {
        self.steps().is_multiple_of(LOOK)
    }

    fn is_over(&self) -> bool {
        self.seconds() >= self.settings.most_seconds
    }
}
