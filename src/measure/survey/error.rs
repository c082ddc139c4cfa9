//! Why something cannot be measured.

use crate::measure::scanned::FacesDefect;
use crate::measure::{
    EXPANSION_DEGREE, EnclosingBallError, HullError, InscribedBallError, MeshIntegralError,
    OutOfBounds, ProjectionError,
};
use crate::mesh::MeshDefect;
use thiserror::Error;

/// Why something cannot be measured.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// The points have no convex hull.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// The mesh, or the hull, encloses nothing.
    #[error(transparent)]
    Mesh(#[from] MeshIntegralError),
    /// The mesh is not closed, or broken.
    #[error(transparent)]
    NotClosed(#[from] MeshDefect),
    /// The faces of the scan do not say what is inside.
    #[error(transparent)]
    Faces(#[from] FacesDefect),
    /// It is a measure of one body, and there are several.
    #[error("it is a measure of one body, and these are {bodies}")]
    Several {
        /// Number of bodies.
        bodies: usize,
    },
    /// The points have no enclosing sphere.
    #[error(transparent)]
    Enclosing(#[from] EnclosingBallError),
    /// There is no inscribed sphere.
    #[error(transparent)]
    Inscribed(#[from] InscribedBallError),
    /// The body has no outline.
    #[error("seen along its {along}: {source}")]
    Projection {
        /// "length", "width" or "thickness".
        along: &'static str,
        /// Why.
        source: ProjectionError,
    },
    /// The second moments are not those of a solid: an open or inside-out mesh.
    #[error("its moments are not those of a solid")]
    NotSolid,
    /// A ratio is outside of its range.
    #[error(transparent)]
    OutOfBounds(#[from] OutOfBounds),
    /// Rays from the centroid meet the surface more than once.
    #[error(
        "{:.1} % of the directions from its centroid meet the surface more than once, or not at all",
        100.0 * share
    )]
    NotStarShaped {
        /// Share of the full solid angle.
        share: f64,
    },
    /// An expansion of so high a degree is not told.
    #[error("degree {found}; at most {EXPANSION_DEGREE} is allowed")]
    Degree {
        /// The degree asked for.
        found: usize,
    },
    /// It is made of radii, which the model does not have.
    #[error("it is made from radii, and this model is not one of a star-shaped body")]
    NoRadius,
    /// Its surface is not one over the directions from its centre.
    #[error(
        "in {:.1} % of the directions the union of superquadrics hides a part of its surface from its centre",
        100.0 * share
    )]
    Hidden {
        /// Share of the directions.
        share: f64,
    },
    /// The figure is too large or too small for a number of 64 bits.
    #[error("in this unit it is beyond the range of numbers: change the unit")]
    OutOfRange,
    /// Much of the curvature lies on edges and creases, where it has no bound.
    #[error("on edges and creases the curvature has no bound, and {:.0} % of it is missed there", 100.0 * missed)]
    Edges {
        /// Share of the total curvature.
        missed: f64,
    },
    /// Triangles have no curvature.
    #[error("triangles have no curvature: fit the scan, and measure the model")]
    Flat,
}
