//! Where a rod is as wide in all directions.

use super::thin::WHOLE_CLOUD;
use crate::fit::points::rounder::rounder;
use nalgebra::{Matrix3, Point3};

/// A body is a rod where its points reach so many times as far along it as across (standard deviations).
const ROD: f64 = 5.0;

/// The [map](rounder) of points of a rod round a centre; `None` of all else.
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
