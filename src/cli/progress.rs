//! What is being done, how far it is, and how long it takes.

use super::streams::say;
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::sync::Mutex;
use std::thread::{Builder, sleep};
use std::time::{Duration, Instant};

/// How often the line moves.
const TICK: Duration = Duration::from_millis(100);

/// A stage of which nobody knows how long it is.
const OPEN: &str = "{spinner} {elapsed:>4} {wide_msg}";

/// A stage whose steps are counted.
const COUNTED: &str = "[{bar:20}] {pos} of {len}, {elapsed} gone, {eta} left: {wide_msg}";

/// The line that is shown.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Takes the line that is shown off the terminal for good.
pub(super) fn clear() {
    if let Some(bar) = SHOWN.lock().ok().and_then(|mut shown| shown.take()) {
        bar.finish_and_clear();
    }
}

/// Told on standard error while it lives: a line that moves, where that is a terminal, or a line per stage.
pub(super) enum Progress {
    Bar(ProgressBar),
    Lines(Instant),
}

impl Progress {
    pub(super) fn hidden() -> Self {
        Self::Bar(ProgressBar::hidden())
    }

    pub(super) fn bar() -> Self {
        let bar = ProgressBar::new_spinner();
        bar.set_style(style(OPEN));
        keep_moving(&bar);
        if let Ok(mut shown) = SHOWN.lock() {
            *shown = Some(bar.clone());
        }
        Self::Bar(bar)
    }

    pub(super) fn lines() -> Self {
        Self::Lines(Instant::now())
    }

    /// What is done now.
    pub(super) fn stage(&self, stage: impl Display) {
        match self {
            Self::Bar(bar) => bar.set_message(stage.to_string()),
            Self::Lines(started) => say(format_args!(
                "{:>8.3} s  {stage}",
                started.elapsed().as_secs_f64()
            )),
        }
    }

    /// What is done now, after so many steps of all.
    pub(super) fn step(&self, done: usize, all: usize, stage: impl Display) {
        let Self::Bar(bar) = self else {
            self.stage(format_args!("{stage} ({done} of {all} done)"));
            return;
        };
        if bar.length() != Some(all as u64) {
            bar.set_style(style(COUNTED));
            bar.set_length(all as u64);
        }
        bar.set_position(done as u64);
        bar.set_message(stage.to_string());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// Lets a line move also within a stage, where that is seen and a thread can be had.
fn keep_moving(bar: &ProgressBar) {
    if bar.is_hidden() {
        return;
    }
    let bar = bar.clone();
    let _ = Builder::new().spawn(move || {
        while !bar.is_finished() {
            bar.tick();
            sleep(TICK);
        }
    });
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_templates_are_sound() {
        for template in [OPEN, COUNTED] {
            assert!(ProgressStyle::with_template(template).is_ok(), "{template}");
        }
    }
}
