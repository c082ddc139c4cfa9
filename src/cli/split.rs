//! `grainform split`

use super::args::SplitArgs;
use super::console::Console;
use super::{inputs, outputs, threads};
use crate::export::{save_mesh, write_points_ply};
use crate::mesh::Mesh;
use crate::report::SplitReport;
use crate::scan::{Scan, split, split_labels};
use anyhow::{Context, Result, bail};
use std::path::Path;

pub(super) fn run(args: SplitArgs, console: Console) -> Result<()> {
    spares_the_scan(&args.scan, &args.output)?;
    threads::start(args.threads, console)?;
    let name = inputs::name(&args.scan);
    let progress = console.progress();
    progress.stage("Reading");
    let bytes = inputs::read(&args.scan, &args.input.limit)?;
    let failed = || format!("cannot split {name}");
    let found = match inputs::parse_labels(&args.scan, &bytes, &args.input, args.unit)? {
        Some(volume) if args.input.label.is_none() => {
            progress.stage("Telling the grains apart");
            split_labels(&volume).with_context(failed)?
        }
        _ => {
            let scan = inputs::parse_scan(&args.scan, &bytes, &args.input, args.unit)?;
            progress.stage("Telling the grains apart");
            inputs::explained(split(&scan).with_context(failed), &scan)?
        }
    };
    progress.stage("Writing");
    outputs::make_folder(&args.output)?;
    let files: Vec<String> = (1..=found.grains.len()).map(file_name).collect();
    for (grain, file) in found.grains.iter().zip(&files) {
        write(&grain.scan, &args.output.join(file))?;
    }
    drop(progress);
    let next = args.output.join(file_name(files.len() + 1));
    let mut report = SplitReport::new(name, &found, files).in_unit(args.unit);
    if next.exists() {
        report.warnings.push(format!(
            "{} is of an earlier split, as may be those after it: remove them, or write into another folder.",
            next.display()
        ));
    }
    let written = args.output.display().to_string();
    console.tell(&report, args.json, [written], &report.warnings)
}

/// Refuses a folder in which a grain would replace the scan.
fn spares_the_scan(scan: &Path, folder: &Path) -> Result<()> {
    let (Ok(file), Ok(folder)) = (scan.canonicalize(), folder.canonicalize()) else {
        return Ok(());
    };
    let name = file.file_name().map(|name| name.to_string_lossy());
    let number = name.as_deref().and_then(|name| {
        let number = name.strip_prefix("grain_")?.strip_suffix(".ply")?;
        number.parse().ok()
    });
    if file.parent() == Some(&folder) && name == number.map(|number| file_name(number).into()) {
        bail!(
            "cannot write the grains into {}: the input {} is named as one of them, which would replace it; give \
             another folder with -o",
            folder.display(),
            scan.display()
        );
    }
    Ok(())
}

fn file_name(number: usize) -> String {
    format!("grain_{number:04}.ply")
}

fn write(grain: &Scan, path: &Path) -> Result<()> {
    match grain.topology() {
        Some(_) => {
            let mesh = Mesh {
                vertices: grain.points().to_vec(),
                triangles: grain.triangles().to_vec(),
            };
            Ok(save_mesh(path, &mesh)?)
        }
        None => outputs::write(path, |mut file| write_points_ply(grain.points(), &mut file)),
    }
}
