//! The source's model: k x k independent segments of the angle domain, each fitted to its own points.

mod held_out;
mod level;
mod levels;
mod reduce;
mod row;
mod search;
mod segment;
#[cfg(test)]
mod stability;

pub(crate) use held_out::{HeldOut, leave_one_out};
pub(crate) use level::{FittedLevel, LARGEST_MISS};
pub(crate) use levels::Levels;
pub(crate) use search::search;
pub(crate) use segment::SAMPLES_PER_COEFFICIENT;
