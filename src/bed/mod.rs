//! Grains under gravity: dropped, they settle to a bed, of which it is told how densely it is packed and how it carries.
//!
//! All is in SI units. Grains are made of convex parts, superquadrics; where two of them touch is found with proof by
//! [`contact`](crate::contact), and what that does is its [law](crate::contact::law).

mod advance;
mod body;
mod encounter;
mod fabric;
mod field;
mod folder;
mod former;
mod grain;
mod link;
mod names;
mod neighbours;
mod pace;
mod packing;
mod paint;
#[cfg(feature = "cli")]
mod picture;
mod record;
mod rest;
mod resume;
mod settings;
mod settle;
mod start;
#[cfg(test)]
mod tests;
mod wall;
mod write;

pub use body::Body;
pub use fabric::{Fabric, Forces, GrainContact, Order, fabric};
pub use folder::{Folder, FolderError};
pub use grain::{GrainError, GrainKind};
#[cfg(feature = "cli")]
pub(crate) use names::{FILES, PICTURE, VTK};
pub(crate) use pace::check_pace;
pub use pace::{BED_STEPS, PaceError};
pub use packing::{Fraction, Layer, Packing, packing};
pub use paint::{PaintedGrain, painted};
#[cfg(feature = "cli")]
pub(crate) use picture::picture;
pub use rest::Rest;
pub use settings::{BED_GRAINS, BedError, BedSettings, Container};
pub use settle::Bed;
pub use wall::Wall;
pub use write::{write_dump, write_vtk};
