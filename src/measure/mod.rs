//! Area, volume, inertia, size, form and curvature of surfaces and of meshes, and how far one
//! surface is from another.

mod angularity;
mod bounds;
mod clearance;
mod convex_polygon;
mod convexity;
mod corners;
mod crossings;
mod curvature;
mod curvature_kind;
mod curvature_statistics;
mod deviation;
mod elements;
mod ellipsoid;
mod enclosing_ball;
mod even_places;
mod extents;
mod feet;
mod form;
mod four_triangles;
mod hull;
mod inscribed_ball;
mod integrals;
mod largest_ball;
mod mass;
mod medial;
mod mesh;
mod minimum_box;
mod nodes;
mod oriented_box;
mod outline;
mod peaks;
mod projection;
mod reach;
mod rings;
mod roundness;
mod sag;
mod scale;
mod scanned;
mod seen;
mod self_crossing;
mod shortened;
mod silhouette;
mod slits;
#[cfg(feature = "cli")]
mod smoothed;
mod spectrum;
mod sphericity;
mod sums;
mod superquadric;
mod support;
mod survey;
#[cfg(test)]
mod trial;
mod triangle_tree;
mod unfollowed;

pub use bounds::OutOfBounds;
pub use convexity::Convexity;
pub(crate) use crossings::sound_crossings;
pub use crossings::{MissingVertex, crossings};
pub use curvature::Curvature;
pub use curvature_statistics::{CurvatureStatistics, Distribution};
pub use deviation::Deviation;
pub use ellipsoid::EquivalentEllipsoid;
pub use enclosing_ball::{Ball, EnclosingBallError, enclosing_ball};
pub(crate) use even_places::{EvenPlace, even_places};
#[cfg(feature = "cli")]
pub(crate) use extents::box_along;
pub use extents::extents;
pub(crate) use extents::extents_of_points;
pub use feet::{Foot, feet};
pub use form::{Form, SideRatios};
pub use four_triangles::four_triangles;
pub use hull::{HullError, convex_hull};
pub use inscribed_ball::{InscribedBallError, inscribed_ball};
pub use integrals::{grain_properties, integrate};
pub use mass::{MassProperties, Moments, PrincipalInertia};
pub(crate) use mass::{are_apart, inertia};
pub(crate) use medial::medial_balls;
pub use mesh::{MeshIntegralError, mesh_properties};
pub use minimum_box::minimum_box;
pub use oriented_box::OrientedBox;
pub use outline::Outline;
pub use projection::{ProjectionError, project};
pub use roundness::ROUNDNESS_ORDER;
pub(crate) use scale::Scale;
pub use scanned::{FacesDefect, Fill, ScannedBody, scanned_body};
pub(crate) use scanned::{LeftOut, are_steps, largest_part, share_of_area, spikes, without_dust};
pub use self_crossing::SelfCrossing;
pub(crate) use self_crossing::self_crossing;
#[cfg(feature = "cli")]
pub(crate) use smoothed::smoothed_area;
pub use spectrum::{EXPANSION_DEGREE, RadialExpansion, SPECTRUM_DEGREE, Spectrum};
pub(crate) use sphericity::equivalent_radius;
pub use sphericity::{Sphericity, wadell};
pub use sums::{Integrals, MAX_EVALUATIONS};
pub use superquadric::{
    SolidProperties, solid_properties, superquadric_properties, union_properties,
};
pub(crate) use support::support_near;
pub use support::{Support, support};
pub(crate) use survey::Measured;
pub use survey::{BoxErrors, CurvatureErrors, OutlineErrors, Scheme, Survey, SurveyError};
pub(crate) use triangle_tree::TriangleTree;
