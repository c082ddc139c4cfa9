//! By how much a body differs from the voxels whose centres it holds.
//!
//! Moved over the lattice at random, a body of volume V holds voxels of the volume V + e. The variance of e is the sum of
//! the body's squared spectrum over the points k of the dual lattice but 0, and that of a smooth body is to first order
//! 1 / (4 pi^2 |k|^4 K), summed over the two places with the normal k, K being the curvature of Gauss there (Kendall
//! 1948). On average over all turns of the body 1 / K is S / (4 pi), S being its area:
//!
//! ```text
//! var e = S / (8 pi^3)  sum over k != 0 of  |k|^-4
//! ```

use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Waves are summed up to so many times the shortest along the widest step.
const SHELLS: f64 = 8.0;

/// The standard deviation of the volume of a body's voxels, over the root of the body's area; `steps` lead from one
/// voxel to the next.
pub(super) fn miscount(steps: &Matrix3<f64>) -> f64 {
    let Some(dual) = steps.transpose().try_inverse() else {
        return 0.0;
    };
    let lengths: Vec<f64> = steps.column_iter().map(|step| step.norm()).collect();
    let widest = lengths.iter().copied().fold(0.0, f64::max);
    let most = SHELLS / widest;
    // A wave's number along an axis is its product with the step.
    let reach = |axis: usize| {
        let most = (most * lengths[axis]) as i32;
        -most..=most
    };
    let mut sum = 4.0 * PI * steps.determinant().abs() / most;
    for i in reach(0) {
        for j in reach(1) {
            for k in reach(2) {
                let wave = dual * Vector3::new(i, j, k).map(f64::from);
                let squared = wave.norm_squared();
                if squared > 0.0 && squared <= most * most {
                    sum += squared.powi(-2);
                }
            }
        }
    }
    (sum / (8.0 * PI.powi(3))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// The voxels of balls in many places scatter in number as told.
    #[test]
    fn the_voxels_of_balls_scatter_as_told() {
        let spacing = Vector3::new(1.0, 0.8, 0.5);
        let radius = 7.3;
        let volume = 4.0 / 3.0 * PI * radius * radius * radius;
        let voxels = |middle: Vector3<f64>| {
            let at = |i: i32, axis: usize| f64::from(i) * spacing[axis] - middle[axis];
            let reach = |axis: usize| {
                let most = (radius / spacing[axis]) as i32 + 2;
                -most..=most
            };
            let mut count = 0;
            for i in reach(0) {
                for j in reach(1) {
                    let across = at(i, 0).powi(2) + at(j, 1).powi(2);
                    let squared = |k: &i32| across + at(*k, 2).powi(2) < radius * radius;
                    count += reach(2).filter(squared).count();
                }
            }
            count as f64 * spacing.product()
        };
        let rounds = 300;
        let share = |round: i32, step: f64| (f64::from(round) * step).fract();
        let squares = (0..rounds).map(|round| {
            let place = Vector3::new(
                share(round, 0.754_877_666),
                share(round, 0.569_840_291),
                share(round, 0.245_122_334),
            );
            (voxels(place.component_mul(&spacing)) - volume).powi(2)
        });
        let found = (squares.sum::<f64>() / f64::from(rounds)).sqrt();
        let told = miscount(&Matrix3::from_diagonal(&spacing)) * (4.0 * PI).sqrt() * radius;
        assert_relative_eq!(found, told, max_relative = 0.3);
    }
}
