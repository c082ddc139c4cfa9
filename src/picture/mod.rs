//! Pictures of surfaces, points and lines without a window or a browser: a small software rasteriser.
//!
//! A [`Scene`] is seen by a [`Camera`] and [rendered](render) into an [`Image`], which takes labels and is written as
//! PNG. Views are orthographic, so that a scale bar is right everywhere. It knows nothing of grains.

mod camera;
mod colour;
mod image;
mod raster;
mod render;
mod scene;
mod text;

pub use camera::Camera;
pub use colour::{Colour, Ground, diverging, sequential};
pub use image::{Image, PngError};
pub use render::render;
pub use scene::{Corner, Dot, Line, Scene};
pub use text::{Anchor, Size};
