//! Ctrl-C and its like: temporary files are removed and the terminal is left as it was, then the process ends as it would have.

use super::console::Console;
use super::progress;
use crate::export::remove_temporaries;
use anyhow::{Context, Result};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::sync::{Arc, OnceLock};
use std::thread;

/// Who is told that the work can go on.
static GOES_ON: OnceLock<Console> = OnceLock::new();

/// From here on work is saved as it is done: whoever ends the process by a signal is told so.
pub(super) fn keeps_work(console: Console) {
    let _ = GOES_ON.set(console);
}

/// Waits for the signals in a thread of its own. Where they cannot be heard of, they end the process at once.
pub(super) fn watch() -> Result<()> {
    let heeded = [SIGHUP, SIGINT, SIGTERM]
        .into_iter()
        .filter(|signal| !is_ignored(*signal));
    let Ok(mut signals) = Signals::new(heeded) else {
        return Ok(());
    };
    let wait = move || {
        for signal in signals.forever() {
            remove_temporaries();
            progress::clear();
            if let Some(console) = GOES_ON.get() {
                console.note("stopped", "the same command goes on from what is saved");
            }
            let _ = emulate_default_handler(signal);
        }
    };
    let started = thread::Builder::new().spawn(wait);
    started.context(
        "cannot start a thread; allow this user more of them, or this process more memory (ulimit)",
    )?;
    Ok(())
}

/// From here on writing more of a file than the process may is an error, and does not end it.
pub(super) fn outlive_large_files() {
    let _ = flag::register(SIGXFSZ, Arc::default());
}

/// Whether the process was started to ignore a signal, as `nohup` does with SIGHUP: then it goes on doing so. Only
/// Linux tells.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
