//! Why a mesh has no map to the sphere.

use crate::digits::plural;
use crate::fit::context::Cancelled;
use crate::mesh::MeshDefect;

/// Why a mesh has no map to the sphere.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The triangles are not a closed, consistently wound manifold.
    #[error("the faces do not close: {0}")]
    NotClosed(#[from] MeshDefect),
    /// A vertex belongs to no triangle.
    #[error("vertex {vertex} belongs to no face")]
    UnusedVertex {
        /// Index of the vertex.
        vertex: u32,
    },
    /// Sheets of the surface touch in a vertex.
    #[error("the surface touches itself in vertex {vertex}, which belongs to several sheets of it")]
    PinchedVertex {
        /// Index of the vertex.
        vertex: u32,
    },
    /// There are several surfaces.
    #[error("the faces are {bodies} separate surfaces, and one grain has one")]
    SeveralBodies {
        /// Number of surfaces.
        bodies: usize,
    },
    /// The surface has handles.
    #[error(
        "the surface is not that of a ball but has {} (its genus), as a ring has one: fill them, for no surface over \
         the sphere has any",
        plural(*genus, "handle")
    )]
    Handles {
        /// Their number.
        genus: usize,
    },
    /// There are fewer than four vertices, a coordinate is not finite, or all vertices are in one place.
    #[error(
        "the faces enclose no body: at least four vertices with finite coordinates, not all in one place, do"
    )]
    NoBody,
    /// Faces are so thin or small that rounding leaves no place for a vertex.
    #[error(
        "numbers leave vertex {vertex} no place on the sphere: the faces round it are too thin; weld vertices that are \
         too close, or mesh the surface anew"
    )]
    NoKernel {
        /// Index of the vertex.
        vertex: u32,
    },
    /// The map found does not pass its check.
    #[error(
        "{flips} faces turn over on the sphere, which is covered {degree} times: weld vertices that are too close, or \
         mesh the surface anew"
    )]
    NotOneToOne {
        /// Triangles whose images have the other orientation.
        flips: usize,
        /// Sum of the solid angles over 4 pi.
        degree: f64,
    },
    /// The work was asked to stop.
    #[error("the fit was cancelled")]
    Cancelled,
}

impl From<Cancelled> for MapError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
