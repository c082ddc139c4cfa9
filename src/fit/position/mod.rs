//! The position of a surface's points over the sphere, fitted to a scan: for surfaces that no centre sees.

pub(crate) mod map;
