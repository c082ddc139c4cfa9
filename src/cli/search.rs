//! `grainform search`

use super::args::SearchArgs;
use super::console::Console;
use super::fitting::{ScanFit, fit_scan, say_stats};
use super::streams::put_json;
use super::{candidates, outputs};
use crate::fit::{FitOptions, Kind};
use crate::report::SearchReport;
use anyhow::Result;
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
        outputs::write(path, |mut file| Ok(report.write_csv(&mut file)?))?;
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
