//! Fits of scans, judged by points that they have not seen.

use crate::rival;
use crate::scans::SCANS;
use crate::stats::{median, quantile};
use grainform::scan::{Scan, read_scan};
use grainform::{FitError, FitOptions, Grain, StarSurface, Surface, fit};
use nalgebra::{Point3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

/// One point in so many is hidden.
const ONE_IN: u32 = 10;

/// Splits of each scan.
const SEEDS: u64 = 3;

pub(crate) fn print(scans: &Path) -> Result<(), Box<dyn Error>> {
    println!(
        "\n| scan | points | hidden RMS, default | --segments 1 | best least squares | told | coefficients | touched | \
         s |\n|---|---|---|---|---|---|---|---|---|"
    );
    for name in SCANS {
        let scan = read_scan(&scans.join(name))?;
        let rows: Result<Vec<Row>, FitError> = (0..SEEDS).map(|seed| judge(&scan, seed)).collect();
        let rows = rows?;
        let column = |of: fn(&Row) -> f64| median(&rows.iter().map(of).collect::<Vec<_>>());
        println!(
            "| {name} | {} | {:.3} % | {:.3} % | {:.3} % | {:.3} % | {:.0} | {:.0} | {:.2} |",
            scan.points().len(),
            column(|row| row.cells),
            column(|row| row.estimate),
            column(|row| row.rival),
            column(|row| row.told),
            column(|row| row.coefficients),
            column(|row| row.touched),
            column(|row| row.seconds)
        );
    }
    Ok(())
}

/// Kernels of the batch, one in so many.
const EVERY_KERNEL: usize = 4;

pub(crate) fn print_batch(scans: &Path) -> Result<(), Box<dyn Error>> {
    let folder = scans.join("barley_batch");
    let mut files: Vec<_> = std::fs::read_dir(folder)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "ply"))
        .collect();
    files.sort();
    let mut ratios = [Vec::new(), Vec::new()];
    for path in files.iter().step_by(EVERY_KERNEL) {
        let row = judge(&read_scan(path)?, 0)?;
        ratios[0].push(row.cells / row.rival);
        ratios[1].push(row.estimate / row.rival);
    }
    println!(
        "\n| {} kernels: hidden RMS over that of the best least squares | median | largest |",
        ratios[0].len()
    );
    println!("|---|---|---|");
    for (name, ratios) in ["default", "--segments 1"].iter().zip(&ratios) {
        println!(
            "| {name} | {:.2} | {:.2} |",
            median(ratios),
            quantile(ratios, 1.0)
        );
    }
    Ok(())
}

/// Hidden RMS in % of the mean radius, and what the default fit says and needs.
struct Row {
    cells: f64,
    estimate: f64,
    rival: f64,
    told: f64,
    coefficients: f64,
    touched: f64,
    seconds: f64,
}

fn judge(scan: &Scan, seed: u64) -> Result<Row, FitError> {
    let mut points = scan.points().to_vec();
    points.sort_by(|a, b| {
        let order = a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        order.then(a.z.total_cmp(&b.z))
    });
    points.dedup();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (hidden, points): (Vec<Point3<f64>>, Vec<_>) = points
        .into_iter()
        .partition(|_| random.next_u32() % ONE_IN == 0);
    let seen = Scan::from_points(points);
    let started = Instant::now();
    let fitted = fit(&seen, &FitOptions::default())?;
    let seconds = started.elapsed().as_secs_f64();
    let whole = FitOptions::default().with_segments(1);
    let whole = fit(&seen, &whole)?;

    let rays = |grain: &Grain, points: &[Point3<f64>]| -> Vec<(Vector3<f64>, f64)> {
        let rays = points.iter().map(|point| point - grain.frame().centre);
        rays.map(|ray| (ray.normalize(), ray.norm())).collect()
    };
    let rms = |grain: &Grain| {
        let rays = rays(grain, &hidden);
        let grain = grain.star().expect("a radius");
        let errors = rays.iter().map(|(n, radius)| radius - grain.radius(n));
        (errors.map(|e| e * e).sum::<f64>() / rays.len() as f64).sqrt()
    };
    let percent = 100.0 / fitted.mean_radius;
    let grain = &fitted.grain;
    Ok(Row {
        cells: percent * rms(grain),
        estimate: percent * rms(&whole.grain),
        rival: percent * rival::best(&rays(grain, seen.points()), &rays(grain, &hidden)),
        told: percent * fitted.search.choice().heldout_rms.unwrap_or(f64::NAN),
        coefficients: grain.coefficient_count() as f64,
        touched: grain.coefficients_touched(),
        seconds,
    })
}
