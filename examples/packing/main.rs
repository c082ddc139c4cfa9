//! How densely grains pack by their shape: the beds behind figures 5 to 8 of Wang, Marmysh and Ji (2020).
//!
//! `cargo run --release --example packing [SEEDS] [GRAINS] [PLOT.svg]` (default: 2 seeds, 1500 grains, a quarter of an
//! hour; the letter's figures ask for 5 seeds). Each bed is kept in `packing.csv` when it is finished: stopped at any
//! time, the example goes on with those that are missing.
//!
//! All grains have the volume of a sphere of 5 mm and fall into a box of 60 mm x 60 mm, or as much of it as fewer grains
//! fill as high; fewer than some 300 have no core. Of the letter these figures, the number of grains and the diameter are known; its shapes and its table
//! of materials are lost. Assumed are density 2500 kg/m³, Young's modulus 10 MPa, Poisson's ratio 0.3, friction 0.3 (0
//! where it says so), no rolling friction, and damping 0.2, of walls too. Errors are standard errors over the seeds.
//!
//! Without friction the beds are compared with published random close packings: 0.64 of spheres, 0.74 of ellipsoids
//! 1.25 : 1 : 0.8 (Donev and others 2004), 0.71 of dimers 1.4 times as long as wide (Faure and others 2009).

mod kept;
mod plot;
mod shapes;

use grainform::bed::{Bed, BedSettings, Container, GrainKind, fabric, packing};
use kept::{Kept, Row};
use rayon::prelude::*;
use shapes::{Shape, shapes};
use std::error::Error;

/// Of the equal spheres, in metres.
const DIAMETER: f64 = 5e-3;

/// Side of the box of 1500 grains, in metres.
const SIDE: f64 = 0.06;
const GRAINS: usize = 1500;

/// Simulated time after which a bed without friction, which never quite comes to rest, is told all the same.
const SECONDS: f64 = 1.5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let seeds: u64 = words.next().map_or(Ok(2), |word| word.parse())?;
    let grains: usize = words.next().map_or(Ok(GRAINS), |word| word.parse())?;
    let shapes = shapes()?;
    let runs: Vec<(usize, u64)> = (0..shapes.len())
        .flat_map(|shape| (0..seeds).map(move |seed| (shape, seed)))
        .collect();
    let kept = Kept::open("packing.csv")?;
    let rows = runs.par_iter().map(|&(shape, seed)| {
        let shape = &shapes[shape];
        let found = kept.row(shape, seed, grains, || bed(shape, seed, grains));
        found.map_err(|error| error.to_string())
    });
    let rows: Vec<Row> = rows.collect::<Result<_, String>>()?;

    println!("| shape | friction | packing in the core | published | neighbours |");
    println!("|---|---|---|---|---|");
    let mut points = Vec::new();
    for shape in &shapes {
        let own = rows.iter().filter(|row| row.is_of(shape));
        let (packings, neighbours): (Vec<f64>, Vec<f64>) =
            own.map(|row| (row.packing, row.neighbours)).unzip();
        let (packing, error) = mean(&packings);
        let told = error.map_or(String::new(), |error| format!(" ± {error:.4}"));
        let published = shape.published.map_or("".into(), |limit| limit.to_string());
        println!(
            "| {} | {} | {packing:.4}{told} | {published} | {:.2} |",
            shape.name,
            shape.friction,
            mean(&neighbours).0
        );
        points.push((shape, packing, error.unwrap_or(0.0)));
    }
    if let Some(path) = words.next() {
        std::fs::write(path, plot::svg(&points)?)?;
    }
    Ok(())
}

/// One bed, settled: packing in its core, and neighbours per grain.
fn bed(shape: &Shape, seed: u64, grains: usize) -> Result<[f64; 2], Box<dyn Error>> {
    let settings = BedSettings {
        grains,
        container: Container::Box([SIDE * (grains as f64 / GRAINS as f64).cbrt(); 2]),
        friction: shape.friction,
        most_seconds: SECONDS,
        seed,
        ..BedSettings::default()
    };
    let own = GrainKind::new(&shape.body, 1.0, settings.density)?;
    let metres = 0.5 * DIAMETER / own.radius();
    let kind = GrainKind::new(&shape.body, metres, settings.density)?;
    let mut bed = Bed::new(settings, vec![kind], &[1.0], None)?;
    while bed.rest().is_none() {
        bed.go_on()?;
    }
    let core = packing(&bed).core.ok_or("too few grains for a core")?;
    Ok([core.value, fabric(&bed).neighbours])
}

/// Mean and its standard error, which a single value does not tell.
fn mean(values: &[f64]) -> (f64, Option<f64>) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let error = (squares / (count - 1.0) / count).sqrt();
    (mean, (values.len() > 1).then_some(error))
}
