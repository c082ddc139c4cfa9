//! The fitted grain: a radius over all directions, segment by segment.

use super::{Frame, StarSurface};
use crate::sphere::{AngularPartition, Cap, CapBasis};
use nalgebra::{Point3, Vector3};

/// A star-shaped surface whose radius is, in each segment of the angle domain, an expansion in
/// spherical harmonics of low degree; the indicator-weighted sum of the dissertation's (4.1).
///
/// Directions and positions are those of the scan. The radius is measured from
/// [`Frame::centre`]. The expansions are independent: the radius may jump at the borders of the
/// segments ([`Grain::seam_jump`] says by how much).
#[derive(Debug, Clone)]
pub struct Grain {
    frame: Frame,
    partition: AngularPartition,
    segments: Vec<Segment>,
    basis: CapBasis,
}

/// One segment's expansion in the cap basis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    pub(crate) cap: Cap,
    pub(crate) coefficients: Vec<f64>,
}

/// Why parts do not make a grain.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidGrain {
    /// The number of expansions is not that of the segments.
    #[error("{found} expansions for {expected} segments")]
    SegmentCount {
        /// Expansions given.
        found: usize,
        /// Segments of the partition.
        expected: usize,
    },
    /// The number of coefficients is not a square: (L+1)^2 for degree L.
    #[error("segment {segment} has {found} coefficients; (L + 1)^2 are expected for degree L")]
    CoefficientCount {
        /// Index of the segment.
        segment: usize,
        /// Coefficients given.
        found: usize,
    },
    /// A number is not finite.
    #[error("{what} is not finite")]
    NotFinite {
        /// What the number is.
        what: String,
    },
    /// The axes are not orthonormal and right-handed.
    #[error("the axes are not orthonormal and right-handed")]
    Axes,
}

/// How far axes may be from orthonormal: the rounding of a file with fewer digits than f64 has.
const AXES_TOLERANCE: f64 = 1e-9;

impl Grain {
    /// A grain from its parts: one list of cap-basis coefficients per segment, in the order of the
    /// partition.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the parts do not fit together or hold a number that is not finite.
    pub fn new(
        frame: Frame,
        partition: AngularPartition,
        coefficients: Vec<Vec<f64>>,
    ) -> Result<Self, InvalidGrain> {
        if coefficients.len() != partition.segments() {
            return Err(InvalidGrain::SegmentCount {
                found: coefficients.len(),
                expected: partition.segments(),
            });
        }
        if !frame.centre.iter().all(|x| x.is_finite()) {
            return Err(InvalidGrain::NotFinite {
                what: "the centre".into(),
            });
        }
        let deviation = frame.axes.tr_mul(&frame.axes) - nalgebra::Matrix3::identity();
        // Written so that NaN fails.
        if !(deviation.amax() < AXES_TOLERANCE && frame.axes.determinant() > 0.0) {
            return Err(InvalidGrain::Axes);
        }
        let mut degree = 0;
        for (segment, list) in coefficients.iter().enumerate() {
            let root = list.len().isqrt();
            if root == 0 || root * root != list.len() {
                return Err(InvalidGrain::CoefficientCount {
                    segment,
                    found: list.len(),
                });
            }
            if !list.iter().all(|x| x.is_finite()) {
                return Err(InvalidGrain::NotFinite {
                    what: format!("a coefficient of segment {segment}"),
                });
            }
            degree = degree.max(root - 1);
        }
        let segments = coefficients
            .into_iter()
            .enumerate()
            .map(|(segment, coefficients)| Segment {
                cap: partition.cap(segment),
                coefficients,
            })
            .collect();
        Ok(Self {
            frame,
            partition,
            segments,
            basis: CapBasis::new(degree),
        })
    }

    /// Centre and axes in the scan.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The partition of the angle domain, in the grain's own frame.
    pub fn partition(&self) -> AngularPartition {
        self.partition
    }

    /// The largest degree of any segment.
    pub fn degree(&self) -> usize {
        self.basis.degree()
    }

    /// The number of coefficients of all segments together.
    pub fn coefficient_count(&self) -> usize {
        self.segments.iter().map(|s| s.coefficients.len()).sum()
    }

    /// The cap-basis coefficients of a segment: (L+1)^2 numbers in the scan's unit.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn coefficients(&self, segment: usize) -> &[f64] {
        &self.segments[segment].coefficients
    }

    /// The surface point in the direction of the unit vector `n`, in the scan's frame.
    pub fn point(&self, n: &Vector3<f64>) -> Point3<f64> {
        self.frame.centre + n * self.radius(n)
    }

    /// The outward unit normal in the direction of the unit vector `n`, in the scan's frame.
    pub fn normal(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let (radius, gradient) = self.radius_and_gradient(n);
        (n * radius - gradient).normalize()
    }

    /// Radius and surface gradient of a segment's expansion in a direction of the grain's own
    /// frame, also beyond the segment.
    pub(crate) fn segment_radius_and_gradient(
        &self,
        segment: usize,
        n: &Vector3<f64>,
    ) -> (f64, Vector3<f64>) {
        let Segment { cap, coefficients } = &self.segments[segment];
        self.basis.value_and_gradient(cap, coefficients, n)
    }

    /// Radius of a segment's expansion in a direction of the grain's own frame, also beyond the
    /// segment.
    pub(crate) fn segment_radius(&self, segment: usize, n: &Vector3<f64>) -> f64 {
        let Segment { cap, coefficients } = &self.segments[segment];
        self.basis.value(cap, coefficients, n)
    }
}

impl StarSurface for Grain {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let local = self.frame.axes.tr_mul(n);
        self.segment_radius(self.partition.segment_of(&local), &local)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let local = self.frame.axes.tr_mul(n);
        let segment = self.partition.segment_of(&local);
        let (radius, gradient) = self.segment_radius_and_gradient(segment, &local);
        (radius, self.frame.axes * gradient)
    }
}
