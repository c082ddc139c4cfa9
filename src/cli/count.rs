//! How many of many are done, how fast, and how long the rest will take.

use super::console::Console;
use super::progress::Progress;
use super::streams::say;
use crate::batch::{Progress as SoFar, Step};
use crate::report::escaped;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// On a terminal.
const TEMPLATE: &str = "[{bar:20}] {pos} of {len}, {per_sec}, {elapsed} gone, {eta} left";

/// How often a line is told elsewhere.
const EVERY: Duration = Duration::from_secs(10);

/// Told on standard error while it lives: where it is asked for, lines of each; else a bar on a terminal, elsewhere a line
/// now and then.
pub(super) enum Count {
    Bar(ProgressBar),
    Each(Progress),
    Lines {
        started: Instant,
        told: Mutex<Instant>,
    },
}

impl Count {
    pub(super) fn new(all: usize, console: Console) -> Self {
        let started = Instant::now();
        match (console.is_quiet(), stderr().is_terminal()) {
            (true, _) => Self::Bar(ProgressBar::hidden()),
            _ if console.is_verbose() => Self::Each(Progress::lines()),
            (_, true) => {
                let style = ProgressStyle::with_template(TEMPLATE);
                let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
                Self::Bar(ProgressBar::new(all as u64).with_style(style))
            }
            _ => Self::Lines {
                started,
                told: Mutex::new(started),
            },
        }
    }

    /// One of them begins, or is done: of all that are, some took no time.
    pub(super) fn hear(&self, step: Step) {
        let (name, SoFar { done, kept, all }) = match (self, step) {
            (Self::Each(lines), Step::Begun(name)) => {
                return lines.stage(format_args!("Fitting {}", escaped(name)));
            }
            (_, Step::Begun(_)) => return,
            (_, Step::Done(name, so_far)) => (name, so_far),
        };
        match self {
            Self::Each(lines) => lines.step(done, all, format_args!("Ended {}", escaped(name))),
            Self::Bar(bar) => {
                bar.set_length(all as u64);
                bar.set_position(done as u64);
            }
            Self::Lines { started, told } => {
                let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
                if told.elapsed() < EVERY {
                    return;
                }
                *told = Instant::now();
                let rate = (done - kept) as f64 / started.elapsed().as_secs_f64();
                let left =
                    Duration::try_from_secs_f64((all - done) as f64 / rate).unwrap_or_default();
                say(format_args!(
                    "{done} of {all}, {rate:.1}/s, {} left",
                    HumanDuration(left)
                ));
            }
        }
    }
}

impl Drop for Count {
    fn drop(&mut self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_sound() {
        assert!(ProgressStyle::with_template(TEMPLATE).is_ok());
    }
}
