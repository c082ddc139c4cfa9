//! How often the truth lies within the stated 95 % intervals (figure ± 1.96 standard errors): prints
//! the table of the README.
//!
//! `cargo run --release --example coverage`

use grainform::measure::support;
use grainform::model::Radial;
use grainform::report::FitReport;
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::{FitOptions, fit};
use nalgebra::Vector3;
use std::error::Error;

/// Points, noise as a share of the mean radius, and scans per grain, which differ by the seed of their noise.
const CLOUDS: [(usize, f64, u64); 5] = [
    (1538, 0.0, 1),
    (1538, 0.005, 40),
    (6146, 0.0, 1),
    (6146, 0.005, 40),
    (1_000_000, 0.005, 5),
];

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

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "| body | points | noise | told of | {} |",
        FIGURES.join(" | ")
    );
    println!("|---|---|---|---|{}", "---|".repeat(FIGURES.len()));
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        for (points, noise, scans) in CLOUDS {
            let (told, row) = row(body, points, noise, scans)?;
            let row = row.join(" | ");
            println!(
                "| {body} | {points} | {} % | {told} of {scans} | {row} |",
                100.0 * noise
            );
        }
    }
    Ok(())
}

/// Of how many scans there are standard errors, the share of these whose interval holds the truth, and the mean
/// error over the standard error.
fn row(
    body: Body,
    points: usize,
    noise: f64,
    scans: u64,
) -> Result<(u64, Vec<String>), Box<dyn Error>> {
    let mut all = 0_u64;
    let truth = truth(body)?;
    let mut covered = [0; FIGURES.len()];
    let mut bias = [0.0; FIGURES.len()];
    for seed in 0..scans {
        let synthetic = synthesize(
            &SynthOptions::clean(body)
                .with_noise(noise)
                .with_seed(seed)
                .with_points(points),
        )?;
        let scan = Scan::from_points(synthetic.points);
        let options = FitOptions::default();
        let told = FitReport::new(
            body.to_string(),
            None,
            &fit(&scan, &options)?,
            &options,
            &[],
        );
        let Some(errors) = told.standard_errors else {
            continue;
        };
        all += 1;
        let (moments, sizes) = (
            told.principal.ok_or("a finite inertia")?.moments,
            told.dimensions.ok_or("a finite inertia")?,
        );
        let pairs = [
            (told.area.ok_or("an area")?, errors.area),
            (told.volume.ok_or("a volume")?, errors.volume),
            (moments[0], errors.moments[0]),
            (moments[1], errors.moments[1]),
            (moments[2], errors.moments[2]),
            (sizes.length, errors.dimensions.length),
            (sizes.width, errors.dimensions.width),
            (sizes.thickness, errors.dimensions.thickness),
        ];
        for (i, (found, error)) in pairs.into_iter().enumerate() {
            let deviation = (found - truth[i]) / error;
            covered[i] += u64::from(deviation.abs() <= QUANTILE);
            bias[i] += deviation;
        }
    }
    let of = all.max(1) as f64;
    let cell = |(covered, bias): (u64, f64)| {
        format!("{:.0} % ({:+.1})", 100.0 * covered as f64 / of, bias / of)
    };
    Ok((all, covered.into_iter().zip(bias).map(cell).collect()))
}

/// The figures of the closed form.
fn truth(body: Body) -> Result<[f64; FIGURES.len()], Box<dyn Error>> {
    let solid = synthesize(&SynthOptions::clean(body))?.truth.properties;
    let principal = solid.principal().ok_or("a finite inertia")?;
    let surface = body.surface();
    let reach = |towards: Vector3<f64>| {
        support(&Radial(surface.as_ref()), &towards)
            .point
            .dot(&towards)
    };
    let extent = |i: usize| {
        let axis = principal.axes.column(i).into_owned();
        reach(axis) + reach(-axis)
    };
    let [i1, i2, i3] = principal.moments.into();
    Ok([
        solid.area,
        solid.volume,
        i1,
        i2,
        i3,
        extent(0),
        extent(1),
        extent(2),
    ])
}
