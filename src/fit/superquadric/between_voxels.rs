//! What the steps between voxels hide of a superquadric.
//!
//! A point half-way between two voxels is off the surface by a saw tooth of where this crosses the line between them. Along a
//! flat side that lies along the voxels' layers all teeth are one, and the fit follows them: its residuals tell nothing. So
//! wherever the lattice may lie, the teeth are summed as their Fourier series: with u the crossing in steps along an axis,
//!
//! ```text
//! tooth(u) = sum over k of sin(2 pi k u) / (pi k),   covariance = sum over k of |sum of g exp(2 pi i k u)|² / (2 pi² k²)
//! ```
//!
//! g being what a step of a point does to the numbers of the fit. Sides that face each other are summed on their own: how far
//! apart they are is what the fit followed the teeth in. Of a curved surface the terms cancel but for those that scatter gives
//! too.

use super::cloud::Cloud;
use super::distance::{ReadyBody, TOUCHED};
use super::least_squares::Minimum;
use super::loss::LossSum;
use super::soft_minimum::SoftMinimum;
use nalgebra::{DMatrix, DVector, Dyn, Vector3, linalg::Cholesky};
use std::f64::consts::{PI, TAU};

/// Terms of the series: the others have a twentieth of the variance of one tooth.
const TERMS: usize = 12;

/// Sides of a body, seen along the axes of the image.
const SIDES: usize = 6;

/// The numbers that a distance depends on last: the centre along the body's axes.
const CENTRE_FROM: usize = TOUCHED - 3;

/// The covariance of all parameters that the lattice makes, zero where there is none. `factor`: of the normal equations;
/// `is_held`: which parameters are at a bound.
pub(super) fn between_voxels(
    cloud: &Cloud,
    found: &Minimum,
    factor: &Cholesky<f64, Dyn>,
    is_held: &[bool],
) -> DMatrix<f64> {
    let parameters = is_held.len();
    let mut covariance = DMatrix::zeros(parameters, parameters);
    let Some(voxels) = &cloud.voxels else {
        return covariance;
    };
    let weighing = &found.weighing;
    let ready: Vec<_> = found.bodies.iter().map(ReadyBody::new).collect();
    let mut sums = vec![[(); 2].map(|()| DVector::<f64>::zeros(parameters)); SIDES * TERMS];
    let mut distance = SoftMinimum::new();
    let mut loss = LossSum::new(weighing.loss);
    for (point, axis) in cloud.points.iter().zip(&voxels.axes) {
        distance.set(&ready, weighing.sharpness, point);
        let weight = loss.add(distance.value);
        let Some(axis) = *axis else { continue };
        let step = voxels.steps.column(axis).into_owned();
        // As the centre goes one way, a point goes the other.
        let along: f64 = distance
            .entries
            .iter()
            .map(|entry| {
                let by_centre = Vector3::from_column_slice(&entry.slopes[CENTRE_FROM..]);
                -by_centre.dot(&found.bodies[entry.body].axes.tr_mul(&step))
            })
            .sum();
        if along == 0.0 {
            continue;
        }
        let crossing = -distance.value / along;
        let side = 2 * axis + usize::from(along > 0.0);
        for term in 0..TERMS {
            let (sin, cos) = (TAU * (term + 1) as f64 * crossing).sin_cos();
            let [of_cos, of_sin] = &mut sums[TERMS * side + term];
            let entries = distance.entries.iter();
            for (place, slope) in entries.flat_map(|entry| entry.placed(weighing.form)) {
                of_cos[place] += weight * along * slope * cos;
                of_sin[place] += weight * along * slope * sin;
            }
        }
    }
    for (at, sums) in sums.into_iter().enumerate() {
        let share = 1.0 / (2.0 * (PI * (at % TERMS + 1) as f64).powi(2));
        for mut sum in sums {
            for (value, _) in sum.iter_mut().zip(is_held).filter(|(_, is_held)| **is_held) {
                *value = 0.0;
            }
            let moved = factor.solve(&sum);
            covariance += &moved * moved.transpose() * share;
        }
    }
    covariance
}
