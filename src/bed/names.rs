//! Names in the folder of a bed.

/// What a bed goes on from.
pub(super) const STATE: &str = "state.json";

/// The folder of its frames.
pub(super) const FRAMES: &str = "frames";
