//! Why no superquadric is fitted.

use crate::fit::context::Cancelled;

/// Why no superquadric is fitted.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SuperquadricFitError {
    /// There are fewer points than three for each number.
    #[error("{points} points are too few for {parameters} numbers; there must be {least} at least")]
    TooFewPoints {
        /// Points given.
        points: usize,
        /// Numbers to be found.
        parameters: usize,
        /// Points needed.
        least: usize,
    },
    /// A coordinate is not finite.
    #[error("point {index} is not finite; remove it from the scan")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// The points lie in a plane, or are all the same.
    #[error("the points lie in one plane and enclose no volume")]
    NoVolume,
    /// No parts, or too many.
    #[error("{parts} parts are asked for; there must be from 1 to {most}")]
    Parts {
        /// Parts asked for.
        parts: usize,
        /// The most there can be.
        most: usize,
    },
    /// The numbers that were found make no body.
    #[error("no body comes near the points: {0}")]
    NoBody(#[from] crate::model::InvalidSuperquadric),
    /// The fit was asked to stop.
    #[error("the fit was cancelled")]
    Cancelled,
}

impl From<Cancelled> for SuperquadricFitError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
