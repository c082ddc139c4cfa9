//! A radius made of independent expansions, one per segment of the angle domain.

use super::InvalidGrain;
use super::invalid::check_expansion;
use crate::sphere::{AngularPartition, Cap, CapBasis, CapExpansion, Jet};
use nalgebra::Vector3;

/// The indicator-weighted sum of the dissertation's (4.1): in each segment, an expansion in spherical
/// harmonics of its own. The radius may jump at the borders of the segments.
#[derive(Debug, Clone)]
pub struct Segmented {
    partition: AngularPartition,
    caps: Vec<Cap>,
    coefficients: Vec<Vec<f64>>,
    expansions: Vec<CapExpansion<1>>,
    degree: usize,
}

impl Segmented {
    /// One list of cap-basis coefficients per segment, in the order of the partition.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the lists do not fit the partition or hold a number that is not finite.
    pub fn new(
        partition: AngularPartition,
        coefficients: Vec<Vec<f64>>,
    ) -> Result<Self, InvalidGrain> {
        if coefficients.len() != partition.segments() {
            return Err(InvalidGrain::SegmentCount {
                found: coefficients.len(),
                expected: partition.segments(),
            });
        }
        let mut degree = 0;
        for (segment, list) in coefficients.iter().enumerate() {
            degree = degree.max(check_expansion(segment, list)?);
        }
        Ok(Self::of(partition, coefficients, degree))
    }

    fn of(partition: AngularPartition, coefficients: Vec<Vec<f64>>, degree: usize) -> Self {
        let basis = CapBasis::new(degree);
        let segments = 0..partition.segments();
        let caps: Vec<Cap> = segments.map(|segment| partition.cap(segment)).collect();
        let lists = caps.iter().zip(&coefficients);
        Self {
            expansions: lists
                .map(|(cap, own)| CapExpansion::new(&basis, cap, own.as_chunks().0))
                .collect(),
            partition,
            caps,
            coefficients,
            degree,
        }
    }

    /// The partition of the angle domain, in the grain's own frame.
    pub fn partition(&self) -> AngularPartition {
        self.partition
    }

    /// The cap-basis coefficients of every segment: (L+1)^2 numbers each, in the scan's unit.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        &self.coefficients
    }

    /// The surface so many times as large.
    pub(crate) fn times(&self, factor: f64) -> Self {
        let mut coefficients = self.coefficients.clone();
        for coefficient in coefficients.iter_mut().flatten() {
            *coefficient *= factor;
        }
        Self::of(self.partition, coefficients, self.degree)
    }

    /// The largest degree of any segment.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The cap in which the expansion of a segment lives.
    pub(super) fn cap(&self, segment: usize) -> &Cap {
        &self.caps[segment]
    }

    /// Radius of a segment's expansion in a direction of the grain's own frame, also beyond the
    /// segment.
    pub(crate) fn segment_radius(&self, segment: usize, n: &Vector3<f64>) -> f64 {
        self.expansions[segment].value(n)
    }

    /// Radius and surface gradient of a segment's expansion, likewise.
    pub(crate) fn segment_radius_and_gradient(
        &self,
        segment: usize,
        n: &Vector3<f64>,
    ) -> (f64, Vector3<f64>) {
        self.expansions[segment].value_and_gradient(n)
    }

    /// Radius in a direction of the grain's own frame.
    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.segment_radius(self.partition.segment_of(n), n)
    }

    /// Radius and surface gradient in a direction of the grain's own frame.
    pub(crate) fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        self.segment_radius_and_gradient(self.partition.segment_of(n), n)
    }

    /// Radius and its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        self.expansions[self.partition.segment_of(n)].jet(n)
    }
}
