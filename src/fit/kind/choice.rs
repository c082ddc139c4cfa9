//! Why a grain is of its kind, a radius or positions.

use crate::fit::error::FitError;

/// Why a grain is of its kind.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum KindChoice {
    /// A radius follows the scan.
    Star,
    /// It was asked for.
    Asked,
    /// A radius would hide too large a share of the area.
    Hidden {
        /// The share.
        share: f64,
    },
    /// No radius follows the points.
    NoRadius,
    /// The scan is of voxels, whose steps a radius would follow.
    Voxels,
    /// The position of points is better than a radius, which was fitted too.
    Compared {
        /// The position.
        kept: Rival,
        /// The radius.
        rival: Rival,
    },
    /// A radius, for the position of points cannot be better.
    Outdoes {
        /// The radius.
        kept: Rival,
        /// The coefficients of the positions, and the least distance that they come to.
        forecast: Rival,
    },
    /// A radius, for no positions can be fitted.
    NoPositions(Box<FitError>),
}

/// A surface that was compared with another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rival {
    /// Coefficients.
    pub coefficients: usize,
    /// Root mean square of the distances of points that were held out, along the normals, in the scan's unit.
    pub rms: f64,
}
