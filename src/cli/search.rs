//! `grainform search`

use super::args::SearchArgs;
use super::console::Console;
use super::fitting::{ScanFit, fit_scan, say_stats};
use super::streams::put_json;
use super::{candidates, outputs};
use crate::fit::{FitOptions, Kind};
use crate::report::SearchReport;
use anyhow::Result;
use csv::Writer;
use serde::Serialize;
use std::io::{self, Write};
use std::time::Instant;

pub(super) fn run(args: SearchArgs, console: Console) -> Result<()> {
    let started = Instant::now();
    let fitting = &args.fitting;
    let options = FitOptions {
        exhaustive: true,
        kind: Kind::Star,
        ..fitting.settle(console)?
    };
    let csv = (args.csv.as_deref(), &["csv"][..]);
    let read = Some(fitting.scan.as_path());
    let console = console.beside(outputs::check(read, &[csv], fitting.json)?);

    let progress = console.progress();
    let ScanFit {
        fitted,
        reported,
        mut seconds,
        ..
    } = fit_scan(fitting, &options, &progress)?;
    let mut report = SearchReport::new(reported, &fitted, &options);
    if let Some(path) = &args.csv {
        outputs::write(path, |file| Ok(write_csv(&report, file)?))?;
    }
    drop(progress);
    seconds.total = started.elapsed().as_secs_f64();
    report.seconds = seconds;

    if fitting.json {
        put_json(&report)?;
    } else {
        console.print(candidates::table(&report, console.width()))?;
        console.print(format_args!("*  {}", report.rule))?;
        if let Some(path) = &args.csv {
            console.wrote(&outputs::name(path))?;
        }
        console.warn(&report.warnings);
    }
    if fitting.stats || console.is_verbose() {
        say_stats(&fitted.search.work, &seconds);
    }
    Ok(())
}

/// A row of the candidates in CSV: what is not known is empty.
#[derive(Serialize)]
struct Row<'a> {
    degree: usize,
    segments: usize,
    coefficients: usize,
    area_error: Option<f64>,
    volume_error: Option<f64>,
    heldout_rms: Option<f64>,
    estimate_rms: Option<f64>,
    reduced_segments: usize,
    chosen: u8,
    rejected: Option<&'a str>,
}

fn write_csv(report: &SearchReport, writer: &mut dyn Write) -> io::Result<()> {
    let mut table = Writer::from_writer(writer);
    for (at, row) in report.candidates.iter().enumerate() {
        table.serialize(Row {
            degree: row.degree,
            segments: row.segments,
            coefficients: row.coefficients,
            area_error: row.area_error,
            volume_error: row.volume_error,
            heldout_rms: row.heldout_rms,
            estimate_rms: row.estimate_rms,
            reduced_segments: row.reduced_segments,
            chosen: u8::from(at == report.chosen),
            rejected: row.rejected.as_deref(),
        })?;
    }
    table.flush()
}
