//! Why two surfaces have no contact by the theory of Hertz.

use crate::digits::significant;
use thiserror::Error;

/// Largest ratio A/B for which the correction is taken: the patch is then some 250 times longer than
/// wide, and a theory of line contact is the better one.
pub const LARGEST_RATIO: f64 = 1e4;

/// Why two surfaces do not touch as Hertz has it.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ContactError {
    /// The gap does not open in all directions: a hollow, a saddle or a flat side. They touch along a
    /// line or in several places.
    #[error(
        "by their curvatures the surfaces do not part in all directions from the point of contact ({} and {}, one relative to \
         the other); Hertz's theory needs a gap that opens", significant(*larger, 4), significant(*smaller, 4)
    )]
    NotConvex {
        /// The larger relative curvature A.
        larger: f64,
        /// The smaller one B.
        smaller: f64,
    },
    /// The gap opens [`LARGEST_RATIO`] times faster one way than the other.
    #[error(
        "the relative curvatures {} and {} are more than {LARGEST_RATIO} times apart: \
         a contact along a line, for which this theory is not made", significant(*larger, 4), significant(*smaller, 4)
    )]
    Line {
        /// The larger relative curvature A.
        larger: f64,
        /// The smaller one B.
        smaller: f64,
    },
    /// The curvature is not told from none, as of the ripples of a fit on a flat side, or is that by which it rounds an edge.
    #[error(
        "the gap between the surfaces is curved by {} with a standard error of {}, as where a fit ripples on a flat side or \
         rounds an edge: no force is vouched for", significant(*curvature, 3), significant(*error, 2)
    )]
    Uncertain {
        /// The smaller curvature of the gap, 2 B.
        curvature: f64,
        /// Its standard error.
        error: f64,
    },
    /// They overlap by so little beside the standard error of that that they may not touch.
    #[error(
        "the overlap of {} has a standard error of {}: the surfaces may as well be apart, and no force is vouched for",
        significant(*depth, 3), significant(*error, 2)
    )]
    Shallow {
        /// The overlap.
        depth: f64,
        /// Its standard error.
        error: f64,
    },
    /// The gap is curved in its middle as it is not over the contact.
    #[error(
        "where the surfaces touch, the gap between them is curved far {} over the rest of the contact, as {}: by the whole contact \
         the force would be {} times as large, so Hertz's theory does not hold; choose another place, {}",
        if *times > 1.0 { "more than" } else { "less than" },
        if *times > 1.0 { "beside an edge" } else { "on a flat side" },
        significant(*times, 2),
        if *times > 1.0 {
            "a model that rounds the edge (fit --segments 1), or, where the shared volume is told, --law volume"
        } else {
            "a smaller indentation, or, where the shared volume is told, --law volume"
        }
    )]
    Edge {
        /// How many times the force is that curvatures over the contact tell.
        times: f64,
    },
    /// The bodies would touch all over a side.
    #[error(
        "by their curvatures there the surfaces would touch as far as {} from the middle of the contact, and the body \
         reaches {} only: for Hertz's theory the surface is too flat, or the indentation too large",
        significant(*reach, 4), significant(*body, 4)
    )]
    Flat {
        /// How far from its middle the contact would reach.
        reach: f64,
        /// How far the smaller body reaches.
        body: f64,
    },
}
