//! What the steps between voxels hide of a superquadric.
//!
//! A point half-way between two voxels is off the surface by a saw tooth of where this crosses the line between them. Along a
//! flat side that lies along the voxels' layers all teeth are one, and the fit follows them: its residuals tell nothing. So
//! wherever the lattice may lie, the teeth are summed as their Fourier series: with u the crossing in steps along an axis,
//!
//! ```text
//! tooth(u) = sum over k of sin(2 pi k u) / (pi k),   variance = sum over k of |sum of g exp(2 pi i k u)|² / (2 pi² k²)
//! ```
//!
//! g being the gradient by a step of a point. Sides that face each other are summed on their own: how far apart they are is
//! what the fit followed the teeth in. Of a curved surface the terms cancel but for those that scatter gives too.

use super::bodies::Body;
use super::cloud::Voxels;
use super::distance::TOUCHED;
use super::form::Form;
use super::soft_minimum::SoftMinimum;
use nalgebra::{DVector, Vector3};
use std::f64::consts::{PI, TAU};

/// Terms of the series: the others have a twentieth of the variance of one tooth.
const TERMS: usize = 12;

/// Sides of a body, seen along the axes of the image.
const SIDES: usize = 6;

/// The numbers that a distance depends on last: the centre along the body's axes.
const CENTRE_FROM: usize = TOUCHED - 3;

/// The series of a fit, side by side.
pub(super) struct Teeth<'a> {
    voxels: &'a Voxels,
    bodies: &'a [Body],
    form: Form,
    /// Sums with the cosine and the sine of each term of each side.
    sums: Vec<[DVector<f64>; 2]>,
}

impl<'a> Teeth<'a> {
    pub(super) fn new(voxels: &'a Voxels, bodies: &'a [Body], form: Form) -> Self {
        let none = || DVector::zeros(bodies.len() * form.parameters());
        Self {
            voxels,
            bodies,
            form,
            sums: vec![[none(), none()]; SIDES * TERMS],
        }
    }

    /// Adds a point of the cloud, which has this distance and weight.
    pub(super) fn add(&mut self, point: usize, distance: &SoftMinimum, weight: f64) {
        let Some(axis) = self.voxels.axes[point] else {
            return;
        };
        let step = self.voxels.steps.column(axis).into_owned();
        // As the centre goes one way, a point goes the other.
        let along: f64 = distance
            .entries
            .iter()
            .map(|entry| {
                let by_centre = Vector3::from_column_slice(&entry.slopes[CENTRE_FROM..]);
                -by_centre.dot(&self.bodies[entry.body].axes.tr_mul(&step))
            })
            .sum();
        if along == 0.0 {
            return;
        }
        let crossing = -distance.value / along;
        let side = 2 * axis + usize::from(along > 0.0);
        for term in 0..TERMS {
            let (sin, cos) = (TAU * (term + 1) as f64 * crossing).sin_cos();
            let [of_cos, of_sin] = &mut self.sums[TERMS * side + term];
            let entries = distance.entries.iter();
            for (place, slope) in entries.flat_map(|entry| entry.placed(self.form)) {
                of_cos[place] += weight * along * slope * cos;
                of_sin[place] += weight * along * slope * sin;
            }
        }
    }

    /// Gradients that are as likely as their opposites.
    pub(super) fn gradients(self) -> impl Iterator<Item = DVector<f64>> {
        self.sums.into_iter().enumerate().flat_map(|(at, sums)| {
            let deviation = 1.0 / (2.0_f64.sqrt() * PI * (at % TERMS + 1) as f64);
            sums.map(|sum| sum * deviation)
        })
    }
}
