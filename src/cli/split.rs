//! `grainform split`

use super::args::SplitArgs;
use super::console::Console;
use super::{inputs, outputs, threads};
use crate::export::{save_mesh, write_split_grain};
use crate::mesh::Mesh;
use crate::report::SplitReport;
use crate::scan::{Split, SplitGrain, Volume, split, split_labels, split_uncut};
use crate::unit::asked_or_told;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Of the files of grains: of surfaces and points, and of voxels.
const EXTENSIONS: [&str; 2] = ["ply", "nrrd"];

pub(super) fn run(args: SplitArgs, console: Console) -> Result<()> {
    outputs::check_folder(&args.output)?;
    spares_the_scan(&args.scan, &args.output)?;
    threads::start(args.threads, console)?;
    let name = inputs::name(&args.scan);
    let progress = console.progress();
    progress.stage("Reading");
    let bytes = inputs::read(&args.scan, &args.input.limit)?;
    let failed = || format!("cannot split {name}");
    let volume = inputs::parse_labels(&args.scan, &bytes, &args.input, args.unit)?;
    let mut unit = volume.as_ref().and_then(Volume::unit).map(str::to_owned);
    let mut found = match &volume {
        Some(volume) => {
            progress.stage("Telling the grains apart");
            split_labels(volume, args.input.label).with_context(failed)?
        }
        None => {
            let scan = inputs::parse_scan(&args.scan, &bytes, &args.input, args.unit)?;
            unit = asked_or_told(args.unit, scan.unit());
            progress.stage("Telling the grains apart");
            let found = match args.uncut {
                true => split_uncut(&scan),
                false => split(&scan),
            };
            inputs::explained(found.with_context(failed), &scan)?
        }
    };
    if found.grains.is_empty() {
        bail!("cannot split {name}: {}", no_grain(&found));
    }
    progress.stage("Writing");
    outputs::make_folder(&args.output)?;
    let [of_surface, of_voxels] = EXTENSIONS;
    let extension = volume.as_ref().map_or(of_surface, |_| of_voxels);
    let files: Vec<String> = (1..=found.grains.len())
        .map(|number| file_name(number, extension))
        .collect();
    for (grain, file) in found.grains.iter_mut().zip(&files) {
        grain.scan.unit.clone_from(&unit);
        let path = args.output.join(file);
        match (&volume, &grain.voxels) {
            (Some(volume), Some(body)) => write_voxels(&volume.alone(body), &path)?,
            _ => write(grain, &path)?,
        }
    }
    drop(progress);
    let unit = inputs::unit_of(unit.as_deref(), args.unit);
    let mut report = SplitReport::new(name, &found, files).in_unit(unit);
    let of_volume = volume.iter().flat_map(|volume| volume.warnings());
    report.warnings.splice(0..0, of_volume.cloned());
    report
        .warnings
        .extend(earlier(&args.output, found.grains.len(), extension));
    let written = args.output.display().to_string();
    console.tell(&report, args.json, [written], &report.warnings)
}

/// Why there is none.
fn no_grain(found: &Split) -> String {
    let reasons: Vec<String> = found.left_out.iter().map(ToString::to_string).collect();
    match reasons.is_empty() {
        true => "nothing in it is large enough for a grain".into(),
        false => format!("it holds no whole grain: {}", reasons.join("; ")),
    }
}

/// What to say where the folder has grains of an earlier split beside so many of this one.
fn earlier(folder: &Path, grains: usize, extension: &str) -> Option<String> {
    let first = |other: &str| if other == extension { grains + 1 } else { 1 };
    let paths = EXTENSIONS.map(|other| folder.join(file_name(first(other), other)));
    let left = paths.iter().find(|path| path.exists())?;
    Some(format!(
        "{} is of an earlier split, as may be those after it: remove them, or write into another folder.",
        left.display()
    ))
}

/// Refuses a folder in which a grain would replace the scan.
fn spares_the_scan(scan: &Path, folder: &Path) -> Result<()> {
    let (Ok(file), Ok(folder)) = (scan.canonicalize(), folder.canonicalize()) else {
        return Ok(());
    };
    let name = file.file_name().map(|name| name.to_string_lossy());
    let is_grain = |extension: &&str| {
        let number = name.as_deref().and_then(|name| {
            let (number, own) = name.strip_prefix("grain_")?.split_once('.')?;
            number.parse().ok().filter(|_| own == *extension)
        });
        name == number.map(|number| file_name(number, extension).into())
    };
    if file.parent() == Some(&folder) && EXTENSIONS.iter().any(is_grain) {
        bail!(
            "cannot write the grains into {}: the input {} is named as one of them, which would replace it; give \
             another folder with -o",
            folder.display(),
            scan.display()
        );
    }
    Ok(())
}

fn file_name(number: usize, extension: &str) -> String {
    format!("grain_{number:04}.{extension}")
}

fn write_voxels(voxels: &Volume, path: &Path) -> Result<()> {
    outputs::write(path, |file| Ok(voxels.write_nrrd(file)?))
}

fn write(grain: &SplitGrain, path: &Path) -> Result<()> {
    match grain.scan.topology() {
        Some(_) => {
            let mesh = Mesh {
                vertices: grain.scan.points().to_vec(),
                triangles: grain.scan.triangles().to_vec(),
            };
            Ok(save_mesh(path, &mesh)?)
        }
        None => outputs::write(path, |mut file| write_split_grain(grain, &mut file)),
    }
}
