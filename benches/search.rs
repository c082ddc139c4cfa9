//! Time of each stage of a fit on one thread, against the floor that this machine's matrix products
//! set, so that figures from different machines can be compared: `cargo bench`.
//!
//! The floor of a search counts one QR of the design matrix per segment and level, 2 n (p + 1)^2
//! operations for n samples and p coefficients, at the rate of a large matrix product measured in
//! the same run. It leaves out evaluating the basis, the held-out errors, area and volume.

use faer::{Accum, Mat, Par};
use grainform::FitOptions;
use grainform::fit::PreparedScan;
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a pool of one thread");
    pool.install(|| {
        let rate = product_rate();
        println!("matrix product: {:.1} Gflop/s\n", rate / 1e9);
        println!(
            "{:>10} {:>10} {:>12} {:>10} {:>10} {:>10} {:>10} {:>8}",
            "points", "prepare", "search (all)", "(needed)", "finish", "measure", "floor", "ratio"
        );
        for (points, runs) in [(1_538, 40), (6_146, 40), (98_306, 10), (1_000_000, 3)] {
            stages(points, runs, rate);
        }
    });
}

/// Operations per second of a 384 x 384 matrix product.
fn product_rate() -> f64 {
    let n = 384;
    let a = Mat::from_fn(n, n, |i, j| ((i * 7 + j * 3) % 11) as f64);
    let mut c = Mat::zeros(n, n);
    let seconds = median(20, || {
        faer::linalg::matmul::matmul(&mut c, Accum::Replace, &a, &a, 1.0, Par::Seq);
    });
    2.0 * (n * n * n) as f64 / seconds
}

fn stages(points: usize, runs: usize, rate: f64) {
    let options = SynthOptions {
        points,
        ..SynthOptions::clean(Body::Maize)
    };
    let scan = Scan {
        points: synthesize(&options).expect("valid options").points,
        ..Scan::default()
    };
    let all = FitOptions {
        exhaustive: true,
        ..FitOptions::default()
    };
    let needed = FitOptions::default();
    let prepare = |options: &FitOptions| PreparedScan::new(&scan, options).expect("a grain");
    let prepared = prepare(&all);
    let searched = median(runs, || prepared.search(&|_, _| ()));
    let lean = prepare(&needed);
    let skipping = median(runs, || lean.search(&|_, _| ()));
    let preparing = median(runs, || prepare(&all));
    let found = lean.search(&|_, _| ());
    let started = Instant::now();
    let fitted = lean.finish(found);
    let finishing = started.elapsed().as_secs_f64();
    let measuring = median(runs, || grain_properties(&fitted.grain));
    let levels = 10.0;
    let floor = levels * 2.0 * scan.points.len() as f64 * 17.0 * 17.0 / rate;
    println!(
        "{:>10} {:>7.2} ms {:>9.2} ms {:>7.2} ms {:>7.2} ms {:>7.2} ms {:>7.2} ms {:>8.2}",
        scan.points.len(),
        1e3 * preparing,
        1e3 * searched,
        1e3 * skipping,
        1e3 * finishing,
        1e3 * measuring,
        1e3 * floor,
        searched / floor
    );
}

/// Median time of a few runs, in seconds.
fn median<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    let mut seconds: Vec<f64> = (0..runs)
        .map(|_| {
            let started = Instant::now();
            black_box(work());
            started.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[runs / 2]
}
