//! Why parts do not make a grain.

use super::{InvalidSuperquadric, Whole};
use crate::digits::plural;

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
    #[error("segment {segment} has {}; (L + 1)^2 are expected for degree L", plural(*found, "coefficient"))]
    CoefficientCount {
        /// Index of the segment.
        segment: usize,
        /// Coefficients given.
        found: usize,
    },
    /// An expansion is of too high a degree.
    #[error("degree {found}; at most {} is allowed", Whole::MAX_DEGREE)]
    Degree {
        /// The degree of the coefficients given.
        found: usize,
    },
    /// Factors that are no stretch.
    #[error(
        "a stretch by {factors:?}: its factors must be above zero and within 1e6 of each other"
    )]
    Stretch {
        /// The factors given.
        factors: [f64; 3],
    },
    /// A number is not finite.
    #[error("{what} is not finite")]
    NotFinite {
        /// What the number is.
        what: String,
    },
    /// The radius is not above zero in some direction: the coefficients were changed, or the fit failed there.
    #[error("the radius is {radius:.3e} in the direction {direction:.3?}: it must be above zero")]
    NotPositive {
        /// The radius.
        radius: f64,
        /// The direction, in the scan's frame.
        direction: [f64; 3],
    },
    /// The radius could not be shown to be above zero everywhere.
    #[error(
        "the radius cannot be shown to be above zero everywhere; the least one met is {found:.3e}"
    )]
    Unproved {
        /// The least radius met.
        found: f64,
    },
    /// A surface turns over: its normal there does not point outside.
    #[error("the surface is folded in the direction {direction:.3?}")]
    Folded {
        /// The direction n, in the scan's frame.
        direction: [f64; 3],
    },
    /// A surface runs round the sphere of directions the wrong way.
    #[error("the surface is inside out: it encloses no volume")]
    InsideOut,
    /// Radii beyond 1e100, or below its inverse.
    #[error("radii are beyond 1e100 or below 1e-100: change the unit")]
    OutOfRange,
    /// Numbers that make no superquadrics.
    #[error(transparent)]
    Superquadric(#[from] InvalidSuperquadric),
    /// The axes are not orthonormal and right-handed.
    #[error("the axes are not orthonormal and right-handed")]
    Axes,
}

/// The degree of an expansion of a segment, if it is one.
pub(super) fn check_expansion(segment: usize, coefficients: &[f64]) -> Result<usize, InvalidGrain> {
    let root = coefficients.len().isqrt();
    if root == 0 || root * root != coefficients.len() {
        return Err(InvalidGrain::CoefficientCount {
            segment,
            found: coefficients.len(),
        });
    }
    if !coefficients.iter().all(|x| x.is_finite()) {
        return Err(InvalidGrain::NotFinite {
            what: format!("a coefficient of segment {segment}"),
        });
    }
    if root - 1 > Whole::MAX_DEGREE {
        return Err(InvalidGrain::Degree { found: root - 1 });
    }
    Ok(root - 1)
}
