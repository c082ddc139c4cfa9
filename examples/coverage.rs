//! How often the truth lies within the stated 95 % intervals (figure ± 1.96 standard errors): prints
//! the tables of the README, that of grains with a radius or, named, that of what no centre sees whole.
//!
//! `cargo run --release --example coverage -- curled`

use grainform::measure::{MassProperties, support};
use grainform::model::Radial;
use grainform::report::FitReport;
use grainform::scan::Scan;
use grainform::shapes::{Body, Curled, CurledOptions, SynthOptions, synthesize, synthesize_curled};
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

/// The same of bodies that no centre sees whole; no number of points is that of the mesh.
const CURLED: [(Option<usize>, f64, u64); 6] = [
    (None, 0.0, 1),
    (None, 0.005, 10),
    (Some(6146), 0.0, 10),
    (Some(6146), 0.005, 20),
    (Some(6146), 0.02, 20),
    (Some(1538), 0.005, 20),
];

/// Clean points that tell the sizes of such a body.
const MANY_POINTS: usize = 300_000;

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
    match std::env::args().nth(1).as_deref() {
        Some("curled") => {
            for body in Curled::ALL {
                for (points, noise, scans) in CURLED {
                    let what = points.map_or("mesh".into(), |points| points.to_string());
                    let seen = |seed| curled(body, points, noise, seed);
                    print_row(&format!("{body} | {what}"), noise, scans, seen)?;
                }
            }
        }
        _ => {
            for body in [Body::Bean, Body::Chickpea, Body::Maize] {
                let truth = truth(body)?;
                for (points, noise, scans) in CLOUDS {
                    let seen = |seed| Ok((star(body, points, noise, seed)?, truth));
                    print_row(&format!("{body} | {points}"), noise, scans, seen)?;
                }
            }
        }
    }
    Ok(())
}

fn print_row(
    what: &str,
    noise: f64,
    scans: u64,
    seen: impl Fn(u64) -> Result<(Scan, Truth), Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let (told, row) = row(scans, seen)?;
    let row = row.join(" | ");
    println!(
        "| {what} | {} % | {told} of {scans} | {row} |",
        100.0 * noise
    );
    Ok(())
}

/// The figures of a body.
type Truth = [f64; FIGURES.len()];

/// A scan of a grain that a centre sees whole.
fn star(body: Body, points: usize, noise: f64, seed: u64) -> Result<Scan, Box<dyn Error>> {
    let options = SynthOptions::clean(body).with_noise(noise);
    let synthetic = synthesize(&options.with_seed(seed).with_points(points))?;
    Ok(Scan::from_points(synthetic.points))
}

/// A scan of a body that no centre sees whole, and its figures; its sizes are those of a dense clean cloud.
fn curled(
    body: Curled,
    points: Option<usize>,
    noise: f64,
    seed: u64,
) -> Result<(Scan, Truth), Box<dyn Error>> {
    let clean = CurledOptions::clean(body).with_seed(seed);
    let dense = clean.clone().with_points(MANY_POINTS);
    let vertices = synthesize_curled(&dense)?.mesh.vertices;
    let seen = synthesize_curled(&clean.with_noise(noise).with_points(points))?;
    let solid = seen.truth.properties;
    let reach = |towards: Vector3<f64>| {
        let heights = vertices.iter().map(|vertex| vertex.coords.dot(&towards));
        heights.fold(f64::NEG_INFINITY, f64::max)
    };
    let scan = match points {
        None => Scan::from_mesh(seen.mesh)?,
        Some(_) => Scan::from_points(seen.mesh.vertices),
    };
    Ok((scan, figures(&solid, reach)?))
}

/// Of how many scans there are standard errors, the share of these whose interval holds the truth, and the mean
/// error over the standard error.
fn row(
    scans: u64,
    seen: impl Fn(u64) -> Result<(Scan, Truth), Box<dyn Error>>,
) -> Result<(u64, Vec<String>), Box<dyn Error>> {
    let mut all = 0_u64;
    let mut covered = [0; FIGURES.len()];
    let mut bias = [0.0; FIGURES.len()];
    for seed in 0..scans {
        let (scan, truth) = seen(seed)?;
        let options = FitOptions::default();
        let Ok(fitted) = fit(&scan, &options) else {
            continue;
        };
        let told = FitReport::new(String::new(), None, &fitted, &options, &[]);
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
fn truth(body: Body) -> Result<Truth, Box<dyn Error>> {
    let solid = synthesize(&SynthOptions::clean(body))?.truth.properties;
    let surface = body.surface();
    figures(&solid, |towards| {
        let found = support(&Radial(surface.as_ref()), &towards);
        found.point.dot(&towards)
    })
}

/// The figures of a solid whose surface reaches so far in a direction.
fn figures(
    solid: &MassProperties,
    reach: impl Fn(Vector3<f64>) -> f64,
) -> Result<Truth, Box<dyn Error>> {
    let principal = solid.principal().ok_or("a finite inertia")?;
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
