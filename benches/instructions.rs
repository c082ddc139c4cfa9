//! Instructions of the main stages, beside those on record: `cargo bench --bench instructions`.
//!
//! Valgrind's callgrind counts them, whatever else the machine does; where it is not installed, there is nothing to
//! print. A stage that takes a tenth more than `benches/instructions.csv` says is told, and the bench fails. With
//! `-- --record` the file is written anew. Counts are those of processors without AVX-512, which valgrind does not know,
//! and move by a percent from one compiler to the next.

use grainform::fit::{Context, PreparedScan};
use grainform::measure::{Scheme, Survey};
use grainform::report::{Measure, MeasureReport, Measured};
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::sphere::Symmetry;
use grainform::{FitOptions, Fitted, StarSurface};
use std::collections::BTreeMap;
use std::error::Error;
use std::hint::black_box;
use std::process::Command;

const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions.csv");

/// How many times as many instructions as on record are too many.
const TOO_MANY: f64 = 1.1;

/// Stages; each contains what it needs of those before it.
const STAGES: [&str; 6] = [
    "prepare",
    "fit 1538 noisy",
    "fit 6146",
    "errors",
    "1e5 radii",
    "measure",
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(stage) = arguments.iter().find(|a| STAGES.contains(&a.as_str())) {
        return run(stage);
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("valgrind is not installed: nothing to count with");
        return Ok(());
    }
    let known = record()?;
    let mut lines = String::from("stage,instructions\n");
    let mut slower = Vec::new();
    println!("| stage | 1e6 instructions | on record |\n|---|---|---|");
    for stage in STAGES {
        let count = count(stage)?;
        let ratio = known.get(stage).map(|known| count / known);
        let told = ratio.map_or("-".into(), |ratio| format!("x {ratio:.3}"));
        println!("| {stage} | {:.0} | {told} |", count / 1e6);
        lines += &format!("{stage},{count:.0}\n");
        slower.extend(ratio.is_some_and(|r| r > TOO_MANY).then_some(stage));
    }
    if arguments.iter().any(|a| a == "--record") {
        std::fs::write(RECORD, lines)?;
        return Ok(());
    }
    match slower.is_empty() {
        true => Ok(()),
        false => Err(format!("a tenth more than on record: {}", slower.join(", ")).into()),
    }
}

/// Counts on record, by stage; none if there is no record.
fn record() -> Result<BTreeMap<String, f64>, Box<dyn Error>> {
    let text = std::fs::read_to_string(RECORD).unwrap_or_default();
    let lines = text.lines().skip(1).filter_map(|line| line.split_once(','));
    lines
        .map(|(stage, count)| Ok((stage.to_owned(), count.parse()?)))
        .collect()
}

/// Instructions of this program with a stage as its argument.
fn count(stage: &str) -> Result<f64, Box<dyn Error>> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .arg(stage)
        .output()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let collected = text
        .lines()
        .find_map(|line| line.split_once("Collected : "));
    let (_, count) = collected.ok_or_else(|| format!("{stage}: {text}"))?;
    Ok(count.trim().parse()?)
}

fn run(stage: &str) -> Result<(), Box<dyn Error>> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()?;
    let (points, noise) = match stage {
        "fit 1538 noisy" => (1538, 0.01),
        _ => (6146, 0.0),
    };
    let options = SynthOptions::clean(Body::Maize)
        .with_points(points)
        .with_noise(noise);
    let scan = Scan::from_points(synthesize(&options)?.points);
    let prepared = PreparedScan::new(&scan, Symmetry::NONE)?;
    if stage == "prepare" {
        black_box(prepared);
        return Ok(());
    }
    let fitted = prepared.fit(&FitOptions::default(), &Context::default())?;
    of_fit(stage, &fitted)
}

/// What is done with a fit.
fn of_fit(stage: &str, fitted: &Fitted) -> Result<(), Box<dyn Error>> {
    let survey = Survey::of_grain(&fitted.grain, Scheme::Exact);
    match stage {
        "errors" => {
            black_box(fitted.standard_errors(&survey).ok());
        }
        "1e5 radii" => {
            let directions = Sampling::Random.directions(100_000, 0)?;
            let star = fitted.grain.star().ok_or("no radius")?;
            black_box(star.radii(&directions));
            black_box(star.radius(&directions[0]));
        }
        "measure" => {
            let (name, of) = (String::new(), Measured::Model);
            black_box(MeasureReport::new(
                name,
                of,
                &survey,
                &Measure::ALL,
                Vec::new(),
            ));
        }
        _ => {}
    }
    Ok(())
}
