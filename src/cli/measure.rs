//! `grainform measure`

use super::args::MeasureArgs;
use super::mesh::{grain, read};
use super::{print, print_json, warn};
use crate::fit::scanned_surface;
use crate::measure::{Scheme, Survey, scanned_body};
use crate::report::{Measure, MeasureReport, Measured, sentences};
use crate::scan::parse_scan;
use anyhow::{Context, Result, bail};

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
    let only = match args.only.as_slice() {
        [] => Measure::ALL.as_slice(),
        asked => asked,
    };
    let bytes = read(path)?;
    if bytes.trim_ascii_start().starts_with(b"{") {
        let grain = grain(path, &bytes)?;
        let survey = Survey::of_grain(&grain, args.scheme.0);
        let of = Measured::Model;
        return Ok(MeasureReport::new(input, of, &survey, only, Vec::new()));
    }
    if args.scheme.0 != Scheme::Exact {
        bail!("{input} is a scan: integration schemes are for models; leave --scheme out");
    }
    let extension = path.extension().and_then(|extension| extension.to_str());
    let scan = parse_scan(&bytes, extension)
        .with_context(|| format!("cannot read a scan from {input}"))?;
    if scan.is_flat() {
        bail!("cannot measure {input}: all points lie in one plane, they do not enclose a body");
    }
    if let Some(scanned) = scanned_body(&scan) {
        let survey = Survey::of_scanned(&scanned);
        let (of, warnings) = (Measured::Faces, scan.warnings.clone());
        let report = MeasureReport::new(input, of, &survey, only, warnings);
        return Ok(report.with_faces(&scanned));
    }
    let surface = scanned_surface(&scan).with_context(|| format!("cannot measure {input}"))?;
    let survey =
        Survey::of_mesh(&surface.mesh).with_context(|| format!("cannot measure {input}"))?;
    let warnings = sentences(&scan.warnings, &surface.warnings);
    let of = surface.kind.into();
    Ok(MeasureReport::new(input, of, &survey, only, warnings))
}
