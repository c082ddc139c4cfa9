//! A few of many points, the same whatever their order.

use nalgebra::Point3;
use std::cmp::Ordering;

/// The distinct points or, of more than some number, about so many of them, drawn by a hash of their coordinates; sorted.
pub(crate) fn drawn(points: &[Point3<f64>], most: usize) -> Vec<Point3<f64>> {
    let drawn = indices_drawn(points, most).into_iter();
    drawn.map(|at| points[at]).collect()
}

/// As [`drawn`], the indices of the points.
pub(crate) fn indices_drawn(points: &[Point3<f64>], most: usize) -> Vec<usize> {
    let step = points.len().div_ceil(most).max(1) as u64;
    let is_drawn = |&at: &usize| hash(&points[at]).is_multiple_of(step);
    let mut drawn: Vec<usize> = (0..points.len()).filter(is_drawn).collect();
    drawn.sort_unstable_by(|&one, &other| by_coordinates(&points[one], &points[other]));
    drawn.dedup_by(|one, other| points[*one] == points[*other]);
    drawn
}

/// By x, then y, then z.
pub(crate) fn by_coordinates(one: &Point3<f64>, other: &Point3<f64>) -> Ordering {
    let compare = |axis: usize| (one[axis] + 0.0).total_cmp(&(other[axis] + 0.0));
    compare(0).then_with(|| compare(1)).then_with(|| compare(2))
}

/// A number that coordinates decide, and that looks random.
pub(super) fn hash(point: &Point3<f64>) -> u64 {
    let mix = |hash: u64, c: &f64| {
        let mixed = (hash ^ (c + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 29)
    };
    let mixed = point.iter().fold(0, mix);
    mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32
}
