//! Area, volume, inertia, size, form and curvature of surfaces and of meshes, and how far one
//! surface is from another.

mod balls;
mod boxes;
mod convex_polygon;
mod crossings;
mod curvature;
mod descriptors;
mod deviation;
mod even_places;
mod feet;
mod hull;
mod integrals;
mod outline;
mod scale;
mod scanned;
mod seen;
mod self_crossing;
mod shortened;
#[cfg(feature = "cli")]
mod smoothed;
mod superquadric;
mod support;
mod survey;
#[cfg(test)]
mod trial;
mod triangle_tree;

pub use balls::enclosing_ball::{Ball, EnclosingBallError, enclosing_ball};
pub use balls::inscribed_ball::{InscribedBallError, inscribed_ball};
pub(crate) use balls::medial::medial_balls;
#[cfg(feature = "cli")]
pub(crate) use boxes::extents::box_along;
pub use boxes::extents::extents;
pub(crate) use boxes::extents::extents_of_points;
pub use boxes::minimum_box::minimum_box;
pub use boxes::oriented_box::OrientedBox;
pub(crate) use crossings::sound_crossings;
pub use crossings::{MissingVertex, crossings};
pub use curvature::Curvature;
pub use curvature::statistics::{CurvatureStatistics, Distribution};
pub use descriptors::bounds::OutOfBounds;
pub use descriptors::convexity::Convexity;
pub use descriptors::ellipsoid::EquivalentEllipsoid;
pub use descriptors::form::{Form, SideRatios};
pub use descriptors::spectrum::{EXPANSION_DEGREE, RadialExpansion, SPECTRUM_DEGREE, Spectrum};
pub(crate) use descriptors::sphericity::equivalent_radius;
pub use descriptors::sphericity::{Sphericity, wadell};
pub use deviation::Deviation;
pub(crate) use even_places::{EvenPlace, even_places};
pub use feet::{Foot, feet};
pub use hull::{HullError, convex_hull};
pub use integrals::four_triangles::four_triangles;
pub use integrals::mass::{MassProperties, Moments, PrincipalInertia};
pub(crate) use integrals::mass::{are_apart, inertia};
pub use integrals::mesh::{MeshIntegralError, mesh_properties};
pub use integrals::sums::{Integrals, MAX_EVALUATIONS};
pub use integrals::{grain_properties, integrate};
pub use outline::Outline;
pub use outline::projection::{ProjectionError, project};
pub use outline::roundness::ROUNDNESS_ORDER;
pub(crate) use scale::Scale;
pub use scanned::{FacesDefect, Fill, ScannedBody, scanned_body};
pub(crate) use scanned::{LeftOut, are_steps, largest_part, share_of_area, spikes, without_dust};
pub use self_crossing::SelfCrossing;
pub(crate) use self_crossing::self_crossing;
#[cfg(feature = "cli")]
pub(crate) use smoothed::smoothed_area;
pub use superquadric::{
    SolidProperties, solid_properties, superquadric_properties, union_properties,
};
pub(crate) use support::support_near;
pub use support::{Support, support};
pub(crate) use survey::Measured;
pub use survey::{BoxErrors, CurvatureErrors, OutlineErrors, Scheme, Survey, SurveyError};
pub(crate) use triangle_tree::TriangleTree;
