//! What the examples on Chapter 3 of Radvilaite 2016 share.

pub(crate) mod reference;
pub(crate) mod search;
pub(crate) mod study;
