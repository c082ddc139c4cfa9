//! How often intervals of points hold points of real scans that the fit has not seen.

use crate::scans::SCANS;
use grainform::scan::{Scan, read_scan};
use grainform::{FitOptions, StarSurface, Surface, fit};
use nalgebra::{Point3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::error::Error;
use std::path::Path;

/// One point in so many is hidden.
const ONE_IN: u32 = 10;

/// Normal quantiles of two-sided intervals of 95 and 50 %.
const QUANTILES: [f64; 2] = [1.96, 0.674];

pub(crate) fn print(scans: &Path) -> Result<(), Box<dyn Error>> {
    println!("\n| scan | hidden points | RMS / mean radius | 95 % | 50 % |\n|---|---|---|---|---|");
    let mut all = [0.0; 2];
    for name in SCANS {
        let scan = read_scan(&scans.join(name))?;
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let (hidden, points): (Vec<Point3<f64>>, Vec<_>) = scan
            .points()
            .iter()
            .partition(|_| random.next_u32() % ONE_IN == 0);
        let fitted = fit(&Scan::from_points(points), &FitOptions::default())?;
        let grain = fitted.grain.star().ok_or("a radius")?;
        let rays = hidden.iter().map(|point| point - grain.frame().centre);
        let rays: Vec<Vector3<f64>> = rays.collect();
        let directions: Vec<Vector3<f64>> = rays.iter().map(Vector3::normalize).collect();
        let errors = fitted.radius_errors(&directions).ok_or("an estimate")?;
        let off = |(ray, n): (&Vector3<f64>, &Vector3<f64>)| ray.norm() - grain.radius(n);
        let offs: Vec<f64> = rays.iter().zip(&directions).map(off).collect();
        let count = offs.len() as f64;
        let rms = (offs.iter().map(|off| off * off).sum::<f64>() / count).sqrt();
        let shares = QUANTILES.map(|quantile| {
            let pairs = offs.iter().zip(&errors);
            let held = pairs.filter(|(off, error)| off.abs() <= quantile * error.point);
            held.count() as f64 / count
        });
        println!(
            "| {name} | {} | {:.3} % | {:.2} | {:.2} |",
            hidden.len(),
            100.0 * rms / fitted.mean_radius,
            shares[0],
            shares[1]
        );
        for (all, share) in all.iter_mut().zip(shares) {
            *all += share / SCANS.len() as f64;
        }
    }
    println!("| mean | | | {:.2} | {:.2} |", all[0], all[1]);
    Ok(())
}
