//! Area, volume, inertia, size, form and curvature of star-shaped surfaces and of meshes, and how far one
//! surface is from another.

mod curvature;
mod extents;
mod grain;
mod integrals;
mod mass;
mod mesh;
mod support;

pub use curvature::Curvature;
pub use extents::extents;
pub(crate) use grain::blended_properties;
pub use grain::grain_properties;
pub use integrals::{Integrals, MAX_EVALUATIONS, integrate};
pub use mass::{MassProperties, Moments, PrincipalInertia};
pub use mesh::{MeshIntegralError, mesh_properties};
pub use support::{Support, support};
