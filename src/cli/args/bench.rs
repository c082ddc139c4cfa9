//! The arguments of `grainform bench`.

use super::{InputArgs, OUTPUT, RUN};
use crate::report::Unit;
use clap::Args;
use std::path::PathBuf;

/// Measure run time against error over many settings
///
/// Families, on one thread: whole-surface fits of degree 1 to 20 and 1 x 1 to 16 x 16 segments of degree 0 to 6, both fitted to the
/// points (fit --seams none); 6 to 150 blended cells of degree 1 to 5; adaptive cells (fit) and the estimate itself (fit --segments 1),
/// within tolerances of 1 % to 0.02 % of the mean radius; and one superquadric of 5, 8 or 12 numbers. Seconds are the processor's, the
/// least of three runs or more, of preparing the scan and fitting it; bench.csv has a column for each. Printed are the settings with
/// the least held-out RMS for their coefficients, their seconds or the nanoseconds of one evaluation.
#[derive(Args)]
#[command(mut_args(|arg| match arg.get_id().as_str() {
    "label" | "format" | "max_bytes" => arg.requires("scans"),
    _ => arg,
}))]
pub(in crate::cli) struct BenchArgs {
    /// Scans [default: a synthetic bean, chickpea and maize kernel, clean and noisy, whose truth is
    /// known]
    #[arg(value_name = "SCAN")]
    pub(in crate::cli) scans: Vec<PathBuf>,

    /// Write bench.csv and the plots into this folder
    #[arg(short, long, value_name = "DIR", default_value = "bench", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Beside ducc0's least-squares fits of the whole sphere, of degree 1 to 40, where python3 has ducc0 and numpy
    /// (python3 -m pip install ducc0 numpy): one point in ten is hidden from all fits and judges them. ducc0 is given the
    /// centre, and for each degree the solver's tolerance and iterations that suit it best
    #[arg(long, help_heading = RUN)]
    pub(in crate::cli) rivals: bool,

    /// Print all rows as one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    /// Unit of the scans' lengths, told in the object: nm, um, mm, cm, dm, m or inch
    #[arg(long, value_name = "UNIT", requires_all = ["json", "scans"], help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
