//! `grainform measure`

use super::args::{DEFAULT_RESOLUTION, MeasureArgs};
use super::mesh::{grain, read};
use super::{print, print_json, warn};
use crate::fit::scanned_surface;
use crate::measure::{grain_properties, mesh_properties};
use crate::report::{MeasureReport, Measured};
use crate::scan::parse_scan;
use anyhow::{Context, Result};

pub(super) fn run(args: MeasureArgs) -> Result<()> {
    let report = measure(&args)?;
    if args.json {
        return print_json(&report);
    }
    print(&report)?;
    warn(&report.warnings);
    Ok(())
}

fn measure(args: &MeasureArgs) -> Result<MeasureReport> {
    let path = &args.input;
    let input = path.display().to_string();
    let bytes = read(path)?;
    if bytes.trim_ascii_start().starts_with(b"{") {
        let grain = grain(path, &bytes)?;
        let properties = grain_properties(&grain).properties;
        let mesh = grain.mesh(DEFAULT_RESOLUTION.into());
        let of = Measured::Model;
        return Ok(MeasureReport::new(
            input,
            of,
            &properties,
            &mesh,
            Vec::new(),
        ));
    }
    let extension = path.extension().and_then(|extension| extension.to_str());
    let scan = parse_scan(&bytes, extension)
        .with_context(|| format!("cannot read a scan from {input}"))?;
    let surface = scanned_surface(&scan).with_context(|| format!("cannot measure {input}"))?;
    let properties =
        mesh_properties(&surface.mesh).with_context(|| format!("cannot measure {input}"))?;
    let warnings = [scan.warnings.as_slice(), &surface.warnings].concat();
    let of = surface.kind.into();
    Ok(MeasureReport::new(
        input,
        of,
        &properties,
        &surface.mesh,
        warnings,
    ))
}
