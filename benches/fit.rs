//! Time of each stage of a fit on one thread, against the floor that this machine's matrix products
//! set, so that figures from different machines and releases can be compared: `cargo bench`.
//!
//! The floor of the adaptive fit counts the products A^T A of its final round, with the cells that a
//! sample touches, at the rate of a large matrix product measured in the same run; that of the search
//! over independent segments one QR per segment and level, 2 n (p + 1)^2 operations for n samples and
//! p coefficients. Both leave out evaluating the bases, held-out errors, earlier rounds, area and
//! volume.

mod timing;

use faer::{Accum, Mat, Par};
use grainform::fit::PreparedScan;
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, Seams};
use timing::median;

fn main() {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a pool of one thread");
    pool.install(|| {
        let rate = product_rate();
        println!("matrix product: {:.1} Gflop/s; milliseconds\n", rate / 1e9);
        let columns = [
            "points",
            "prepare",
            "adaptive",
            "/floor",
            "measure",
            "errors",
            "1e6 radii",
            "independent",
            "/floor",
        ];
        println!("{}", columns.map(|name| format!("{name:>11}")).concat());
        for (points, runs) in [(1_538, 20), (6_146, 20), (98_306, 5), (1_000_000, 3)] {
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
    let samples = scan.points.len() as f64;
    let prepare = |options: &FitOptions| PreparedScan::new(&scan, options).expect("a grain");
    let adaptive = FitOptions::default();
    let independent = FitOptions {
        seams: Seams::None,
        exhaustive: true,
        ..FitOptions::default()
    };

    let preparing = median(runs, || prepare(&adaptive));
    let prepared = prepare(&adaptive);
    let fitting = median(runs, || prepared.search(&|_| ()));
    let found = prepared.search(&|_| ());
    let fitted = prepared.finish(found);
    let measuring = median(runs, || grain_properties(&fitted.grain));
    let drawing = median(runs, || fitted.standard_errors());
    let directions = Sampling::Random
        .directions(1_000_000, 0)
        .expect("enough directions");
    let evaluating = median(3, || fitted.grain.radii(&directions));
    let floor = samples * fitted.grain.coefficients_touched().powi(2) / rate;

    let segments = prepare(&independent);
    let searching = median(runs, || segments.search(&|_| ()));
    let levels = 10.0;
    let segments_floor = levels * 2.0 * samples * 17.0 * 17.0 / rate;
    let milliseconds = |seconds: f64| format!("{:>11.1}", 1e3 * seconds);
    println!(
        "{:>11}{}{}{:>11.1}{}{}{}{}{:>11.1}",
        samples,
        milliseconds(preparing),
        milliseconds(fitting),
        fitting / floor,
        milliseconds(measuring),
        milliseconds(drawing),
        milliseconds(evaluating),
        milliseconds(searching),
        searching / segments_floor,
    );
}
