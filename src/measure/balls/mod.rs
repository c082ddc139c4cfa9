//! Balls round a body, in it, and along its medial axis.

pub(super) mod clearance;
pub(super) mod enclosing_ball;
pub(super) mod inscribed_ball;
pub(super) mod largest_ball;
pub(super) mod medial;
