//! Normal contact of two surfaces, or of a surface and a plane, by the theory of Hertz; and contacts of convex bodies
//! and of unions of them, which are found however they lie; and the [law] of their forces while they move.

mod convex;
mod edge;
mod force_error;
pub mod law;
mod material;
mod relative;
mod touch;

pub(crate) use convex::same_touch;
pub use convex::{
    ConvexContact, ConvexPair, ConvexStatus, Method, UnionContact, Warm, union_contacts,
};
pub use edge::{EdgeError, TangentCap};
pub use force_error::{Curved, force_error};
pub use material::{Material, MaterialError, effective_modulus_pa};
pub use relative::{ContactError, Correction, LARGEST_RATIO, RelativeCurvature};
pub use touch::{Touch, TouchError, touch};
