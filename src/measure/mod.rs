//! Area, volume, centroid and inertia of star-shaped surfaces and of meshes.

mod curvature;
mod extents;
mod grain;
mod integrals;
mod mass;
mod mesh;

pub use curvature::Curvature;
pub use extents::extents;
pub(crate) use grain::blended_properties;
pub use grain::grain_properties;
pub use integrals::{Integrals, MAX_EVALUATIONS, integrate};
pub use mass::{MassProperties, Moments, PrincipalInertia};
pub use mesh::{MeshIntegralError, mesh_properties};
