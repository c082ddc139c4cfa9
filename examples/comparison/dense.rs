//! The rival of every segmented fit: one least-squares problem in all harmonics and all points.

use faer::linalg::solvers::SolveLstsq;
use faer::{Mat, Par};
use grainform::sphere::{coefficient_count, harmonics};
use nalgebra::{Point3, Vector3};
use std::hint::black_box;
use std::time::Instant;

/// Fits of which the median is taken.
const RUNS: usize = 3;

/// Seconds of setting up and solving it by a QR factorisation, on one thread.
pub(crate) fn seconds(points: &[Point3<f64>], degree: usize) -> f64 {
    faer::set_global_parallelism(Par::Seq);
    let centre = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / points.len() as f64;
    let rays: Vec<Vector3<f64>> = points.iter().map(|p| p.coords - centre).collect();
    let mut seconds = [0.0; RUNS].map(|_: f64| {
        let started = Instant::now();
        black_box(fit(&rays, degree));
        started.elapsed().as_secs_f64()
    });
    seconds.sort_by(f64::total_cmp);
    seconds[RUNS / 2]
}

fn fit(rays: &[Vector3<f64>], degree: usize) -> Mat<f64> {
    let mut design = Mat::zeros(rays.len(), coefficient_count(degree));
    for (row, ray) in rays.iter().enumerate() {
        for (column, value) in harmonics(degree, &ray.normalize()).into_iter().enumerate() {
            design[(row, column)] = value;
        }
    }
    let radii = Mat::from_fn(rays.len(), 1, |row, _| rays[row].norm());
    design.qr().solve_lstsq(radii)
}
