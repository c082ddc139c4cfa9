//! `grainform synth`

use super::args::SynthArgs;
use super::console::Console;
use super::inputs::is_stream;
use super::outputs;
use super::streams::put_json;
use super::values::{CloudFormat, SemiAxes, Subject};
use crate::export::{MeshFormat, write_points_ply, write_points_xyz};
use crate::model::Superquadric;
use crate::report::{CurledReport, SynthReport, TrayReport};
use crate::shapes::{
    self, Curled, CurledOptions, Origin, Sampling, SynthOptions, TrayOptions, synthesize,
    synthesize_curled, synthesize_tray,
};
use anyhow::{Result, bail};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use std::fmt::Display;
use std::io::Write;
use std::path::Path;

/// Semi-axes of a superquadric where none are given.
const SUPERQUADRIC_AXES: [f64; 3] = [2.0, 2.0, 1.0];

/// Its exponents n1 and n2.
const EXPONENTS: [f64; 2] = [4.0, 2.0];

/// Grains on a tray where no number is given.
const GRAINS: usize = 100;

pub(super) fn run(args: SynthArgs, console: Console) -> Result<()> {
    let is_mesh = matches!(args.body, Subject::Curled(_)) && args.points.is_none();
    let extensions: &[&str] = match is_mesh {
        true => outputs::MESH,
        false => &["ply", "xyz"],
    };
    let output = (args.output.as_deref(), extensions);
    let labels = (args.labels.as_deref(), &["txt"][..]);
    let console = console.beside(outputs::check(None, &[output, labels], args.json)?);
    if args.labels.is_some() && args.body != Subject::Tray {
        bail!(
            "--labels tells what the points of a tray were taken from; leave it out for one body"
        );
    }
    if args.grains.is_some() && args.body != Subject::Tray {
        bail!("--grains counts the grains on a tray; leave it out for one body");
    }
    if args.sampling.is_some() && matches!(args.body, Subject::Curled(_) | Subject::Tray) {
        bail!(
            "--sampling lays out the directions in which one centre sees a body; leave it out for a tray, and for what no \
             centre sees whole"
        );
    }
    let is_superquadric = matches!(args.body, Subject::Superquadric | Subject::Poly);
    if args.exponents.is_some() && !is_superquadric {
        bail!("--exponents are those of a superquadric or a poly; leave them out");
    }
    let writes_points = !is_mesh && args.output.as_deref().is_some_and(is_stream);
    if args.format.is_some() && !writes_points {
        bail!("--format is that of points on standard output (-o -): leave it out");
    }
    match args.body {
        Subject::Body(body) => body_scan(&args, body.into(), console),
        Subject::Superquadric | Subject::Poly => {
            body_scan(&args, superquadric(&args)?.into(), console)
        }
        Subject::Curled(body) => curled(&args, body, console),
        Subject::Tray => tray(&args, console),
    }
}

fn superquadric(args: &SynthArgs) -> Result<Superquadric> {
    let [n1, n2] = args.exponents.unwrap_or(EXPONENTS);
    let axes = args.axes.clone();
    Ok(
        match (
            args.body,
            axes.unwrap_or(SemiAxes::Three(SUPERQUADRIC_AXES)),
        ) {
            (_, SemiAxes::Three(axes)) => Superquadric::single(axes, n1, n2)?,
            (Subject::Poly, SemiAxes::Six(axes)) => Superquadric::poly8(axes, n1, n2)?,
            (_, SemiAxes::Six(_)) => bail!("six semi-axes are those of a poly: synth poly"),
        },
    )
}

fn body_scan(args: &SynthArgs, body: shapes::Subject, console: Console) -> Result<()> {
    let axes = match (body, &args.axes) {
        (shapes::Subject::Body(_), Some(SemiAxes::Three(axes))) => Some((*axes).into()),
        (shapes::Subject::Body(_), Some(SemiAxes::Six(_))) => {
            bail!("six semi-axes are those of a poly: synth poly")
        }
        _ => None,
    };
    let options = SynthOptions {
        body,
        axes,
        points: args.points.unwrap_or(body.native_points()),
        sampling: args.sampling.unwrap_or(Sampling::Cube),
        noise: args.noise,
        outliers: args.outliers,
        missing_cap: args.missing_cap,
        offset: args.offset,
        seed: args.seed,
    };
    let scan = synthesize(&options)?;
    write_points(args, &scan.points)?;
    tell(
        args,
        SynthReport::new(&options, &scan, written(args)),
        console,
    )
}

fn curled(args: &SynthArgs, body: Curled, console: Console) -> Result<()> {
    if args.axes.is_some() || args.outliers != 0.0 || args.missing_cap != 0.0 {
        bail!(
            "the {body} has one size and is seen whole: leave --axes, --outliers and --missing-cap out"
        );
    }
    let options = CurledOptions::clean(body)
        .with_points(args.points)
        .with_noise(args.noise)
        .with_offset(args.offset)
        .with_seed(args.seed);
    let scan = synthesize_curled(&options)?;
    match &args.output {
        Some(path) if options.points.is_none() => {
            let format = MeshFormat::of(path).unwrap_or(MeshFormat::Ply);
            outputs::write(path, |file| format.write(&scan.mesh, file))?;
        }
        _ => write_points(args, &scan.mesh.vertices)?,
    }
    tell(
        args,
        CurledReport::new(&options, &scan, written(args)),
        console,
    )
}

/// Prints what was made.
fn tell(args: &SynthArgs, report: impl Serialize + Display, console: Console) -> Result<()> {
    match args.json {
        true => put_json(&report),
        false => console.print(&report),
    }
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
    let options = TrayOptions::clean(args.grains.unwrap_or(GRAINS))
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
    tell(
        args,
        TrayReport::new(&options, &tray, written(args)),
        console,
    )
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

fn format(path: &Path, of_stream: Option<CloudFormat>) -> CloudFormat {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("xyz") => CloudFormat::Xyz,
        Some(_) => CloudFormat::Ply,
        None => of_stream.unwrap_or(CloudFormat::Ply),
    }
}

fn write_labels(origins: &[Origin], file: &mut dyn Write) -> std::io::Result<()> {
    origins.iter().try_for_each(|origin| match origin {
        Origin::Plane => writeln!(file, "plane"),
        Origin::Dust => writeln!(file, "dust"),
        Origin::Grain(number) => writeln!(file, "{}", number + 1),
    })
}
