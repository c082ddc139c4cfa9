//! What a fitted grain is: evaluate, differentiate, mesh, save, load.

mod blend;
mod blended;
mod contradicted;
mod curvature_errors;
mod family;
mod file;
mod frame;
mod grain;
mod invalid;
mod least_radius;
mod load;
mod mirrored;
mod position;
mod position_grain;
mod published;
mod ray;
mod seams;
mod segmented;
mod segments;
mod star_grain;
mod star_surface;
mod stretch;
mod superquadric;
mod surface;
mod tiling;
mod unseen;
mod whole;

pub use blended::Blended;
pub use contradicted::Contradicted;
pub use curvature_errors::CurvatureErrors;
pub use family::Family;
pub use file::{ModelError, grain_from_json, grain_to_json};
pub use frame::Frame;
pub use grain::Grain;
pub use invalid::InvalidGrain;
pub use least_radius::LeastRadius;
pub use load::{LoadError, load_grain};
pub use mirrored::Mirrored;
pub(crate) use position::area_normal;
pub use position::{Position, PositionDerivatives};
pub use position_grain::PositionGrain;
pub use published::{PublishedExpansion, Region};
pub use segmented::Segmented;
pub use star_grain::StarGrain;
pub use star_surface::{Derivatives, Radial, StarSurface};
pub use stretch::Stretch;
pub(crate) use superquadric::Octant;
pub use superquadric::{
    EXPONENTS, InvalidSuperquadric, MultiSuperquadric, Part, Superquadric, SuperquadricGrain,
};
pub use surface::{Node, Surface, SurfaceElement, SurfaceJet};
pub use tiling::Tiling;
pub(crate) use tiling::{Parts, Piece};
pub use unseen::Unseen;
pub use whole::Whole;
