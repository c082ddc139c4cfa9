//! The scans that are compared.

use grainform::bench::Subject;
use grainform::scan::read_scan;
use grainform::shapes::Body;
use std::error::Error;
use std::path::Path;

/// Points of the edged bodies.
const POINTS: usize = 6146;

/// Scanned stones with the layout of the grains; left out where the folder is missing.
const STANDINS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/scans/standins");

/// The clean grains, the edged bodies and the scanned stones.
pub(crate) fn all() -> Result<Vec<Subject>, Box<dyn Error>> {
    let grains = [Body::Bean, Body::Chickpea, Body::Maize].map(|body| (body, body.native_points()));
    let edged = [Body::Cylinder, Body::Cube].map(|body| (body, POINTS));
    let mut subjects = Vec::new();
    for (body, points) in grains.into_iter().chain(edged) {
        subjects.push(Subject::synthetic(body, points, 0.0)?);
    }
    subjects.extend(standins()?);
    Ok(subjects)
}

fn standins() -> Result<Vec<Subject>, Box<dyn Error>> {
    let Ok(folder) = Path::new(STANDINS).read_dir() else {
        eprintln!("skipping the scanned stones: there is no folder {STANDINS}");
        return Ok(Vec::new());
    };
    let mut paths = folder
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()?;
    paths.sort();
    let subject = |path: &std::path::PathBuf| -> Result<Subject, Box<dyn Error>> {
        let name = path.file_stem().unwrap_or_default();
        Ok(Subject {
            hidden: Vec::new(),
            name: name.to_string_lossy().into(),
            scan: read_scan(path)?,
            truth: None,
        })
    };
    paths.iter().map(subject).collect()
}
