//! Pictures of surfaces, points and lines without a window or a browser: a small software rasteriser.
//!
//! A [`Scene`] is seen by a [`Camera`] and [rendered](mod@render) into an [`Image`], which takes labels and is written as
//! PNG. Views are orthographic, so that a scale bar is right everywhere. It knows nothing of grains.

mod camera;
mod colour;
mod image;
mod raster;
mod render;
mod scene;
mod text;

pub(crate) use camera::Camera;
pub(crate) use colour::{Colour, GROUND, INK, diverging, sequential};
pub(crate) use image::Image;
pub(crate) use render::render;
pub(crate) use scene::{Corner, Dot, Line, Scene};
pub(crate) use text::{Anchor, Size};
