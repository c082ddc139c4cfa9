//! Systems of three equations with a symmetric matrix that is nearly positive definite.

use nalgebra::{Matrix3, Vector3};

/// Pivots below this share of the trace are none.
const LEAST_PIVOT: f64 = 1e-13;

/// What is added to the diagonal at first, as a share of the trace.
const LEAST_SHIFT: f64 = 1e-9;

/// Shifts that are tried, each ten times as large: the last is ten times the trace.
const SHIFTS: i32 = 11;

/// Solves for two right-hand sides at once, with as much added to the diagonal as makes the matrix positive definite;
/// `None` if nothing does.
#[inline]
pub(super) fn solve(matrix: &Matrix3<f64>, sides: [&Vector3<f64>; 2]) -> Option<[Vector3<f64>; 2]> {
    let trace = matrix.trace();
    let mut shift = LEAST_SHIFT * trace;
    for _ in 0..SHIFTS {
        if let Some(solved) = shifted(matrix, sides, shift, LEAST_PIVOT * trace) {
            return Some(solved);
        }
        shift *= 10.0;
    }
    None
}

/// L D Lᵀ of the shifted matrix, and both solutions.
#[inline(always)]
fn shifted(
    m: &Matrix3<f64>,
    sides: [&Vector3<f64>; 2],
    shift: f64,
    least: f64,
) -> Option<[Vector3<f64>; 2]> {
    let is_pivot = |pivot: f64| pivot > least;
    let d1 = m.m11 + shift;
    if !is_pivot(d1) {
        return None;
    }
    let (l1, l2) = (m.m12 / d1, m.m13 / d1);
    let d2 = m.m22 + shift - l1 * m.m12;
    if !is_pivot(d2) {
        return None;
    }
    let t = m.m23 - l2 * m.m12;
    let l3 = t / d2;
    let d3 = m.m33 + shift - l2 * m.m13 - l3 * t;
    if !is_pivot(d3) {
        return None;
    }
    Some(sides.map(|side| {
        let y = side.y - l1 * side.x;
        let z = (side.z - l2 * side.x - l3 * y) / d3;
        let y = y / d2 - l3 * z;
        Vector3::new(side.x / d1 - l1 * y - l2 * z, y, z)
    }))
}
