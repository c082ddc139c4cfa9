//! `grainform measure`

use super::args::MeasureArgs;
use super::console::Console;
use super::{inputs, threads};
use crate::fit::scanned_surface;
use crate::measure::{Scheme, Survey, scanned_body, smoothed_area};
use crate::mesh::Mesh;
use crate::report::{Measure, MeasureReport, Measured, Unit, Withheld, percent, sentences, short};
use crate::scan::Scan;
use anyhow::{Context, Result, bail};
use std::ops::RangeInclusive;

/// What the roughness of points adds to the area of their polyhedron, where it is told all the same.
const WORTH_A_WORD: RangeInclusive<f64> = 0.01..=0.05;

pub(super) fn run(args: MeasureArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    let progress = console.progress();
    progress.stage("Measuring");
    let report = measure(&args)?;
    drop(progress);
    console.tell(&report, args.json, None, &report.warnings)
}

fn measure(args: &MeasureArgs) -> Result<MeasureReport> {
    let path = &args.path;
    let input = inputs::name(path);
    let only = match args.only.as_slice() {
        [] => Measure::ALL.as_slice(),
        asked => asked,
    };
    let bytes = inputs::read(path, &args.input.limit)?;
    if inputs::is_model(path, &bytes, &args.input)? {
        let grain = inputs::parse_model(path, &bytes, args.unit)?;
        let survey = Survey::of_grain(&grain, args.scheme.0);
        let withheld = Withheld::of(&grain, args.extrapolate);
        let foreign = inputs::foreign_unit(&grain, &input);
        let mut report = MeasureReport::of_model(input, &survey, only, &withheld);
        report.warnings.extend(foreign);
        return Ok(report.in_unit(inputs::unit_of(grain.unit(), args.unit)));
    }
    if args.scheme.0 != Scheme::Exact {
        bail!("{input} is a scan: integration schemes are for models; leave --scheme out");
    }
    let scan = inputs::parse_scan(path, &bytes, &args.input, args.unit)?;
    inputs::explained(measure_scan(args, input, only, &scan), &scan)
}

fn measure_scan(
    args: &MeasureArgs,
    input: String,
    only: &[Measure],
    scan: &Scan,
) -> Result<MeasureReport> {
    let unit = inputs::unit_of(scan.unit(), args.unit);
    if scan.is_flat() {
        bail!("cannot measure {input}: all points lie in one plane, they do not enclose a body");
    }
    if let Some(scanned) = scanned_body(scan) {
        let mut warnings = scan.warnings.clone();
        let voxels = scan.voxel_volume();
        let of = match voxels {
            Some(_) => Measured::Voxels,
            None => Measured::Faces,
        };
        warnings.extend(voxels.map(|volume| between_voxels(volume, unit)));
        return Ok(MeasureReport::of_faces(
            input, &scanned, of, only, unit, warnings,
        ));
    }
    let surface = scanned_surface(scan).with_context(|| format!("cannot measure {input}"))?;
    let survey =
        Survey::of_mesh(&surface.mesh).with_context(|| format!("cannot measure {input}"))?;
    let mut warnings = sentences(&scan.warnings, &surface.warnings, unit);
    let roughness = roughness(&survey, &surface.mesh);
    if WORTH_A_WORD.contains(&roughness) {
        warnings.push(format!(
            "The points are rough: the area is {} larger than it is where each point is moved half-way to the mean of its \
             neighbours. Of noise, or where a ray from the centre meets the surface more than once, all of that and more is \
             false: fit the scan, and measure the model.",
            percent(roughness)
        ));
    }
    let report = MeasureReport::of_points(
        input,
        &surface,
        &survey,
        only,
        roughness,
        args.extrapolate,
        warnings,
    );
    Ok(report.in_unit(unit))
}

/// What to know of faces between voxels, which take up a volume.
fn between_voxels(volume: f64, unit: Option<Unit>) -> String {
    let unit = unit.map_or(String::new(), |unit| format!(" {unit}³"));
    format!(
        "The faces go through the middles between voxels inside and outside, and cut off the corners of voxels, whose \
         volume is {}{unit}. Fit the volume, and measure the model.",
        short(volume)
    )
}

/// What the roughness of points adds to the area of their polyhedron, as a share.
fn roughness(survey: &Survey, mesh: &Mesh) -> f64 {
    let area = survey.area();
    area.map_or(0.0, |area| area / smoothed_area(mesh) - 1.0)
}
