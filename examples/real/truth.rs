//! Fits of particles against their exact truth.

use crate::particle::Particle;
use crate::stats::{median, quantile};
use grainform::measure::grain_properties;
use grainform::shapes::Sampling;
use grainform::{FitOptions, Fitted, Surface, Tolerance, fit};
use nalgebra::Vector3;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

/// Directions in which the radius is compared.
const JUDGED: usize = 4000;

/// Points, and noise as a share of the mean radius.
const CLOUDS: [(usize, f64); 6] = [
    (6146, 0.0),
    (6146, 0.005),
    (6146, 0.02),
    (1538, 0.0),
    (1538, 0.005),
    (100_000, 0.0),
];

pub(crate) fn print(scans: &Path, every: usize) -> Result<(), Box<dyn Error>> {
    let particles = Particle::all(&scans.join("nist_train"))?;
    let options = [
        ("default", FitOptions::default()),
        (
            "0.01 %",
            FitOptions::default().with_tolerance(Tolerance::OfMeanRadius(1e-4)),
        ),
        ("--segments 1", FitOptions::default().with_segments(1)),
    ];
    println!(
        "| points | noise | model | RMS: median, 90 % | coefficients | touched | area: median | volume: median | \
         told noise | s |\n|---|---|---|---|---|---|---|---|---|---|"
    );
    for (points, noise) in CLOUDS {
        for (name, options) in &options {
            let mut rows = Vec::new();
            for (seed, particle) in particles.iter().enumerate().step_by(every) {
                let directions = Sampling::Fibonacci.directions(points, 0)?;
                let scan = particle.scan(&directions, noise, seed as u64);
                let started = Instant::now();
                let fitted = fit(&scan, options)?;
                let seconds = started.elapsed().as_secs_f64();
                rows.push(row(particle, &fitted, seconds)?);
            }
            let column = |i: usize| -> Vec<f64> { rows.iter().map(|row| row[i]).collect() };
            println!(
                "| {points} | {} % | {name} | {:.4}, {:.4} % | {:.0} | {:.0} | {:.4} % | {:.4} % | {:.4} % | {:.2} |",
                100.0 * noise,
                median(&column(0)),
                quantile(&column(0), 0.9),
                median(&column(1)),
                median(&column(2)),
                median(&column(3)),
                median(&column(4)),
                median(&column(5)),
                median(&column(6)),
            );
        }
    }
    Ok(())
}

/// RMS in %, coefficients, touched, area and volume errors in %, noise told in %, seconds.
fn row(particle: &Particle, fitted: &Fitted, seconds: f64) -> Result<[f64; 7], Box<dyn Error>> {
    let grain = &fitted.grain;
    let mut squared = 0.0;
    for n in Sampling::Fibonacci.directions(JUDGED, 0)? {
        let point: Vector3<f64> = grain.point(&n).coords;
        squared += (point.norm() - particle.radius(&point.normalize())).powi(2);
    }
    let solid = grain_properties(grain).properties;
    let noise = fitted.search.noise.unwrap_or(f64::NAN);
    Ok([
        100.0 * (squared / JUDGED as f64).sqrt() / particle.mean_radius,
        grain.coefficient_count() as f64,
        grain.coefficients_touched(),
        100.0 * (solid.area / particle.area - 1.0).abs(),
        100.0 * (solid.volume / particle.volume - 1.0).abs(),
        100.0 * noise / fitted.mean_radius,
        seconds,
    ])
}
