//! Holes between the points of a scan: [how large the largest cap without points is](empty_caps), and whether chance leaves such
//! caps; whether one is [wide in space](wide), too; [what is told of it](gap); what it [may hide](hidden) of a surface that goes
//! on over it, and what figures are worth where [so much was not seen](unseen) that the surface there is a guess.

mod empty_caps;
mod gap;
mod hidden;
mod unseen;
mod wide;

pub(super) use empty_caps::{largest_gap, random_gap};
pub(super) use gap::Gap;
pub(super) use hidden::Holes;
