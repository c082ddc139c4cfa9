//! `grainform search`

use super::args::SearchArgs;
use super::fitting::{ScanFit, fit_scan, say_stats};
use super::progress::Progress;
use super::{outputs, print, print_json, warn};
use crate::export::write_atomically;
use crate::fit::FitOptions;
use crate::report::{SearchReport, percent, short};
use anyhow::Result;
use comfy_table::{CellAlignment, Table, presets::NOTHING};
use std::time::Instant;

pub(super) fn run(args: SearchArgs) -> Result<()> {
    let started = Instant::now();
    let fitting = &args.fitting;
    let options = FitOptions {
        exhaustive: true,
        ..fitting.settle()?
    };
    outputs::check(Some(&fitting.scan), &[(args.csv.as_deref(), &["csv"])])?;

    let progress = Progress::new(fitting.quiet);
    let ScanFit {
        fitted,
        scan_warnings,
        mut seconds,
    } = fit_scan(&fitting.scan, &options, &progress)?;
    let mut report = SearchReport::new(fitting.name(), &fitted, &options, &scan_warnings);
    if let Some(path) = &args.csv {
        write_atomically(path, |file| Ok(report.write_csv(file)?))?;
    }
    drop(progress);
    seconds.total = started.elapsed().as_secs_f64();
    report.seconds = seconds;

    if fitting.json {
        print_json(&report)?;
    } else if !fitting.quiet {
        print(table(&report).trim_fmt())?;
        print(format_args!("* {}", report.rule))?;
        if let Some(path) = &args.csv {
            print(format_args!("wrote {}", path.display()))?;
        }
        warn(&report.warnings);
    }
    if fitting.stats {
        say_stats(&fitted.search.work, &seconds);
    }
    Ok(())
}

/// The candidates, the chosen one marked with a star.
fn table(report: &SearchReport) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "",
        "segments",
        "degree",
        "coefficients",
        "area",
        "volume",
        "held-out RMS",
        "difference",
        "reduced",
        "rejected",
    ]);
    let error = |error: Option<f64>| error.map_or("-".into(), percent);
    for (index, row) in report.candidates.iter().enumerate() {
        table.add_row([
            if index == report.chosen { "*" } else { "" }.into(),
            row.segments.to_string(),
            row.degree.to_string(),
            row.coefficients.to_string(),
            error(row.area_error),
            error(row.volume_error),
            row.heldout_rms.map_or("-".into(), short),
            row.estimate_rms.map_or("-".into(), short),
            row.reduced_segments.to_string(),
            row.rejected.clone().unwrap_or_default(),
        ]);
    }
    for column in table.column_iter_mut().skip(1).take(8) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}
