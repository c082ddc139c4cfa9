//! grainform turns the 3D scan of a grain into a small analytic surface and tells how good it is.
//!
//! Data flows one way, and each step is a module that can be read alone:
//!
//! ```text
//! scan -> fit -> model -> measure -> export / report
//!                  \-> contact -> bed
//!                  \-> clump -> engines
//! ```
//!
//! Arrows are data: `fit` also measures what it has fitted, and `measure` knows nothing of `fit`. A scan of many grains is first
//! [split](scan::split).
//!
//! # Conventions
//!
//! * **Angles**: polar angle theta in \[0, pi\] from +z, azimuth phi in \[0, 2 pi) from +x, so that
//!   x = r sin(theta) cos(phi), y = r sin(theta) sin(phi), z = r cos(theta).
//! * **Lengths** are in the scan's own unit; areas and volumes in its square and cube. No unit is
//!   ever guessed.
//! * **Density** is one: a moment of inertia is in the scan's unit to the fifth power.

pub mod annotate;
#[cfg(feature = "cli")]
mod batch;
pub mod bed;
#[cfg(feature = "cli")]
pub mod bench;
mod buckets;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod clump;
pub mod contact;
mod digits;
mod disjoint_sets;
mod elliptic;
pub mod engines;
pub mod export;
mod farthest;
pub mod fit;
pub mod measure;
pub mod mesh;
pub mod model;
#[cfg(feature = "cli")]
mod page;
#[cfg(feature = "cli")]
mod picture;
mod planes;
mod polygon_hull;
#[cfg(feature = "cli")]
mod portrait;
mod predicates;
pub mod report;
pub mod scan;
pub mod shapes;
pub mod sphere;
mod spread;
mod unit;
mod vectorize;

pub use export::save_grain;
pub use fit::{FitError, FitOptions, Fitted, Seams, Tolerance, fit};
pub use mesh::Mesh;
pub use model::{Grain, StarGrain, StarSurface, Surface, load_grain};
/// The vectors and matrices of this library's functions.
pub use nalgebra;
pub use scan::Scan;

/// Compiles the examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
