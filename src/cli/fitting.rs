//! What `fit` and `search` do first: settle the options, read the scan, fit it.

use super::args::FittingArgs;
use super::console::Console;
use super::progress::Progress;
use super::streams::say;
use super::{inputs, threads};
use crate::fit::{self, FitOptions, Fitted, Kind, Stage, Work, whole_or_largest};
use crate::report::{ReportedScan, Seconds, escaped};
use crate::scan::Scan;
use anyhow::{Context, Result, bail};
use std::time::Instant;

/// A fit, and what came with it.
pub(super) struct ScanFit {
    pub(super) fitted: Fitted,
    pub(super) scan: Scan,
    pub(super) reported: ReportedScan,
    pub(super) seconds: Seconds,
}

impl FittingArgs {
    /// The options asked for, if they are in range; also sets the number of threads.
    pub(super) fn settle(&self, console: Console) -> Result<FitOptions> {
        let options = FitOptions {
            kind: Kind::Auto,
            seams: self.seams.0,
            symmetry: self.symmetry,
            degree: self.degree.0,
            segments: self.segments.0,
            max_degree: self.max_degree,
            max_segments: self.max_segments,
            tolerance: self.tolerance,
            ..FitOptions::default()
        };
        if options.degree.is_some() && options.max_degree.is_some() {
            bail!("--max-degree bounds a search, and --degree leaves none: leave one of them out");
        }
        options.check()?;
        threads::start(self.threads, console)?;
        Ok(options)
    }

    pub(super) fn name(&self) -> String {
        inputs::name(&self.scan)
    }
}

/// Reads and fits a scan.
pub(super) fn fit_scan(
    args: &FittingArgs,
    options: &FitOptions,
    progress: &Progress,
) -> Result<ScanFit> {
    let started = Instant::now();
    let name = args.name();
    progress.stage(format_args!("Reading {}", escaped(&name)));
    let scan = inputs::scan(&args.scan, &args.input, args.unit)?;
    let (scan, others_left_out) = whole_or_largest(scan, args.largest);
    let read = started.elapsed().as_secs_f64();

    progress.stage("Finding the surface, the centre and the axes");
    let failed = || format!("cannot fit {name}");
    let tell = |stage: Stage| match stage {
        Stage::Searching {
            done,
            all: Some(all),
        } => progress.step(done, all, "Fitting numbers of segments"),
        Stage::Searching { .. } => progress.stage("Cutting it in segments"),
        _ => progress.stage("Telling shape from noise"),
    };
    let context = fit::Context {
        progress: Some(&tell),
        ..fit::Context::default()
    };
    let fitted = fit::fit_scan(&scan, options, &context).with_context(failed);
    let mut fitted = inputs::explained(fitted, &scan)?;
    fitted.warnings.extend(others_left_out);
    Ok(ScanFit {
        fitted,
        reported: ReportedScan {
            input: name,
            unit: inputs::unit_of(scan.unit(), args.unit),
            warnings: scan.warnings.clone(),
        },
        scan,
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
