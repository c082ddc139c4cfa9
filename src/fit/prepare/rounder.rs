//! Where a body is as wide in all directions.

use super::thin::WHOLE_CLOUD;
use nalgebra::{Matrix3, Point3, Vector3};

/// A body is a rod where its points reach so many times as far along it as across (standard deviations).
const ROD: f64 = 5.0;

/// The linear map after which second moments are the same in all directions, and the most by which it stretches; it leaves the
/// longest axis as it is. `None` if the moments are those of something flat.
pub(super) fn rounder(moments: Matrix3<f64>) -> Option<(Matrix3<f64>, f64)> {
    let found = moments.symmetric_eigen();
    let most = found.eigenvalues.max();
    let factors: Vector3<f64> = found.eigenvalues.map(|moment| (most / moment).sqrt());
    let is_solid = factors.iter().all(|factor| factor.is_finite());
    let axes = found.eigenvectors;
    is_solid.then(|| {
        let map = axes * Matrix3::from_diagonal(&factors) * axes.transpose();
        (map, factors.max())
    })
}

/// The same of points of a rod round a centre; `None` of all else.
pub(super) fn rounder_of_rod(points: &[Point3<f64>], centre: &Point3<f64>) -> Option<Matrix3<f64>> {
    let step = points.len().div_ceil(WHOLE_CLOUD).max(1);
    let rays = points.iter().step_by(step).map(|point| point - centre);
    let moments: Matrix3<f64> = rays.map(|ray| ray * ray.transpose()).sum();
    let mut squares: [f64; 3] = moments.symmetric_eigenvalues().into();
    squares.sort_by(f64::total_cmp);
    let is_rod = squares[2] > ROD * ROD * squares[1];
    let found = is_rod.then(|| rounder(moments)).flatten();
    found.map(|(map, _)| map)
}
