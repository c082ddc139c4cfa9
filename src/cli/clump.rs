//! `grainform clump`

use super::args::{ClumpArgs, SpheresArgs};
use super::console::Console;
use super::{inputs, outputs, solid, threads};
use crate::clump::{ClumpTarget, clump};
use crate::report::ClumpReport;
use anyhow::{Context, Result};
use std::path::Path;

/// Extensions of clumps.
const CLUMP: &[&str] = &["json", "csv"];

/// Spheres of a clump where no number is given.
const SPHERES: usize = 10;

pub(super) fn run(args: ClumpArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    let output = (args.output.as_deref(), CLUMP);
    let read = Some(args.path.as_path());
    let console = console.beside(outputs::check(read, &[output], args.json)?);
    let progress = console.progress();
    progress.stage("Reading");
    let solid = solid::read(&args.path, &args.input, args.unit)?;
    let unit = inputs::unit_of(solid.unit.as_deref(), args.unit);
    progress.stage("Finding spheres");
    let name = inputs::name(&args.path);
    let found = clump(&solid.mesh, &solid.properties, args.spheres.target())
        .with_context(|| format!("cannot make a clump of {name}"))?;
    let report =
        ClumpReport::new(name, &found, unit, solid.warnings).with_volume_error(solid.volume_error);
    if let Some(path) = &args.output {
        write(path, &report)?;
    }
    drop(progress);
    let written = args.output.as_deref().map(outputs::name);
    console.tell(&report, args.json, written, &report.warnings)
}

/// By the extension; standard output as JSON.
fn write(path: &Path, report: &ClumpReport) -> Result<()> {
    if path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("csv"))
    {
        return outputs::write(path, |file| Ok(report.write_csv(file)?));
    }
    let text = serde_json::to_string_pretty(report)?;
    outputs::write(path, |file| Ok(writeln!(file, "{text}")?))
}

impl SpheresArgs {
    pub(super) fn target(&self) -> ClumpTarget {
        match self.error {
            Some(share) => ClumpTarget::Error(share),
            None => ClumpTarget::Spheres(self.spheres.unwrap_or(SPHERES)),
        }
    }
}
