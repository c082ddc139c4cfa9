//! Area, volume, inertia, size, form and curvature of star-shaped surfaces and of meshes, and how far one
//! surface is from another.

mod clearance;
mod convex_polygon;
mod curvature;
mod deviation;
mod enclosing_ball;
mod extents;
mod four_triangles;
mod grain;
mod hull;
mod inscribed_ball;
mod integrals;
mod mass;
mod mesh;
mod minimum_box;
mod outline;
mod projection;
mod roundness;
mod support;

pub use curvature::Curvature;
pub use deviation::Deviation;
pub use enclosing_ball::{Ball, EnclosingBallError, enclosing_ball};
pub use extents::extents;
pub use four_triangles::four_triangles;
pub use grain::grain_properties;
pub(crate) use grain::{blended_properties, mirrored_properties};
pub use hull::{HullError, convex_hull};
pub use inscribed_ball::{InscribedBallError, inscribed_ball};
pub use integrals::{Integrals, MAX_EVALUATIONS, integrate};
pub use mass::{MassProperties, Moments, PrincipalInertia};
pub use mesh::{MeshIntegralError, mesh_properties};
pub use minimum_box::{OrientedBox, box_along, minimum_box};
pub use outline::Outline;
pub use projection::{OUTLINE_AZIMUTHS, ProjectionError, project};
pub use roundness::ROUNDNESS_ORDER;
pub use support::{Support, support};
