//! The coefficients as the dissertation publishes them: a_l^m of the real orthonormal harmonics.

use super::Grain;
use crate::sphere::{AngleRectangle, GaussLegendre, coefficient_count, harmonics};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A segment's expansion r = sum of a_l^m Y_l^m in the real orthonormal harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedSegment {
    /// Bounds of the segment in the grain's own frame, in radians.
    pub rectangle: AngleRectangle,
    /// a_l^m at index l(l+1) + m, in the scan's unit, with respect to the grain's own axes.
    pub coefficients: Vec<f64>,
    /// What the conversion loses: the largest difference from the cap-basis expansion at 81 places
    /// of the segment, in the scan's unit. The harmonics are nearly dependent on a small segment, so
    /// their coefficients are large and cancel: expect 1e-12 of the radius at k = 2 and 1e-7 at
    /// k = 10, L = 3.
    pub loss: f64,
}

impl Grain {
    /// The published coefficients of every segment. Exact but for rounding: the cap basis spans the
    /// same functions, which are continued over the whole sphere and projected there by a product
    /// rule that is exact for their degree.
    pub fn published(&self) -> Vec<PublishedSegment> {
        let partition = self.partition();
        (0..partition.segments())
            .map(|segment| self.published_segment(segment, partition.rectangle(segment)))
            .collect()
    }

    fn published_segment(&self, segment: usize, rectangle: AngleRectangle) -> PublishedSegment {
        let degree = self.coefficients(segment).len().isqrt() - 1;
        let turns = 2 * degree + 1;
        let mut coefficients = vec![0.0; coefficient_count(degree)];
        for (z, weight) in GaussLegendre::new(degree + 1).on(-1.0, 1.0) {
            let s = (1.0 - z * z).sqrt();
            for turn in 0..turns {
                let (sp, cp) = (TAU * turn as f64 / turns as f64).sin_cos();
                let n = Vector3::new(s * cp, s * sp, z);
                let radius = self.segment_radius(segment, &n);
                let solid_angle = TAU * weight / turns as f64;
                for (a, y) in coefficients.iter_mut().zip(harmonics(degree, &n)) {
                    *a += solid_angle * radius * y;
                }
            }
        }
        let loss = (0..81)
            .map(|i| rectangle.direction((i / 9) as f64 / 8.0, (i % 9) as f64 / 8.0))
            .map(|n| {
                let sum: f64 = harmonics(degree, &n)
                    .iter()
                    .zip(&coefficients)
                    .map(|(y, a)| y * a)
                    .sum();
                (sum - self.segment_radius(segment, &n)).abs()
            })
            .fold(0.0, f64::max);
        PublishedSegment {
            rectangle,
            coefficients,
            loss,
        }
    }
}
