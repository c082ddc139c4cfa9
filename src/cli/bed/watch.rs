//! How far a bed is, told while it settles.

use crate::cli::console::Console;
use crate::cli::progress::Progress;
use crate::cli::streams::say;
use indicatif::HumanDuration;
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

/// How often a line is told where there is no terminal.
const EVERY: Duration = Duration::from_secs(10);

/// Share of the most liveliness below which grains have fallen, and the time that is left can be told.
const FALLEN: f64 = 0.03;

/// How often the time that is left is thought over.
const FORETOLD: Duration = Duration::from_secs(2);

/// Tells how far a bed is: in a line that moves on a terminal, elsewhere in one now and then.
pub(super) struct Watch {
    bar: Option<Progress>,
    is_quiet: bool,
    told: Instant,
    /// When, and how lively the bed was then.
    before: (Instant, f64),
    /// How lively it was at most.
    liveliest: f64,
    left: Option<Duration>,
    /// How lively it is at rest.
    rest: f64,
}

impl Watch {
    pub(super) fn new(console: Console, rest: f64) -> Self {
        let now = Instant::now();
        Self {
            bar: (stderr().is_terminal() && !console.is_verbose()).then(|| console.progress()),
            is_quiet: console.is_quiet(),
            told: now,
            before: (now, f64::NAN),
            liveliest: 0.0,
            left: None,
            rest,
        }
    }

    /// Hears how lively the bed is after so many simulated seconds.
    pub(super) fn tell(&mut self, seconds: f64, now: f64) {
        let (since, before) = self.before;
        if since.elapsed() > FORETOLD {
            self.liveliest = self.liveliest.max(now);
            // Liveliness falls by about the same share in each second, once all grains have fallen.
            let rate = (before / now).ln() / since.elapsed().as_secs_f64();
            let left = (now / self.rest).ln() / rate;
            self.left = Duration::try_from_secs_f64(left)
                .ok()
                .filter(|_| rate > 0.0 && now < FALLEN * self.liveliest);
            self.before = (Instant::now(), now);
        }
        let is_due = self.told.elapsed() > EVERY && !self.is_quiet;
        if self.bar.is_none() && !is_due {
            return;
        }
        let left = match self.left {
            Some(left) => format!("about {} left", HumanDuration(left)),
            None => "still falling".into(),
        };
        let text = format!("{seconds:.3} s simulated, {left}");
        match &self.bar {
            Some(bar) => bar.stage(text),
            None => say(text),
        }
        self.told = Instant::now();
    }
}
