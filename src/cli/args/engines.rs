//! The arguments of what other engines take: clumps and their inputs.

use super::{InputArgs, OUTPUT};
use crate::cli::values::share;
use crate::report::Unit;
use clap::Args;
use std::path::PathBuf;

/// How many spheres a clump has.
#[derive(Args)]
pub(in crate::cli) struct SpheresArgs {
    /// Number of spheres, 1 to 500; fewer where more bring nothing
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub(in crate::cli) spheres: usize,

    /// Take the fewest spheres found that come within this share of the equivalent radius (RMS), such as 2%
    #[arg(long, value_name = "E%", value_parser = share, conflicts_with = "spheres")]
    pub(in crate::cli) error: Option<f64>,
}

/// Make a grain of overlapping spheres, for engines that know no other shape
///
/// Balls of the grain's medial axis are chosen, fitted to its surface, and made larger or smaller by the same length
/// until the clump has the volume of the grain. Mass, centre and inertia told are those of the grain.
#[derive(Args)]
pub(in crate::cli) struct ClumpArgs {
    /// A model written by `fit`, or a scan; the content decides
    #[arg(value_name = "MODEL.json|SCAN")]
    pub(in crate::cli) path: PathBuf,

    #[command(flatten)]
    pub(in crate::cli) spheres: SpheresArgs,

    /// Write the clump here: .json (as --json prints it) or .csv (x, y, z, r)
    #[arg(short, long, value_name = "FILE", help_heading = OUTPUT)]
    pub(in crate::cli) output: Option<PathBuf>,

    /// Unit of the scan's lengths, told beside them: um, mm, cm or m
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    /// Print one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
