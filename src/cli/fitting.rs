//! What `fit` and `search` do first: settle the options, read the scan, fit it.

use super::args::FittingArgs;
use super::progress::Progress;
use super::say;
use crate::fit::{self, FitOptions, Fitted, PreparedScan, Stage, Work};
use crate::report::Seconds;
use crate::scan::read_scan;
use anyhow::{Context, Result};
use std::path::Path;
use std::time::Instant;

/// A fit, and what came with it.
pub(super) struct ScanFit {
    pub(super) fitted: Fitted,
    pub(super) scan_warnings: Vec<String>,
    pub(super) seconds: Seconds,
}

impl FittingArgs {
    /// The options asked for, if they are in range; also sets the number of threads.
    pub(super) fn settle(&self) -> Result<FitOptions> {
        let options = FitOptions {
            seams: self.seams.0,
            symmetry: self.symmetry,
            degree: self.degree.0,
            segments: self.segments.0,
            max_degree: self.max_degree,
            max_segments: self.max_segments,
            tolerance: self.tolerance,
            exhaustive: self.exhaustive,
        };
        options.check()?;
        rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads.into())
            .build_global()
            .context("cannot start the threads; ask for fewer with --threads")?;
        Ok(options)
    }

    pub(super) fn name(&self) -> String {
        self.scan.display().to_string()
    }
}

/// Reads and fits a scan.
pub(super) fn fit_scan(path: &Path, options: &FitOptions, progress: &Progress) -> Result<ScanFit> {
    let started = Instant::now();
    progress.stage(format_args!("Reading {}", path.display()));
    let scan = read_scan(path)?;
    let read = started.elapsed().as_secs_f64();

    progress.stage("Finding the surface, the centre and the axes");
    let failed = || format!("cannot fit {}", path.display());
    let prepared = PreparedScan::new(&scan, options.symmetry).with_context(failed)?;
    let tell = |stage: Stage| match stage {
        Stage::Searching { done } if done > 0 => {
            progress.stage(format_args!("Fitting: {done} numbers of segments done"));
        }
        Stage::Searching { .. } => progress.stage("Cutting it in segments"),
        _ => progress.stage("Telling shape from noise"),
    };
    let context = fit::Context {
        progress: Some(&tell),
        ..fit::Context::default()
    };
    let fitted = prepared.fit(options, &context).with_context(failed)?;
    Ok(ScanFit {
        fitted,
        scan_warnings: scan.warnings,
        seconds: Seconds {
            read,
            search: started.elapsed().as_secs_f64() - read,
            ..Seconds::default()
        },
    })
}

/// Tells what was fitted, what was skipped, and how long it took.
pub(super) fn say_stats(work: &Work, seconds: &Seconds) {
    say(format_args!(
        "candidates  {} fitted, {} skipped",
        work.candidates, work.candidates_skipped
    ));
    say(format_args!(
        "segments    {} fitted, {} skipped",
        work.segments, work.segments_skipped
    ));
    say(format_args!(
        "seconds     read {:.3}, search {:.3}, mesh {:.3}, total {:.3}",
        seconds.read, seconds.search, seconds.mesh, seconds.total
    ));
}
