//! Normal contact of two surfaces, or of a surface and a plane, by the theory of Hertz; contacts of convex bodies and of
//! unions of them, which are found however they lie, and the [law] of their forces while they move; and all regions in
//! which surfaces of any kind overlap, followed while they move.
//!
//! ```
//! use grainform::contact::{ContactBody, contact_regions};
//! use grainform::nalgebra::{Isometry3, Vector3};
//! use grainform::{model::Radial, shapes::Ellipsoid};
//!
//! // Two balls of radius 1, their centres 1.9 apart.
//! let ball = Ellipsoid { semi_axes: Vector3::repeat(1.0) };
//! let ball = Radial(&ball);
//! let body = ContactBody::new(&ball);
//! let pose = Isometry3::translation(0.0, 0.0, 1.9);
//! let found = contact_regions(&body, &body, &pose)?;
//! assert!((found.regions[0].depth - 0.1).abs() < 1e-9);
//! # Ok::<(), grainform::contact::RegionError>(())
//! ```

mod convex;
mod edge;
mod error;
mod known;
pub mod law;
mod material;
mod over;
mod regions;
mod relative;
mod touch;
mod volume_law;

pub(crate) use convex::SAME_NORMAL;
pub use convex::{
    ConvexContact, ConvexPair, ConvexStatus, Method, UnionContact, Warm, is_one_inside,
    union_contacts,
};
pub use edge::{EdgeError, TangentCap};
pub use error::{ContactError, LARGEST_RATIO};
pub use known::{Curved, KnownContact, TOLD, told_depth};
pub use material::{Material, MaterialError, effective_modulus_pa};
pub use regions::{
    ContactBody, ContactPair, ContactPlace, ContactRegion, ContactRegions, RegionError, RegionWork,
    contact_gaps, contact_regions,
};
pub use relative::{Correction, RelativeCurvature};
pub use touch::{Touch, TouchError, reach, touch};
pub use volume_law::VolumeLaw;
