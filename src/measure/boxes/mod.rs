//! Boxes round a body, and its sizes along them.

pub(super) mod extents;
pub(super) mod minimum_box;
pub(super) mod oriented_box;
pub(super) mod reach;
pub(super) mod sag;
