//! What a fitted grain is: evaluate, differentiate, mesh, save, load.

mod file;
mod frame;
mod grain;
mod meshing;
mod published;
mod seams;
mod surface;

pub use file::{LoadError, parse_grain, save_grain};
pub use frame::Frame;
pub use grain::{Grain, InvalidGrain};
pub use published::PublishedSegment;
pub use surface::StarSurface;
