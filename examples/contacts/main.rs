//! How near contacts of fitted grains come to those of the bodies behind them: prints the tables of docs/accuracy.md.
//!
//! `cargo run --release --example contacts` prints that of closed forms, and that of particles whose radius is known as an
//! expansion (cement, aggregate, boxes), which are read from `../shared/scans`; without that folder it is left out.
//! Arguments: a number to take every so many particles only.

mod pairs;
#[path = "../real/particle.rs"]
#[allow(dead_code, reason = "the other example compares areas and volumes too")]
mod particle;

use grainform::model::{Frame, Radial, StarGrain};
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, Grain, fit};
use nalgebra::Vector3;
use pairs::{Fits, Found};
use particle::Particle;
use std::error::Error;
use std::path::Path;

/// Where the particles are.
const PARTICLES: &str = "../shared/scans/nist_train";

/// Points, and noise as a share of the mean radius.
const CLOUDS: [(usize, f64); 4] = [(1538, 0.0), (1538, 0.005), (6146, 0.0), (6146, 0.005)];

/// Poses of a pair of a closed form.
const POSES: usize = 20;

/// Poses of each pair of particles.
const POSES_OF_PARTICLE: usize = 4;

fn main() -> Result<(), Box<dyn Error>> {
    let every = std::env::args().find_map(|argument| argument.parse().ok());
    print_head();
    let bodies = [
        (Body::Ellipsoid, Some(Vector3::new(2.0, 2.0, 1.0))),
        (Body::Ellipsoid, Some(Vector3::new(5.0, 4.0, 2.0))),
        (Body::Ellipsoid, Some(Vector3::new(10.0, 1.0, 1.0))),
        (Body::Bean, None),
        (Body::Chickpea, None),
        (Body::Maize, None),
    ];
    for (body, axes) in bodies {
        let name = axes.map_or(body.to_string(), |a| {
            format!("{body} {}:{}:{}", a.x, a.y, a.z)
        });
        for cloud in CLOUDS {
            let mut found = Found::default();
            add_body(&mut found, body, axes, cloud)?;
            print_row(&name, cloud, &found);
        }
    }
    if !Path::new(PARTICLES).exists() {
        println!("{PARTICLES} is not there: particles are left out");
        return Ok(());
    }
    let particles = Particle::all(Path::new(PARTICLES))?;
    print_head();
    for cloud in CLOUDS {
        let mut found = Found::default();
        for particle in particles.iter().step_by(every.unwrap_or(1)) {
            add_particle(&mut found, particle, cloud)?;
        }
        print_row("particles", cloud, &found);
    }
    Ok(())
}

fn print_head() {
    println!(
        "| bodies | points | noise | forces told | depth | volume | curvature | force | force by volume |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
}

fn print_row(name: &str, (points, noise): (usize, f64), found: &Found) {
    let percent = 100.0 * noise;
    println!("| {name} | {points} | {percent} % | {}", found.columns());
}

fn fitted(scan: &Scan) -> Result<Grain, Box<dyn Error>> {
    Ok(fit(scan, &FitOptions::default())?.grain_with_errors())
}

fn add_body(
    found: &mut Found,
    body: Body,
    axes: Option<Vector3<f64>>,
    (points, noise): (usize, f64),
) -> Result<(), Box<dyn Error>> {
    let truth = axes.map_or_else(|| Ok(body.surface()), |axes| body.with_axes(axes))?;
    let synthetic = |seed| {
        let options = SynthOptions::clean(body)
            .with_axes(axes)
            .with_points(points)
            .with_noise(noise)
            .with_seed(seed);
        synthesize(&options)
    };
    let scans = [synthetic(1)?, synthetic(2)?];
    let mean_radius = scans[0].truth.mean_radius;
    let [one, other] = scans.map(|synthetic| fitted(&Scan::from_points(synthetic.points)));
    let fits = Fits {
        truth: &Radial(truth.as_ref()),
        mean_radius,
        grains: [one?, other?],
    };
    found.add(&fits, POSES)
}

fn add_particle(
    found: &mut Found,
    particle: &Particle,
    (points, noise): (usize, f64),
) -> Result<(), Box<dyn Error>> {
    let truth = StarGrain::expansion(Frame::SCAN, particle.coefficients.clone())?;
    let of_seed = |seed| -> Result<Grain, Box<dyn Error>> {
        let directions = Sampling::Random.directions(points, seed)?;
        fitted(&particle.scan(&directions, noise, seed))
    };
    let fits = Fits {
        truth: &truth,
        mean_radius: particle.mean_radius,
        grains: [of_seed(1)?, of_seed(2)?],
    };
    found.add(&fits, POSES_OF_PARTICLE)
}
