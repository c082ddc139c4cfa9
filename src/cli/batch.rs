//! `grainform batch`

use super::args::BatchArgs;
use super::console::Console;
use super::count::Count;
use super::outliers::print_outliers;
use super::{outputs, signals, threads};
use crate::batch::{Batch, Inputs, Population, Settings, check_folder, inputs, run as run_batch};
use crate::digits::plural;
use crate::fit::FitOptions;
use crate::report::{Measure, short};
use anyhow::Result;
use comfy_table::{CellAlignment, Table, presets::NOTHING};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::thread::available_parallelism;

/// Cells along an edge of the cube of directions of a mesh.
const RESOLUTION: usize = 64;

/// Failures that are told on the terminal; the files have all.
const MOST_TOLD: usize = 20;

/// Some scans have no result; all others are done.
#[derive(Debug, thiserror::Error)]
#[error("{failed} of {all} scans have no result; results.csv tells why")]
pub(super) struct SomeFailed {
    failed: usize,
    all: usize,
}

pub(super) fn run(args: BatchArgs, console: Console) -> Result<()> {
    let fit = FitOptions::default()
        .with_tolerance(args.tolerance)
        .with_segments(args.segments.0);
    fit.check()?;
    outputs::check_folder(&args.output)?;
    check_folder(&args.output, &args.paths)?;
    let Inputs { scans, left_out } = inputs(&args.paths)?;
    tell_left_out(&left_out, console);
    let batch = Batch {
        inputs: scans,
        folder: args.output.clone(),
        settings: Settings {
            fit,
            largest: args.largest,
            measures: match args.only.as_slice() {
                [] => Measure::ALL.to_vec(),
                asked => asked.to_vec(),
            },
            unit: args.unit,
            max_bytes: args.limit.max_bytes,
            models: args.models,
            meshes: args.meshes.then_some(RESOLUTION),
        },
        jobs: match args.jobs {
            0 => available_parallelism().map_or(1, usize::from),
            jobs => threads::bounded(jobs, "--jobs", console),
        },
    };
    let count = Count::new(batch.inputs.len(), console);
    signals::keeps_work(console);
    let done = run_batch(&batch, &|step| count.hear(step))?;
    drop(count);

    if done.kept > 0 {
        let kept = format!(
            "{} of {} rows are those of an earlier run",
            done.kept, done.all
        );
        console.note("note", &kept);
    }
    tell(&done.population, console)?;
    console.warn(&done.population.warnings);
    for path in &done.files {
        console.wrote(&path.display().to_string())?;
    }
    if let Some(first) = done.left_over.first() {
        let note = format!(
            "no row is of {} that earlier runs left, such as {}: remove what is not needed, or write into another folder",
            plural(done.left_over.len(), "file"),
            first.display()
        );
        console.note("note", &note);
    }
    for (path, reason) in done.failed.iter().take(MOST_TOLD) {
        console.note("failed", &format!("{path}: {reason}"));
    }
    match done.failed.len() {
        0 => Ok(()),
        failed => Err(SomeFailed {
            failed,
            all: done.all,
        }
        .into()),
    }
}

/// Tells of what is left out in folders: pipes and devices, and files that are not named as scans are, for tables of
/// points may be among them.
fn tell_left_out(paths: &[PathBuf], console: Console) {
    let (files, others): (Vec<_>, Vec<_>) = paths.iter().partition(|path| path.is_file());
    if let Some(first) = others.first() {
        let note = match others.len() {
            1 => format!("left out {}, which is no file", first.display()),
            count => format!(
                "left out {count} that are no files, such as {}",
                first.display()
            ),
        };
        console.note("note", &note);
    }
    let Some(first) = files.first() else {
        return;
    };
    let ending = |path: &&PathBuf| match path.extension() {
        Some(extension) => format!(".{}", extension.to_string_lossy()),
        None => "none".into(),
    };
    let endings: BTreeSet<String> = files.iter().map(ending).collect();
    let endings: Vec<String> = endings.into_iter().collect();
    let note = format!(
        "left {} out, such as {}, whose endings ({}) are not those of scans: name those that hold points to fit them too",
        plural(files.len(), "file"),
        first.display(),
        endings.join(", ")
    );
    console.note("note", &note);
}

/// What the grains are like together.
fn tell(population: &Population, console: Console) -> Result<()> {
    if population.measures.is_empty() {
        return Ok(());
    }
    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "measure",
        "grains",
        "mean",
        "deviation",
        "5 %",
        "median",
        "95 %",
    ]);
    for measure in &population.measures {
        let [_, low, _, median, _, high, _] = measure.quantiles.map(short);
        let deviation = measure.deviation.map_or("-".into(), short);
        let count = measure.count.to_string();
        table.add_row([
            measure.measure.clone(),
            count,
            short(measure.mean),
            deviation,
            low,
            median,
            high,
        ]);
    }
    print(table, console)?;

    let mut table = Table::new();
    let names = population.measures.iter().enumerate();
    let header = names.clone().map(|(at, _)| (at + 1).to_string());
    table
        .load_style(NOTHING)
        .set_header(std::iter::once("correlation".to_owned()).chain(header));
    for ((at, measure), row) in names.zip(&population.correlations) {
        let cells = row
            .iter()
            .map(|cell| cell.map_or("-".into(), |found| format!("{found:.2}")));
        let name = format!("{} {}", at + 1, measure.measure);
        table.add_row(std::iter::once(name).chain(cells));
    }
    print(table, console)?;

    print_outliers(&population.outliers, "", "in summary.json", console)
}

fn print(mut table: Table, console: Console) -> Result<()> {
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    console.print(format_args!("{}\n", table.trim_fmt()))
}
