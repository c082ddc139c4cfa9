//! A closed body from a scan or a model, for what is made of bodies of either kind.

use super::args::InputArgs;
use super::inputs;
use crate::fit::{FitOptions, fit};
use crate::measure::{MassProperties, ScannedBody, Scheme, Survey, mesh_properties, scanned_body};
use crate::mesh::Mesh;
use crate::model::{Grain, Surface};
use crate::report::{Unit, Withheld, sentences};
use crate::scan::Scan;
use anyhow::{Context, Result, bail, ensure};
use std::path::Path;

/// Cells per cube edge of the mesh of a model.
const RESOLUTION: usize = 64;

/// A body, whatever it comes from.
pub(super) struct Solid {
    /// Closed, wound counter-clockwise from outside.
    pub(super) mesh: Mesh,
    /// Those of a model are its own, not its mesh's.
    pub(super) properties: MassProperties,
    /// Standard error of the volume, where a model tells it.
    pub(super) volume_error: Option<f64>,
    /// The unit of its lengths that the file tells.
    pub(super) unit: Option<String>,
    /// The model, if it is one; of points without faces, what is fitted to them.
    pub(super) grain: Option<Grain>,
    /// What is odd about a scan, or not to be relied on of a model: whole sentences.
    pub(super) warnings: Vec<String>,
}

/// Reads a model or a scan; the content decides.
pub(super) fn read(path: &Path, input: &InputArgs, unit: Option<Unit>) -> Result<Solid> {
    let name = inputs::name(path);
    let bytes = inputs::read(path, &input.limit)?;
    if inputs::is_model(path, &bytes, input)? {
        return of_grain(inputs::parse_model(path, &bytes, unit)?, &name);
    }
    let scan = inputs::parse_scan(path, &bytes, input, unit)?;
    let found = match scanned_body(&scan) {
        Some(faces) => of_faces(faces, &scan, &name),
        None => of_points(&scan, &name, unit),
    };
    inputs::explained(found, &scan)
}

fn unusable(name: &str) -> String {
    format!("{name} encloses no grain")
}

fn of_grain(grain: Grain, name: &str) -> Result<Solid> {
    let properties = Survey::of_grain(&grain, Scheme::Exact)
        .properties()
        .with_context(|| unusable(name))?;
    Ok(Solid {
        properties,
        volume_error: grain.standard_errors().ok().map(|errors| errors.volume),
        mesh: grain.mesh(RESOLUTION),
        warnings: doubts(&grain, name),
        unit: grain.unit().map(str::to_owned),
        grain: Some(grain),
    })
}

/// What is not to be relied on of a model, nor of what is made of all of it: whole sentences.
pub(super) fn doubts(grain: &Grain, name: &str) -> Vec<String> {
    let mut doubts = Withheld::of(grain, false).sentences(name);
    doubts.extend(guess(grain, name));
    doubts.extend(inputs::foreign_unit(grain, name));
    doubts
}

/// That figures are guesses which are withheld elsewhere: what is made of all of a grain needs them.
fn guess(grain: &Grain, name: &str) -> Option<String> {
    grain.unseen().map(|_| {
        format!(
            "A part of the surface of {name} is a guess, and so are volume, mass, centre and inertia: scan what is missing where \
             these count."
        )
    })
}

fn of_faces(scanned: ScannedBody, scan: &Scan, name: &str) -> Result<Solid> {
    if scanned.bodies > 1 {
        bail!("{name} holds {} bodies; split it first", scanned.bodies);
    }
    let properties = Survey::of_scanned(&scanned)
        .properties()
        .with_context(|| unusable(name))?;
    let crossing = scanned.crossing.map(|found| format!("Of {name}, {found}."));
    Ok(Solid {
        mesh: scanned.mesh,
        properties,
        volume_error: None,
        unit: scan.unit().map(str::to_owned),
        grain: None,
        warnings: scan.warnings.iter().cloned().chain(crossing).collect(),
    })
}

/// The grain that is fitted to points: the polyhedron through them is too small.
fn of_points(scan: &Scan, name: &str, unit: Option<Unit>) -> Result<Solid> {
    let fitted = fit(scan, &FitOptions::default()).with_context(|| format!("cannot fit {name}"))?;
    let grain = fitted.grain_with_errors();
    let mut warnings = sentences(&scan.warnings, &fitted.warnings, unit);
    warnings.extend(guess(&grain, name));
    Ok(Solid {
        warnings,
        unit: scan.unit().map(str::to_owned),
        ..of_grain(grain, name)?
    })
}

/// Share of its area that the mesh of a union may lack before it is told.
const LACKING: f64 = 5e-3;

/// Tells of a mesh that lacks area of its grain: that of a union, where clefts between parts are narrower than its triangles.
pub(super) fn lacking(grain: &Grain, mesh: &Mesh) -> Option<String> {
    (grain.hidden_share() > 0.0).then_some(())?;
    let area = Survey::of_grain(grain, Scheme::Exact).area().ok()?;
    let share = 1.0 - mesh_properties(mesh).ok()?.area / area;
    (share > LACKING).then(|| {
        format!(
            "The mesh has {:.1} % less area than the model: it closes clefts between parts that are narrower than its \
             triangles. Mesh it with a larger --resolution, and take figures from the model (grainform measure).",
            100.0 * share
        )
    })
}

/// Refuses a grain for what takes its surface as one over the directions from its centre.
pub(super) fn is_seen_whole(grain: &Grain, name: &str, what: &str) -> Result<()> {
    let share = grain.hidden_share();
    ensure!(
        share == 0.0,
        "{name} is a union of superquadrics that hides a part of its surface from its centre, in {:.1} % of the \
         directions: {what}",
        100.0 * share
    );
    Ok(())
}
