//! Table 3.6 of Radvilaite 2016: the oblate ellipsoid a = b = 2, c = 1, pressed against a plane by 1 % of
//! its radius R = 2, at its rim (alpha = pi/2) and at its pole (alpha = 0).
//!
//! Printed rows 1 to 4 come from radii of curvature by (2.48)–(2.52): ours beside them, once by the
//! published correction and once by the elliptic integrals that it approximates. Then what the closed
//! form and fitted models of the ellipsoid have of themselves. The printed rows are read from
//! `../shared/reference`; without that folder only ours are shown.
//!
//! To run: `cargo run --release --example contact_table`

use grainform::contact::{Correction, RelativeCurvature, touch};
use grainform::fit::{DirectedSample, fit_mirrored};
use grainform::model::Radial;
use grainform::scan::Scan;
use grainform::shapes::{Body, Ellipsoid, Sampling, SynthOptions, synthesize};
use grainform::sphere::Symmetry;
use grainform::{FitOptions, Surface, Tolerance, fit};
use nalgebra::Vector3;
use std::path::Path;

/// R of the dimensionless force (3.5): the ellipsoid's b.
const RADIUS: f64 = 2.0;

/// Relative indentation u / R.
const INDENTATION: f64 = 0.01;

/// Radius of the cap that rounds the model's rim, over R, as in row 2.
const CAP: f64 = 0.05;

/// The analytic rows: name and radii of curvature over R.
const ANALYTIC: [(&str, [f64; 2]); 4] = [
    ("rim, ellipsoid", [0.25, 1.0]),
    ("rim, model with a cap", [0.05, 1.0]),
    ("pole, ellipsoid", [2.0, 2.0]),
    ("pole, model", [2.005, 2.005]),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let printed = printed();
    if printed.is_empty() {
        println!("(../shared/reference is absent: no printed rows)\n");
    }
    println!("| row | case | rho_n, rho_t | c printed | c ours | F printed | F ours | F exact |");
    println!("|---|---|---|---|---|---|---|---|");
    for (i, (name, radii)) in ANALYTIC.into_iter().enumerate() {
        let relative = RelativeCurvature::new(radii.map(f64::recip), [0.0; 2], 0.0)?;
        let force = |by| 1e3 * relative.force_factor(by, INDENTATION, 1.0);
        let [_, correction, force_printed] = printed.get(i).cloned().unwrap_or_default();
        println!(
            "| {} | {name} | {}, {} | {correction} | {:.4} | {force_printed} | {:.4}e-3 | {:.4}e-3 |",
            i + 1,
            radii[0],
            radii[1],
            relative.correction(Correction::Published),
            force(Correction::Published),
            force(Correction::Elliptic),
        );
    }
    println!(
        "\nRows 5 to 7, finite elements, printed (5 and 7: see the example contact_fem; 6 is open):"
    );
    for row in printed.iter().skip(ANALYTIC.len()) {
        println!("  {}: F = {}", row[0], row[2]);
    }

    println!("\nThe same contacts of surfaces, radii over R, F by elliptic integrals:\n");
    println!("| surface | rim: rho_n, rho_t | F | pole: rho_n, rho_t | F |");
    println!("|---|---|---|---|---|");
    let ellipsoid = Ellipsoid {
        semi_axes: Vector3::new(2.0, 2.0, 1.0),
    };
    row("closed form", &Radial(&ellipsoid))?;
    let scan = synthesize(&SynthOptions::clean(Body::Ellipsoid).with_points(6146))?;
    let scan = Scan::from_points(scan.points);
    for tolerance in [1e-3, 1e-4] {
        let options = FitOptions::default().with_tolerance(Tolerance::OfMeanRadius(tolerance));
        let name = format!("blended cells, to {} %", 100.0 * tolerance);
        row(&name, &fit(&scan, &options)?.grain)?;
    }
    for degree in [1, 3] {
        let directions = Sampling::Cube.directions(6146, 0)?;
        let samples: Vec<DirectedSample> = directions
            .into_iter()
            .map(|direction| DirectedSample::on(&ellipsoid, direction, 1.0))
            .collect();
        let model = fit_mirrored(&samples, Symmetry::OCTANT, degree)?;
        row(&format!("octant, L = {degree}"), &model)?;
    }
    println!("\nWhere a model has an edge, a cap of {CAP} R rounds it (section 3.4).");
    Ok(())
}

/// Prints a surface's contacts at its rim and at its pole.
fn row(name: &str, surface: &impl Surface) -> Result<(), Box<dyn std::error::Error>> {
    let told = |towards: Vector3<f64>| {
        let touch = match touch(surface, &towards, Some(CAP * RADIUS)) {
            Ok(touch) => touch,
            Err(error) => return (error.to_string(), String::from("-")),
        };
        let radii = touch.principal.map(|k| 1.0 / (k * RADIUS));
        let force = RelativeCurvature::new(touch.principal, [0.0; 2], 0.0).map(|relative| {
            relative.force_factor(Correction::Elliptic, INDENTATION * RADIUS, RADIUS)
        });
        (
            format!("{:.4}, {:.4}", radii[0], radii[1]),
            force.map_or_else(|_| "-".into(), |force| format!("{:.4}e-3", 1e3 * force)),
        )
    };
    // Between the mirror planes, in which an expansion of an octant has edges of its own.
    let (rim, rim_force) = told(Vector3::new(1.0, 1.0, 0.0).normalize());
    let (pole, pole_force) = told(Vector3::z());
    println!("| {name} | {rim} | {rim_force} | {pole} | {pole_force} |");
    Ok(())
}

/// Case, correction and force of the printed rows; none where the table is not at hand.
fn printed() -> Vec<[String; 3]> {
    let path = "../shared/reference/table_3_6_contact.csv";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        [1, 5, 7].map(|i| cells.get(i).copied().unwrap_or_default().to_string())
    })
    .collect()
}
