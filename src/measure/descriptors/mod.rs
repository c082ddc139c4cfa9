//! Numbers without a unit that describe a form.

pub(super) mod angularity;
pub(super) mod bounds;
pub(super) mod convexity;
pub(super) mod ellipsoid;
pub(super) mod form;
pub(super) mod spectrum;
pub(super) mod sphericity;
