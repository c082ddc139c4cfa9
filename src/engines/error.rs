//! Why an engine is given nothing.

use super::kind::InvalidKind;
use crate::bed::{BedError, PaceError};
use crate::digits::given;

/// Why there is no deck.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidDeck {
    /// There is no grain, or no kind.
    #[error("there are no grains")]
    NoGrains,
    /// More spheres than a deck holds.
    #[error(
        "the spheres of all {grains} grains are more than {most}; ask for fewer grains or spheres"
    )]
    TooMany {
        /// Grains asked for.
        grains: usize,
        /// The most spheres.
        most: usize,
    },
    /// The grains of a bed are no spheres.
    #[error("engines take grains of spheres only")]
    NoSpheres,
    /// A kind of grain.
    #[error("one of the grains is none that engines take")]
    Kind(#[from] InvalidKind),
    /// The material of a bed.
    #[error(transparent)]
    Bed(#[from] BedError),
    /// Steps that are too many or too long.
    #[error(transparent)]
    Pace(#[from] PaceError),
    /// Two kinds have the same name.
    #[error("two of the grains have the same name")]
    SameName,
    /// A number of the material is out of its range.
    #[error("{what} must be {range}, not {}", given(*found))]
    Material {
        /// Which.
        what: &'static str,
        /// What it may be.
        range: &'static str,
        /// What it is.
        found: f64,
    },
}
