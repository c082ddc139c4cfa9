//! Fits of scans, judged by points that they have not seen.

use crate::stats::median;
use grainform::scan::{Scan, read_scan};
use grainform::{FitError, FitOptions, StarSurface, fit};
use nalgebra::Point3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

/// Scans that are told one by one.
const SCANS: [&str; 12] = [
    "barley_batch/l1_30.ply",
    "barley_batch/l1_05.ply",
    "barley_batch/l2_10.ply",
    "barley_batch/l3_09.ply",
    "stone/low_res_AAA.ply",
    "stone/low_res_E22.ply",
    "lithic/ClarksonEXP02_Discoid.stl",
    "barley/barley_S017_l2_07_ascii.ply",
    "standins/maize_levallois_6146.xyz",
    "standins/barley_l1_01_6146.xyz",
    "standins/chickpea_danshaku_6146.xyz",
    "standins/bean_stoneE22_1538.xyz",
];

/// One point in so many is hidden.
const ONE_IN: u32 = 10;

/// Splits of each scan.
const SEEDS: u64 = 3;

pub fn print(scans: &Path) -> Result<(), Box<dyn Error>> {
    println!(
        "\n| scan | points | hidden RMS, default | --segments 1 | noise told | coefficients | touched | s |\n\
         |---|---|---|---|---|---|---|---|"
    );
    for name in SCANS {
        let scan = read_scan(&scans.join(name))?;
        let mut rows = Vec::new();
        for seed in 0..SEEDS {
            rows.push(judge(&scan, seed)?);
        }
        let column = |i: usize| median(&rows.iter().map(|row| row[i]).collect::<Vec<_>>());
        println!(
            "| {name} | {} | {:.3} % | {:.3} % | {:.3} % | {:.0} | {:.0} | {:.2} |",
            scan.points.len(),
            column(0),
            column(1),
            column(2),
            column(3),
            column(4),
            column(5)
        );
    }
    Ok(())
}

/// Hidden RMS in % of the mean radius of the default fit and of the estimate, noise told in %, coefficients,
/// touched, seconds.
fn judge(scan: &Scan, seed: u64) -> Result<[f64; 6], FitError> {
    let mut points = scan.points.clone();
    points.sort_by(|a, b| {
        let order = a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        order.then(a.z.total_cmp(&b.z))
    });
    points.dedup();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (hidden, seen): (Vec<Point3<f64>>, Vec<_>) = points
        .into_iter()
        .partition(|_| random.next_u32() % ONE_IN == 0);
    let seen = Scan {
        points: seen,
        ..Scan::default()
    };
    let started = Instant::now();
    let fitted = fit(&seen, &FitOptions::default())?;
    let seconds = started.elapsed().as_secs_f64();
    let whole = fit(
        &seen,
        &FitOptions {
            segments: Some(1),
            ..FitOptions::default()
        },
    )?;
    let rms = |grain: &grainform::Grain| {
        let squared: f64 = hidden
            .iter()
            .map(|point| {
                let ray = point - grain.frame().centre;
                (ray.norm() - grain.radius(&ray.normalize())).powi(2)
            })
            .sum();
        100.0 * (squared / hidden.len() as f64).sqrt() / fitted.mean_radius
    };
    Ok([
        rms(&fitted.grain),
        rms(&whole.grain),
        100.0 * fitted.search.noise.unwrap_or(f64::NAN) / fitted.mean_radius,
        fitted.grain.coefficient_count() as f64,
        fitted.grain.coefficients_touched(),
        seconds,
    ])
}
