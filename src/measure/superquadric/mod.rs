//! Mass properties of superquadrics: volume, centroid and inertia in closed form, area by quadrature; those of unions
//! by quadrature over what is bare of each part.

mod bare;
mod moments;
mod octant;
mod patch;
mod single;
mod solid;
mod union;

pub use single::{SolidProperties, superquadric_properties};
pub use solid::solid_properties;
pub use union::union_properties;
