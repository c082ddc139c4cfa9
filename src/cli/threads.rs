//! How many threads work.

use super::console::Console;
use anyhow::{Context, Result};
use std::thread::available_parallelism;

/// Threads per core beyond which more only cost memory.
const PER_CORE: usize = 4;

/// What rayon takes the number of threads from.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Starts the threads asked for, or named in the environment, or one per core: 0.
pub(super) fn start(asked: usize, console: Console) -> Result<()> {
    let named = || std::env::var(VARIABLE).ok()?.parse().ok();
    let (asked, source) = match asked {
        0 => (named().unwrap_or(0), VARIABLE),
        asked => (asked, "--threads"),
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(bounded(asked, source, console))
        .build_global()
        .context("cannot start the threads; ask for fewer with --threads")
}

/// The number of threads that `source` asks for, or the most that are of use, with a note.
pub(super) fn bounded(asked: usize, source: &str, console: Console) -> usize {
    let cores = available_parallelism().map_or(1, usize::from);
    let most = PER_CORE * cores;
    if asked > most {
        console.note(
            "note",
            &format!(
                "{source} asks for {asked} threads; {most} are used, {PER_CORE} for each core of this machine"
            ),
        );
    }
    asked.min(most)
}
