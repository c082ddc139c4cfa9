//! `grainform fit`

use super::args::FitArgs;
use super::console::Console;
use super::fitting::{ScanFit, fit_scan, say_stats};
use super::streams::put_json;
use super::values::SurfaceArg;
use super::{outputs, superquadric};
use crate::digits::plural;
use crate::fit::{FitOptions, Fitted, Seams};
use crate::model::{Grain, Surface};
use crate::report::{FitReport, largest_loss, write_harmonics, write_position_harmonics};
use crate::sphere::{Symmetry, cube_grid};
use crate::unit::asked_or_told;
use anyhow::{Result, bail};
use std::hint::black_box;
use std::time::Instant;

pub(super) fn run(args: FitArgs, console: Console) -> Result<()> {
    let started = Instant::now();
    let fitting = &args.fitting;
    let options = FitOptions {
        exhaustive: args.exhaustive,
        ..fitting.settle(console)?
    };
    if let Some(path) = &args.mesh {
        args.meshing.check_for(path, console)?;
    }
    let is_taken = outputs::check(
        Some(fitting.scan.as_path()),
        &[
            (args.output.as_deref(), &["json"]),
            (args.mesh.as_deref(), outputs::MESH),
            (args.harmonics.as_deref(), &["csv"]),
            (args.png.as_deref(), &["png"]),
        ],
        fitting.json,
    )?;
    let console = console.beside(is_taken);
    let options = match args.surface {
        SurfaceArg::Kind(kind) => options.with_kind(kind),
        SurfaceArg::Superquadric(form) => {
            return superquadric::run(&args, form, &options, console);
        }
    };
    options.check()?;
    if options.exhaustive && options.seams == Seams::Blended && options.symmetry == Symmetry::NONE {
        bail!(
            "--exhaustive is for independent segments (--seams none) and mirrored expansions (--symmetry): leave it out"
        );
    }

    let progress = console.progress();
    let ScanFit {
        mut fitted,
        scan,
        reported,
        mut seconds,
    } = fit_scan(fitting, &options, &progress)?;
    let is_told = fitting.json || !console.is_quiet();
    progress.stage("Measuring");
    if args.output.is_some() {
        fitted.grain = fitted
            .grain_with_errors()
            .with_unit(asked_or_told(fitting.unit, scan.unit()));
    }
    let unit = reported.unit;
    let report_of = match args.extrapolate {
        true => FitReport::extrapolated,
        false => FitReport::new,
    };
    let mut report =
        is_told.then(|| report_of(reported, &fitted, &options).timed(&fitted, nanoseconds));
    let before = started.elapsed().as_secs_f64();
    if args.writes() {
        progress.stage("Writing");
    }
    let doubts = outputs::write_grain(&args, &fitted.grain)?;
    let loss = write_published(&args, &fitted)?;
    if let Some(path) = &args.png {
        progress.stage("Drawing");
        let choice = fitted.search.choice();
        let segments = match choice.segments {
            1 => "the whole sphere".into(),
            segments => plural(segments, "segment"),
        };
        let title = format!(
            "{}: {}; degree {}, {segments}, {}",
            fitting.name(),
            plural(fitted.points, "point"),
            choice.degree,
            plural(fitted.grain.coefficient_count(), "coefficient")
        );
        outputs::write_picture(path, &fitted.grain, Some(&scan), title, unit)?;
    }
    drop(progress);
    seconds.total = started.elapsed().as_secs_f64();
    seconds.mesh = seconds.total - before;
    if let Some(report) = &mut report {
        report.harmonics_loss = loss;
        report.warnings.extend(doubts);
        report.seconds = seconds;
    }

    if fitting.json {
        put_json(&report)?;
    } else if let Some(report) = &report {
        console.print(report)?;
        for path in [&args.output, &args.mesh, &args.harmonics, &args.png]
            .into_iter()
            .flatten()
        {
            console.wrote(&outputs::name(path))?;
        }
        console.warn(&report.warnings);
    }
    if fitting.stats || console.is_verbose() {
        say_stats(&fitted.search.work, &seconds);
    }
    Ok(())
}

/// Writes published coefficients, where they are asked for; gives what the conversion to them loses.
fn write_published(args: &FitArgs, fitted: &Fitted) -> Result<Option<f64>> {
    let Some(path) = &args.harmonics else {
        return Ok(None);
    };
    let loss = match (fitted.grain.star(), fitted.grain.position()) {
        (Some(grain), _) => {
            let published = grain.published();
            outputs::write(path, |mut file| {
                Ok(write_harmonics(grain, &published, &mut file)?)
            })?;
            largest_loss(&published)
        }
        (None, Some(grain)) => {
            let published = grain.published();
            outputs::write(path, |mut file| {
                Ok(write_position_harmonics(grain, &published, &mut file)?)
            })?;
            largest_loss(published.as_flattened())
        }
        (None, None) => return Ok(None),
    };
    Ok(Some(loss))
}

/// Cells along a cube's edge of the directions that are timed: 98 directions.
const TIMED: usize = 4;

/// Times that they are evaluated: the least is told.
const REPEATS: usize = 3;

/// The time of one evaluation of a grain, measured here and now.
fn nanoseconds(grain: &Grain) -> f64 {
    let (directions, _) = cube_grid(TIMED);
    let seconds = (0..REPEATS).map(|_| {
        let started = Instant::now();
        for n in &directions {
            black_box(grain.place(black_box(n)));
        }
        started.elapsed().as_secs_f64()
    });
    1e9 * seconds.fold(f64::INFINITY, f64::min) / directions.len() as f64
}
