//! What a fitted grain is.

mod surface;

pub use surface::StarSurface;
