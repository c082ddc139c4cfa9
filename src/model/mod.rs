//! What a fitted grain is: evaluate, differentiate, mesh, save, load.

mod blended;
mod curvature_errors;
mod file;
mod frame;
mod grain;
mod least_radius;
mod load;
mod meshing;
mod mirrored;
mod published;
mod seams;
mod segmented;
mod stretch;
mod superquadric;
mod surface;
mod whole;

pub use blended::Blended;
pub use curvature_errors::CurvatureErrors;
pub use file::{ModelError, grain_from_json, grain_to_json};
pub use frame::Frame;
pub use grain::{Grain, InvalidGrain, Surface};
pub use least_radius::LeastRadius;
pub use load::{LoadError, load_grain};
pub use mirrored::Mirrored;
pub use published::{PublishedExpansion, Region};
pub use segmented::Segmented;
pub(crate) use stretch::Ray;
pub use stretch::Stretch;
pub(crate) use superquadric::Octant;
pub use superquadric::{EXPONENTS, InvalidSuperquadric, MultiSuperquadric, Part, Superquadric};
pub use surface::{Derivatives, StarSurface};
pub use whole::Whole;
