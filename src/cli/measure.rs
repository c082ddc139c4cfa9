//! `grainform measure`

use super::args::{DEFAULT_RESOLUTION, MeasureArgs};
use super::mesh::{grain, read};
use super::{print, print_json, warn};
use crate::Mesh;
use crate::fit::{FitOptions, fit};
use crate::measure::{grain_properties, mesh_properties};
use crate::report::{MeasureReport, Measured};
use crate::scan::{Scan, parse_scan};
use crate::sphere::triangulate_directions;
use anyhow::{Context, Result};
use nalgebra::Vector3;

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
    let (mesh, of, warnings) = surface(scan).with_context(|| format!("cannot measure {input}"))?;
    let properties = mesh_properties(&mesh).with_context(|| format!("cannot measure {input}"))?;
    Ok(MeasureReport::new(input, of, &properties, &mesh, warnings))
}

/// The reference surface of a scan: its faces, or else its points triangulated by their directions
/// from the centre that the fit finds.
fn surface(scan: Scan) -> Result<(Mesh, Measured, Vec<String>)> {
    let sphere = FitOptions {
        degree: Some(0),
        segments: Some(1),
        ..FitOptions::default()
    };
    let is_closed = scan
        .topology
        .as_ref()
        .is_some_and(|t| t.closed && t.bodies == 1);
    if is_closed {
        let mesh = Mesh {
            vertices: scan.points,
            triangles: scan.triangles,
        };
        return Ok((mesh, Measured::Faces, scan.warnings));
    }
    let fitted = fit(&scan, &sphere)?;
    let centre = fitted.grain.frame().centre;
    let directions: Vec<Vector3<f64>> = scan
        .points
        .iter()
        .map(|point| (point - centre).normalize())
        .collect();
    let mesh = Mesh {
        triangles: triangulate_directions(&directions)?,
        vertices: scan.points,
    };
    let mut warnings = [scan.warnings, fitted.warnings].concat();
    let of_the_sphere = fitted.search.warning();
    warnings.retain(|warning| Some(warning) != of_the_sphere.as_ref());
    if fitted.points < mesh.vertices.len() {
        warnings.push("Points that a fit leaves out are part of this measurement.".into());
    }
    Ok((mesh, Measured::Directions, warnings))
}
