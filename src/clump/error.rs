//! Why there is no clump.

use crate::digits::{given, significant};

/// The most spheres of a clump.
pub const MOST_SPHERES: usize = 500;

/// Why there is no clump.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClumpError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    MissingVertex {
        /// Position of the triangle in the mesh.
        triangle: usize,
    },
    /// The number of spheres is out of range.
    #[error("a clump has 1 to {MOST_SPHERES} spheres, not {found}")]
    Count {
        /// The number asked for.
        found: usize,
    },
    /// The error asked for is no share above zero and below one.
    #[error("the error of a clump must be a share above zero and below one, not {}", given(*found))]
    Share {
        /// The share asked for.
        found: f64,
    },
    /// The error asked for is not reached.
    #[error(
        "the nearest clump found has {spheres} spheres and comes within {} % of the equivalent radius (RMS), not within {} %",
        significant(100.0 * reached, 3),
        significant(100.0 * asked, 3)
    )]
    NotReached {
        /// The share asked for.
        asked: f64,
        /// The least error found.
        reached: f64,
        /// The spheres of the clump that has it.
        spheres: usize,
    },
    /// The spheres cannot be given the volume of the grain, or the surface is not that of the grain.
    #[error(
        "the spheres, or the surface itself, would have a volume that is {} % off the grain's: is it one body, and the \
         surface its own?",
        significant(100.0 * excess, 3)
    )]
    Volume {
        /// Volume of the spheres, or inside the surface, over that of the grain, less one.
        excess: f64,
    },
    /// No ball was found inside: the mesh is open, encloses nothing or next to it, is wound inwards, or has a coordinate that
    /// is not finite.
    #[error(
        "no sphere was found inside the surface: is it closed, and wound counter-clockwise from outside?"
    )]
    NoInside,
}
