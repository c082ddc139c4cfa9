//! Normal contact of two surfaces, or of a surface and a plane, by the theory of Hertz.

mod edge;
mod material;
mod relative;
mod touch;

pub use edge::{EdgeError, TangentCap};
pub use material::{Material, MaterialError, effective_modulus_pa};
pub use relative::{ContactError, Correction, LARGEST_RATIO, RelativeCurvature};
pub use touch::{Touch, TouchError, touch};
