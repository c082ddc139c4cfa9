//! The rival that needs no model of noise: least squares of the whole sphere, its degree chosen by looking at the
//! hidden points.

use faer::{Mat, Par};
use grainform::sphere::{HarmonicBasis, coefficient_count};
use nalgebra::Vector3;

/// Largest degree tried.
const DEGREE: usize = 36;

/// Least RMS error of the hidden radii over all degrees that the seen ones determine.
pub(crate) fn best(seen: &[(Vector3<f64>, f64)], hidden: &[(Vector3<f64>, f64)]) -> f64 {
    let top = DEGREE.min(seen.len().isqrt() - 1);
    let design = harmonics(seen, top);
    let qr = design.qr();
    let radii = Mat::from_fn(seen.len(), 1, |i, _| seen[i].1);
    let projected = qr.compute_thin_Q().transpose() * radii;
    let judged = harmonics(hidden, top);
    let triangle = qr.thin_R();
    let rms = |degree: usize| {
        let size = coefficient_count(degree);
        let mut solution = projected.submatrix(0, 0, size, 1).to_owned();
        faer::linalg::triangular_solve::solve_upper_triangular_in_place(
            triangle.submatrix(0, 0, size, size),
            solution.as_mut(),
            Par::Seq,
        );
        let radii = judged.submatrix(0, 0, hidden.len(), size) * solution;
        let squared: f64 = hidden
            .iter()
            .enumerate()
            .map(|(i, (_, radius))| (radii[(i, 0)] - radius).powi(2))
            .sum();
        (squared / hidden.len() as f64).sqrt()
    };
    (0..=top).map(rms).fold(f64::INFINITY, f64::min)
}

fn harmonics(points: &[(Vector3<f64>, f64)], degree: usize) -> Mat<f64> {
    let basis = HarmonicBasis::new(degree);
    let mut row = vec![0.0; coefficient_count(degree)];
    let mut design = Mat::zeros(points.len(), row.len());
    for (i, (n, _)) in points.iter().enumerate() {
        basis.evaluate(n, &mut row);
        for (j, value) in row.iter().enumerate() {
            design[(i, j)] = *value;
        }
    }
    design
}
