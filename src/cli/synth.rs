//! `grainform synth`

use super::args::SynthArgs;
use super::console::{Console, put_json};
use super::outputs;
use super::values::{CloudFormat, Subject};
use crate::export::{write_points_ply, write_points_xyz};
use crate::report::{SynthReport, TrayReport};
use crate::shapes::{Body, Origin, SynthOptions, TrayOptions, synthesize, synthesize_tray};
use anyhow::{Result, bail};
use nalgebra::{Point3, Vector3};
use std::io::Write;
use std::path::Path;

pub(super) fn run(args: SynthArgs, console: Console) -> Result<()> {
    let output = (args.output.as_deref(), &["ply", "xyz"][..]);
    let labels = (args.labels.as_deref(), &["txt"][..]);
    let console = console.beside(outputs::check(None, &[output, labels], args.json)?);
    match args.body {
        Subject::Body(body) => body_scan(&args, body, console),
        Subject::Tray => tray(&args, console),
    }
}

fn body_scan(args: &SynthArgs, body: Body, console: Console) -> Result<()> {
    if args.labels.is_some() {
        bail!(
            "--labels tells what the points of a tray were taken from; leave it out for one body"
        );
    }
    let options = SynthOptions {
        body,
        axes: args.axes,
        points: args.points.unwrap_or(body.native_points()),
        sampling: args.sampling,
        noise: args.noise,
        outliers: args.outliers,
        missing_cap: args.missing_cap,
        offset: args.offset,
        seed: args.seed,
    };
    let scan = synthesize(&options)?;
    write_points(args, &scan.points)?;
    let report = SynthReport::new(&options, &scan, written(args));
    if args.json {
        return put_json(&report);
    }
    console.print(&report)
}

fn tray(args: &SynthArgs, console: Console) -> Result<()> {
    let is_of_one_body = args.axes.is_some()
        || args.outliers != 0.0
        || args.missing_cap != 0.0
        || args.offset != Vector3::zeros();
    if is_of_one_body {
        bail!(
            "--axes, --outliers, --missing-cap and --offset are for one body; leave them out for a tray"
        );
    }
    let options = TrayOptions::clean(args.grains)
        .with_noise(args.noise)
        .with_seed(args.seed);
    let options = match args.points {
        Some(points) => options.with_points(points),
        None => options,
    };
    let tray = synthesize_tray(&options)?;
    write_points(args, &tray.points)?;
    if let Some(path) = &args.labels {
        outputs::write(path, |file| Ok(write_labels(&tray.origins, file)?))?;
    }
    let report = TrayReport::new(&options, &tray, written(args));
    if args.json {
        return put_json(&report);
    }
    console.print(&report)
}

fn written(args: &SynthArgs) -> Option<String> {
    args.output.as_deref().map(outputs::name)
}

fn write_points(args: &SynthArgs, points: &[Point3<f64>]) -> Result<()> {
    let Some(path) = &args.output else {
        return Ok(());
    };
    outputs::write(path, |mut file| match format(path, args.format) {
        CloudFormat::Xyz => write_points_xyz(points, &mut file),
        CloudFormat::Ply => write_points_ply(points, &mut file),
    })
}

fn format(path: &Path, of_stream: CloudFormat) -> CloudFormat {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("xyz") => CloudFormat::Xyz,
        Some(_) => CloudFormat::Ply,
        None => of_stream,
    }
}

fn write_labels(origins: &[Origin], file: &mut dyn Write) -> std::io::Result<()> {
    origins.iter().try_for_each(|origin| match origin {
        Origin::Plane => writeln!(file, "plane"),
        Origin::Dust => writeln!(file, "dust"),
        Origin::Grain(number) => writeln!(file, "{}", number + 1),
    })
}
