//! `grainform split`

use super::args::SplitArgs;
use super::console::{Console, put_json};
use super::{inputs, outputs, threads};
use crate::export::{save_mesh, write_points_ply};
use crate::mesh::Mesh;
use crate::report::SplitReport;
use crate::scan::{Scan, split};
use anyhow::{Context, Result};

pub(super) fn run(args: SplitArgs, console: Console) -> Result<()> {
    threads::start(args.threads, console)?;
    let name = inputs::name(&args.scan);
    let progress = console.progress();
    progress.stage("Reading");
    let scan = inputs::scan(&args.scan, &args.input)?;
    progress.stage("Telling the grains apart");
    let found = split(&scan).with_context(|| format!("cannot split {name}"))?;
    progress.stage("Writing");
    outputs::make_folder(&args.output)?;
    let files: Vec<String> = (1..=found.grains.len())
        .map(|number| format!("grain_{number:04}.ply"))
        .collect();
    for (grain, file) in found.grains.iter().zip(&files) {
        write(&grain.scan, &args.output.join(file))?;
    }
    drop(progress);
    let report = SplitReport::new(name, &found, files).in_unit(args.unit);
    if args.json {
        return put_json(&report);
    }
    console.print(&report)?;
    console.wrote(&args.output.display().to_string())?;
    console.warn(&report.warnings);
    Ok(())
}

fn write(grain: &Scan, path: &std::path::Path) -> Result<()> {
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
