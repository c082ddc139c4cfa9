//! How near fits come to the truth: prints tables of docs/accuracy.md.
//!
//! `cargo run --release --example accuracy`; with the argument `curvature` that of curvatures.

mod curvature;

use grainform::measure::{Deviation, grain_properties};
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, Fitted, fit};
use nalgebra::Point3;

/// Directions in which the fitted radius is compared with the true one.
const PLACES: usize = 20_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    if std::env::args().any(|argument| argument == "curvature") {
        return curvature::print();
    }
    println!(
        "| body | points | sampling | noise | segments | coefficients | area | volume | RMS |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        for sampling in Sampling::ALL {
            for noise in [0.0, 0.005] {
                let options = SynthOptions::clean(body)
                    .with_sampling(sampling)
                    .with_noise(noise);
                println!("{}", row(body, &options)?);
            }
        }
    }
    Ok(())
}

/// One scan, fitted with the default options, against the closed form.
fn row(body: Body, options: &SynthOptions) -> Result<String, Box<dyn std::error::Error>> {
    let synthetic = synthesize(options)?;
    let scan = Scan::from_points(synthetic.points);
    let fitted = fit(&scan, &FitOptions::default())?;
    let (found, truth) = (
        grain_properties(&fitted.grain).properties,
        synthetic.truth.properties,
    );
    Ok(format!(
        "| {} | {} | {} | {} % | {} | {} | {:+.3} % | {:+.3} % | {:.3} % |",
        body,
        scan.points().len(),
        options.sampling,
        100.0 * options.noise,
        fitted.grain.star().unwrap().segments(),
        fitted.grain.coefficient_count(),
        100.0 * (found.area / truth.area - 1.0),
        100.0 * (found.volume / truth.volume - 1.0),
        100.0 * distance(&fitted, body)? / synthetic.truth.mean_radius,
    ))
}

/// Root mean square of the radial distance between the fit and the closed form.
fn distance(fitted: &Fitted, body: Body) -> Result<f64, Box<dyn std::error::Error>> {
    let surface = body.surface();
    let directions = Sampling::Fibonacci.directions(PLACES, 0)?;
    let places: Vec<_> = directions
        .iter()
        .map(|n| Point3::from(n * surface.radius(n)))
        .collect();
    Ok(Deviation::from_places(&fitted.grain, &places).rms())
}
