//! What the points of a cloud tell by themselves, before anything is fitted to them.

pub(super) mod close_pairs;
pub(super) mod neighbours;
pub(super) mod quadric;
pub(super) mod repeated;
pub(super) mod rounder;
pub(super) mod scatter;
pub(super) mod slope;
pub(super) mod without;
