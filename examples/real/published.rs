//! Default fits against what was published of the same grains.

use crate::stats::mean_and_deviation;
use grainform::report::{FitReport, ReportedScan};
use grainform::scan::read_scan;
use grainform::{FitOptions, fit};
use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::path::Path;

/// A row of a table, by the names of its columns.
type Row = BTreeMap<String, String>;

/// Measures that were published of every grain.
const MEASURES: [&str; 5] = ["volume", "area", "length", "width", "thickness"];

/// Kernels of barley: the volume and area of meshes of 14 000 points, of which the scans have 1538, and sizes.
pub(crate) fn print_kernels(scans: &Path) -> Result<(), Box<dyn Error>> {
    let folder = scans.join("barley_batch");
    let rows = table(&folder.join("truth.csv"))?;
    let mut errors: [Vec<f64>; MEASURES.len()] = Default::default();
    for row in &rows {
        let found = measured(&folder.join(&row["file"]))?;
        let published = ["mesh_volume", "mesh_area", "length", "width", "thickness"];
        for ((errors, found), name) in errors.iter_mut().zip(found).zip(published) {
            errors.push(100.0 * (found.value / number(row, name)? - 1.0));
        }
    }
    println!("\n| {} kernels | bias | spread | largest |", rows.len());
    println!("|---|---|---|---|");
    for (name, errors) in MEASURES.iter().zip(&errors) {
        let (mean, deviation) = mean_and_deviation(errors);
        let largest = errors.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        println!("| {name} | {mean:+.3} % | {deviation:.3} % | {largest:.3} % |");
    }
    Ok(())
}

/// Particles of cement and rock: volume and area as NIST published them. Its sizes are not these: the longest chord, and
/// chords normal to it.
pub(crate) fn print_particles(scans: &Path) -> Result<(), Box<dyn Error>> {
    let folder = scans.join("nist");
    println!("\n| particle | measure | published | found | standard error | off |");
    println!("|---|---|---|---|---|---|");
    for row in table(&folder.join("truth.csv"))? {
        let name = &row["particle"];
        let file = format!("{name}_n{}_ico5.ply", row["nmax_used"]);
        let found = measured(&folder.join(file))?;
        for (measure, found) in MEASURES.iter().zip(found).take(2) {
            let published = number(&row, &format!("nist_{measure}"))?;
            let error = found
                .error
                .map_or("-".into(), |error| format!("{error:.4}"));
            println!(
                "| {name} | {measure} | {published} | {:.4} | {error} | {:+.4} % |",
                found.value,
                100.0 * (found.value / published - 1.0)
            );
        }
    }
    Ok(())
}

/// A figure of a fit and its standard error.
struct Found {
    value: f64,
    error: Option<f64>,
}

/// [`MEASURES`] of the default fit of a scan.
fn measured(path: &Path) -> Result<[Found; MEASURES.len()], Box<dyn Error>> {
    let (scan, options) = (read_scan(path)?, FitOptions::default());
    let fitted = fit(&scan, &options)?;
    let report = FitReport::new(ReportedScan::default(), &fitted, &options);
    let whole = || format!("{}: not seen whole", path.display());
    let size = report.dimensions.ok_or_else(whole)?;
    let errors = report.standard_errors.as_ref();
    let sizes = errors.map(|errors| &errors.dimensions);
    let found = |value, error| Found { value, error };
    Ok([
        found(report.volume.ok_or_else(whole)?, errors.map(|e| e.volume)),
        found(report.area.ok_or_else(whole)?, errors.map(|e| e.area)),
        found(size.length, sizes.map(|e| e.length)),
        found(size.width, sizes.map(|e| e.width)),
        found(size.thickness, sizes.map(|e| e.thickness)),
    ])
}

fn table(path: &Path) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_reader(File::open(path)?);
    Ok(reader.deserialize().collect::<Result<_, _>>()?)
}

fn number(row: &Row, name: &str) -> Result<f64, Box<dyn Error>> {
    let cell = row.get(name).ok_or_else(|| format!("no column {name}"))?;
    Ok(cell.parse()?)
}
