//! A line on the terminal that tells what is being done.

use indicatif::ProgressBar;
use std::fmt::Display;
use std::time::Duration;

/// How often the line moves.
const TICK: Duration = Duration::from_millis(100);

/// Shown on standard error while it lives, where that is a terminal.
pub(super) struct Progress(ProgressBar);

impl Progress {
    pub(super) fn new(quiet: bool) -> Self {
        if quiet {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new_spinner();
        bar.enable_steady_tick(TICK);
        Self(bar)
    }

    /// What is done now.
    pub(super) fn stage(&self, stage: impl Display) {
        self.0.set_message(stage.to_string());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
