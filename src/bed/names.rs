//! Names in the folder of a bed.

/// What a bed goes on from.
pub(super) const STATE: &str = "state.json";

/// The folder of its frames.
pub(super) const FRAMES: &str = "frames";

/// The settled grains for ParaView.
pub(crate) const VTK: &str = "bed.vtk";

/// The picture of the settled grains.
pub(crate) const PICTURE: &str = "bed.png";

/// All that a bed writes, with the picture that is drawn of it.
#[cfg(feature = "cli")]
pub(crate) const FILES: [&str; 4] = [STATE, FRAMES, VTK, PICTURE];
