//! What a fit is given beside its data: threads, a way to stop it, and somebody to tell how far it is.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};

/// Threads, a cancel flag and progress of a fit. The default works on the global threads, cannot be
/// cancelled and tells nobody.
#[derive(Clone, Copy, Default)]
pub struct Context<'a> {
    /// The threads to work on; those of the caller where `None`.
    pub threads: Option<&'a rayon::ThreadPool>,
    /// Set to `true` from another thread, it ends the fit with an error soon after.
    pub cancel: Option<&'a AtomicBool>,
    /// Told at the start of every stage.
    pub progress: Option<&'a (dyn Fn(Stage) + Sync)>,
}

/// What a fit is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Telling shape from noise.
    Estimating,
    /// Searching segments; so many candidates or rounds are done.
    Searching {
        /// Candidates or rounds done.
        done: usize,
        /// All there are, where that is known.
        all: Option<usize>,
    },
}

/// The fit was asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cancelled;

impl Context<'_> {
    /// Ends the work if the fit was asked to stop.
    pub(crate) fn check(&self) -> Result<(), Cancelled> {
        match self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            true => Err(Cancelled),
            false => Ok(()),
        }
    }

    /// Tells what is done now, unless the fit was asked to stop.
    pub(crate) fn enter(&self, stage: Stage) -> Result<(), Cancelled> {
        self.check()?;
        if let Some(progress) = self.progress {
            progress(stage);
        }
        Ok(())
    }

    /// Runs work on the threads of this context.
    pub(crate) fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match self.threads {
            Some(threads) => threads.install(work),
            None => work(),
        }
    }
}

impl fmt::Debug for Context<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context")
            .field(
                "threads",
                &self.threads.map(|pool| pool.current_num_threads()),
            )
            .field("cancel", &self.cancel)
            .field("progress", &self.progress.is_some())
            .finish()
    }
}
