//! Why there is no clump.

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
    /// The error asked for is no share above zero.
    #[error("the error of a clump must be a share above zero, not {found}")]
    Share {
        /// The share asked for.
        found: f64,
    },
    /// The error asked for is not reached.
    #[error(
        "{MOST_SPHERES} spheres come within {:.2} % of the equivalent radius (RMS), not within {:.2} %",
        100.0 * reached,
        100.0 * asked
    )]
    NotReached {
        /// The share asked for.
        asked: f64,
        /// What the most spheres reach.
        reached: f64,
    },
    /// No ball was found inside: the mesh encloses nothing, is wound inwards, or has a coordinate that is not finite.
    #[error("no sphere was found inside the surface")]
    NoInside,
}
