//! How far an expansion can fall within a small part of the sphere, from samples of it there.
//!
//! About any place, in latitude and longitude with the place on the equator, an expansion of degree L is a
//! trigonometric polynomial of degree L in each. On arcs from -t to t, with sin(s/2) = sin(t/2) cos(p/2), its
//! change per radian of p is at most L times half its range (Videnskii 1960), so on the square of two such arcs,
//! with samples 2 h apart in both p, no value is farther from a sample than e = 2 L h times half the range:
//! half the range is at most that of the samples over 1 - e, and the least value is found to e of it.
//!
//! Unlike bounds from coefficients it does not know what the expansion does elsewhere, where no point ever held
//! it.

use super::bound::angle;
use crate::sphere::{Cap, CapBasis, Places};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// The share e of half the range by which values between samples may differ from them.
const BETWEEN: f64 = 0.5;

/// Largest angle, as a share of that of the cap, within which sampling is worth while.
const LARGEST: f64 = 0.4;

/// Highest degree of an expansion that is sampled; the samples are 630 times its square.
const MAX_DEGREE: usize = 6;

/// The samples of an expansion: so many for its degree.
pub(super) struct Samples {
    /// Cosines of half of p.
    cosines: Vec<f64>,
}

impl Samples {
    /// Those for a degree, if it is not too high.
    pub(super) fn new(degree: usize) -> Option<Self> {
        let count = (TAU * degree.max(1) as f64 / BETWEEN).ceil() as usize;
        let p = (0..count).map(|i| TAU * (i as f64 + 0.5) / count as f64);
        (degree <= MAX_DEGREE).then(|| Self {
            cosines: p.map(|p| (0.5 * p).cos()).collect(),
        })
    }

    /// Number of samples.
    pub(super) fn count(&self) -> usize {
        self.cosines.len().pow(2)
    }

    /// A bound from below of the expansion within an angle of a direction; none where that is not much less
    /// than the cap's.
    pub(super) fn least(
        &self,
        (basis, cap, coefficients): (&CapBasis, &Cap, &[f64]),
        middle: &Vector3<f64>,
        radius: f64,
    ) -> Option<f64> {
        if radius > LARGEST * angle(cap.height) {
            return None;
        }
        let east = middle.cross(&Vector3::ith(middle.iamin(), 1.0)).normalize();
        let north = middle.cross(&east);
        let half = (0.5 * radius).sin();
        // Sine and cosine of the angles.
        let angles = self.cosines.iter().map(|cosine| {
            let s = half * cosine;
            [2.0 * s * ((1.0 - s) * (1.0 + s)).sqrt(), 1.0 - 2.0 * s * s]
        });
        let angles: Vec<[f64; 2]> = angles.collect();
        let mut directions = Vec::with_capacity(self.count());
        for [sin_latitude, cos_latitude] in &angles {
            for [sin, cos] in &angles {
                let n = north * *sin_latitude + (middle * *cos + east * *sin) * *cos_latitude;
                directions.push([n.x, n.y, n.z, 0.0]);
            }
        }
        let mut places = Places::default();
        cap.locate(&directions, &mut places);
        let mut values = vec![0.0; directions.len()];
        basis.values(coefficients, &places, &mut values);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values {
            (low, high) = (low.min(value), high.max(value));
        }
        Some(low - 0.5 * (high - low) * BETWEEN / (1.0 - BETWEEN))
    }
}
