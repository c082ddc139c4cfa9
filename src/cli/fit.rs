//! `grainform fit`

use super::args::FitArgs;
use super::fitting::{ScanFit, fit_scan, say_stats};
use super::progress::Progress;
use super::{outputs, print, print_json, warn};
use crate::export::{save_mesh, write_atomically};
use crate::fit::Fitted;
use crate::model::save_grain;
use crate::report::{FitReport, largest_loss, write_harmonics};
use anyhow::Result;
use std::io::Write;
use std::time::Instant;

pub(super) fn run(args: FitArgs) -> Result<()> {
    let started = Instant::now();
    let fitting = &args.fitting;
    let options = fitting.settle()?;
    outputs::check(
        Some(&fitting.scan),
        &[
            (args.output.as_deref(), &["json"]),
            (args.mesh.as_deref(), outputs::MESH),
            (args.harmonics.as_deref(), &["csv"]),
        ],
    )?;

    let progress = Progress::new(fitting.quiet);
    let ScanFit {
        fitted,
        scan_warnings,
        mut seconds,
    } = fit_scan(&fitting.scan, &options, &progress)?;
    let is_told = fitting.json || !fitting.quiet;
    progress.stage("Measuring");
    let mut report =
        is_told.then(|| FitReport::new(fitting.name(), &fitted, &options, &scan_warnings));
    let before = started.elapsed().as_secs_f64();
    progress.stage("Writing");
    let loss = write_files(&args, &fitted)?;
    drop(progress);
    seconds.total = started.elapsed().as_secs_f64();
    seconds.mesh = seconds.total - before;
    if let Some(report) = &mut report {
        report.harmonics_loss = loss;
        report.seconds = seconds;
    }

    if fitting.json {
        print_json(&report)?;
    } else if let Some(report) = &report {
        print(report)?;
        for path in [&args.output, &args.mesh, &args.harmonics]
            .into_iter()
            .flatten()
        {
            print(format_args!("wrote {}", path.display()))?;
        }
        warn(&report.warnings);
    }
    if fitting.stats {
        say_stats(&fitted.search.work, &seconds);
    }
    Ok(())
}

/// Writes the files asked for; gives what the conversion to published coefficients loses.
fn write_files(args: &FitArgs, fitted: &Fitted) -> Result<Option<f64>> {
    let grain = &fitted.grain;
    if let Some(path) = &args.mesh {
        save_mesh(path, &grain.mesh(args.meshing.resolution.into()))?;
    }
    if let Some(path) = &args.output {
        let text = save_grain(&fitted.grain_with_errors());
        write_atomically(path, |file| Ok(writeln!(file, "{text}")?))?;
    }
    let Some(path) = &args.harmonics else {
        return Ok(None);
    };
    let published = grain.published();
    write_atomically(path, |file| Ok(write_harmonics(grain, &published, file)?))?;
    Ok(Some(largest_loss(&published)))
}
