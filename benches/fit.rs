//! Time of each stage of a fit on one thread, against the rate of a large matrix product measured in
//! the same run, so that figures from different machines and releases can be compared: `cargo bench`.
//!
//! "estimate" is a fit with one segment, "cells" the default fit, which contains the estimate. The floor
//! of the search over independent segments is one QR per segment and level, 2 n (p + 1)^2 operations for
//! n samples and p coefficients, at that rate; it leaves out evaluating the bases, held-out errors, area
//! and volume.

mod timing;

use faer::{Accum, Mat, Par};
use grainform::fit::{Context, PreparedScan};
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::sphere::Symmetry;
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
            "estimate",
            "cells",
            "measure",
            "errors",
            "1e6 radii",
            "as one",
            "independent",
            "/floor",
        ];
        println!("{}", columns.map(|name| format!("{name:>12}")).concat());
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
    let options = SynthOptions::clean(Body::Maize).with_points(points);
    let scan = Scan::from_points(synthesize(&options).expect("valid options").points);
    let samples = scan.points().len() as f64;
    let prepare = || PreparedScan::new(&scan, Symmetry::NONE).expect("a grain");
    let cells = FitOptions::default();
    let estimate = FitOptions::default().with_segments(1);
    let independent = FitOptions::default()
        .with_seams(Seams::None)
        .with_exhaustive(true);

    let preparing = median(runs, prepare);
    let prepared = prepare();
    let fit = |options: &FitOptions| prepared.fit(options, &Context::default()).expect("a fit");
    let estimating = median(runs, || fit(&estimate));
    let fitting = median(runs, || fit(&cells));
    let fitted = fit(&cells);
    let measuring = median(runs, || grain_properties(&fitted.grain));
    let survey = fitted.survey();
    survey.dimensions().expect("a finite grain");
    let drawing = median(runs, || fitted.standard_errors(&survey));
    let directions = Sampling::Random
        .directions(1_000_000, 0)
        .expect("enough directions");
    let evaluating = median(3, || fitted.grain.star().unwrap().radii(&directions));
    let whole = fitted
        .whole
        .as_ref()
        .or(fitted.grain.star())
        .expect("a radius");
    let evaluating_whole = median(3, || whole.radii(&directions));

    let searching = median(runs, || fit(&independent));
    let levels = 10.0;
    let floor = levels * 2.0 * samples * 17.0 * 17.0 / rate;
    let milliseconds = |seconds: f64| format!("{:>12.1}", 1e3 * seconds);
    println!(
        "{:>12}{}{}{}{}{}{}{}{}{:>12.1}",
        samples,
        milliseconds(preparing),
        milliseconds(estimating),
        milliseconds(fitting),
        milliseconds(measuring),
        milliseconds(drawing),
        milliseconds(evaluating),
        milliseconds(evaluating_whole),
        milliseconds(searching),
        searching / floor,
    );
}
