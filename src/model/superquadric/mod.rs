//! Superquadrics: convex bodies of 5 to 12 numbers, and unions of them.
//!
//! A superquadric is the unit ball of two nested norms, see [`Superquadric`]; its eight octants may differ. The
//! gauge and the support function are both closed forms, and so contacts of superquadrics are cheap to find and to
//! prove.

mod connected;
mod gauge;
mod grain;
mod line;
mod multi;
mod norm;
mod outside;
mod record;
mod shape;
mod support;

pub use grain::SuperquadricGrain;
pub use multi::{MultiSuperquadric, Part};
pub(in crate::model) use record::PartRecord;
pub(crate) use shape::Octant;
pub use shape::{EXPONENTS, InvalidSuperquadric, Superquadric};
