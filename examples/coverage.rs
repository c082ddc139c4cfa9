//! How often the truth lies within the stated 95 % intervals (figure ± 1.96 standard errors): prints
//! the table of the README.
//!
//! `cargo run --release --example coverage`

use grainform::measure::{MassProperties, extents, grain_properties};
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::{FitOptions, Mesh, fit};

/// Scans per grain, which differ by the seed of their noise.
const SCANS: u64 = 200;

/// Noise, as a share of the mean radius.
const NOISE: f64 = 0.005;

/// Normal quantile of a two-sided interval of 95 %.
const QUANTILE: f64 = 1.96;

const FIGURES: [&str; 8] = [
    "area",
    "volume",
    "I1",
    "I2",
    "I3",
    "length",
    "width",
    "thickness",
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("| body | {} |", FIGURES.join(" | "));
    println!("|---|{}", "---|".repeat(FIGURES.len()));
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        println!("| {body} | {} |", row(body)?.join(" | "));
    }
    Ok(())
}

/// Share of the scans whose interval holds the truth, and the mean error over the standard error.
fn row(body: Body) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let truth = truth(body)?;
    let mut covered = [0; FIGURES.len()];
    let mut bias = [0.0; FIGURES.len()];
    for seed in 0..SCANS {
        let synthetic = synthesize(&SynthOptions {
            noise: NOISE,
            seed,
            ..SynthOptions::clean(body)
        })?;
        let scan = Scan {
            points: synthetic.points,
            ..Scan::default()
        };
        let fitted = fit(&scan, &FitOptions::default())?;
        let errors = fitted.standard_errors().ok_or("a blended fit")?;
        let mut found = figures(
            &grain_properties(&fitted.grain).properties,
            &fitted.grain.mesh(64),
        )?;
        for (dimension, excess) in found[5..].iter_mut().zip(&errors.dimensions_excess) {
            *dimension -= excess;
        }
        let errors = [errors.area, errors.volume]
            .into_iter()
            .chain(errors.moments.iter().copied())
            .chain(errors.dimensions.iter().copied());
        for (i, error) in errors.enumerate() {
            let deviation = (found[i] - truth[i]) / error;
            covered[i] += u64::from(deviation.abs() <= QUANTILE);
            bias[i] += deviation / SCANS as f64;
        }
    }
    let cell = |(covered, bias): (u64, f64)| {
        format!(
            "{:.1} % ({bias:+.1})",
            100.0 * covered as f64 / SCANS as f64
        )
    };
    Ok(covered.into_iter().zip(bias).map(cell).collect())
}

/// The figures of the closed form; its dimensions from a mesh as fine as that of the fits.
fn truth(body: Body) -> Result<Vec<f64>, Box<dyn std::error::Error>> {
    let synthetic = synthesize(&SynthOptions::clean(body))?;
    let surface = body.surface();
    let mesh = Mesh::radial(256, |n| surface.radius(n));
    figures(&synthetic.truth.properties, &mesh)
}

fn figures(solid: &MassProperties, mesh: &Mesh) -> Result<Vec<f64>, Box<dyn std::error::Error>> {
    let principal = solid.principal().ok_or("a finite inertia")?;
    let mut figures = vec![solid.area, solid.volume];
    figures.extend(principal.moments.iter());
    figures.extend(extents(mesh, &principal.axes).iter());
    Ok(figures)
}
