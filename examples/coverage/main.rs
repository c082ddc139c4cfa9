//! How often the truth lies within the stated 95 % intervals (figure ± 1.96 standard errors): prints the tables of
//! docs/accuracy.md.
//!
//! `cargo run --release --example coverage` prints five tables: of the three synthetic grains; of particles whose radius
//! is known as an expansion (`nist`); of kernels and stones (`scanned`); of bodies that no centre sees whole (`curled`); and
//! of the hidden points of real scans (`hidden`). The second, third and last are read from `../shared/scans`, and left out
//! where that folder is absent. Arguments: `synth`, `nist`, `scanned`, `curled` or `hidden` for one table.

mod cloud;
mod curled;
mod hidden;
#[path = "../real/particle.rs"]
#[allow(dead_code, reason = "the other example compares radii too")]
mod particle;
mod scanned;
#[path = "../real/scans.rs"]
mod scans;
mod shapes;
mod tally;
mod truth;

use cloud::Layout;
use grainform::shapes::{Body, Curled};
use particle::Particle;
use std::error::Error;
use std::fmt::Display;
use std::path::Path;
use tally::{FIGURES, Tally};
use truth::Truth;

/// Where the shapes are.
const SCANS: &str = "../shared/scans";

/// Points, noise as a share of the mean radius, layout, and scans per grain, which differ by the seed of their noise and
/// places.
const SYNTH: [(usize, f64, Layout, u64); 11] = [
    (1538, 0.0, Layout::Whole, 1),
    (1538, 0.005, Layout::Whole, 40),
    (6146, 0.0, Layout::Whole, 1),
    (6146, 0.005, Layout::Whole, 40),
    (1_000_000, 0.0, Layout::Whole, 1),
    (1_000_000, 0.005, Layout::Whole, 12),
    (6146, 0.005, Layout::Thin, 40),
    (6146, 0.005, Layout::Hole, 40),
    (1538, 0.02, Layout::Whole, 20),
    (1538, 0.005, Layout::Thin, 20),
    (1538, 0.005, Layout::Hole, 20),
];

/// The same of particles, of which there are many: one scan of each.
const NIST: [(usize, f64, Layout); 5] = [
    (1538, 0.0, Layout::Whole),
    (1538, 0.005, Layout::Whole),
    (1538, 0.02, Layout::Whole),
    (6146, 0.005, Layout::Thin),
    (6146, 0.005, Layout::Hole),
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let wants = |name: &str| arguments.is_empty() || arguments.iter().any(|a| a == name);
    let scans = Path::new(SCANS);
    if wants("synth") {
        head();
        for body in [Body::Bean, Body::Chickpea, Body::Maize] {
            let truth = Truth::closed_form(body)?;
            for (points, noise, layout, scans) in SYNTH {
                let mut tally = Tally::default();
                for seed in 0..scans {
                    tally.add(&truth.figures, &layout.scan(&truth, points, noise, seed)?)?;
                }
                row(&body.to_string(), points, noise, layout, &tally);
            }
        }
    }
    if wants("nist") && scans.exists() {
        let particles = Particle::all(&scans.join("nist_train"))?;
        let truths: Result<Vec<_>, _> = particles.iter().map(Truth::expansion).collect();
        let truths = truths?;
        head();
        for (points, noise, layout) in NIST {
            let mut tally = Tally::default();
            for (seed, truth) in (0..).zip(&truths) {
                tally.add(&truth.figures, &layout.scan(truth, points, noise, seed)?)?;
            }
            row("particles", points, noise, layout, &tally);
        }
    }
    if wants("shapes") && scans.exists() {
        let particles = Particle::all(&scans.join("nist_train"))?;
        for (points, noise) in shapes::SCANS {
            shapes::print(&particles, points, noise)?;
        }
    }
    if wants("scanned") && scans.exists() {
        head();
        let mut tally = Tally::default();
        for (scan, truth) in scanned::kernels(&scans.join("barley_batch"))? {
            tally.add(&truth, &scan)?;
        }
        row("barley kernels", 1538, 0.0, "whole", &tally);
        widths(&mut tally);
        for (points, seeds) in scanned::SCANNED {
            let mut tally = Tally::default();
            for name in scanned::MESHES {
                let (mesh, truth) = scanned::mesh(&scans.join(name))?;
                for seed in 0..seeds {
                    tally.add(&truth, &scanned::scan(&mesh, points, seed)?)?;
                }
            }
            row("kernels and stones", points, 0.0, "faces", &tally);
            widths(&mut tally);
        }
    }
    if wants("curled") {
        head();
        for body in [Curled::Banana, Curled::Cup, Curled::Mushroom, Curled::Hook] {
            let truth = curled::truth(body)?;
            for (points, noise, scans) in curled::CURLED {
                let mut tally = Tally::default();
                for seed in 0..scans {
                    tally.add(&truth, &curled::scan(body, points, noise, seed)?)?;
                }
                match points {
                    Some(points) => row(&body.to_string(), points, noise, "points", &tally),
                    None => row(&body.to_string(), "all", noise, "mesh", &tally),
                }
            }
        }
    }
    if wants("hidden") && scans.exists() {
        hidden::print(scans)?;
    }
    Ok(())
}

fn head() {
    println!(
        "\n| body | points | noise | layout | told of | {} |\n|---|---|---|---|---|{}",
        FIGURES.join(" | "),
        "---|".repeat(FIGURES.len())
    );
}

fn widths(tally: &mut Tally) {
    let medians = tally.medians().map(|share| format!("{share:.2} %"));
    println!(
        "| standard errors, median | | | | | {} |",
        medians.join(" | ")
    );
}

fn row(name: &str, points: impl Display, noise: f64, layout: impl Display, tally: &Tally) {
    let percent = 100.0 * noise;
    println!("| {name} | {points} | {percent} % | {layout} | {tally} |");
}
