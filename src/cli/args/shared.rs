//! The arguments that several commands share.

use super::{OUTPUT, RUN, SEARCH};
use crate::cli::numbers::{bytes, count, label, resolution};
use crate::cli::values::{Auto, ScanFormat, SeamsArg, tolerance};
use crate::fit::Tolerance;
use crate::report::Unit;
use crate::sphere::Symmetry;
use clap::Args;
use std::path::PathBuf;

/// Cells per edge of the cube of directions.
const DEFAULT_RESOLUTION: u16 = 64;

/// Bounds of what is read.
#[derive(Args)]
pub(in crate::cli) struct LimitArgs {
    /// The most bytes to read of an input, packed or unpacked; k, M and G stand for thousands, millions and
    /// billions
    #[arg(long, value_name = "N", default_value = "1G", value_parser = bytes, help_heading = RUN)]
    pub(in crate::cli) max_bytes: u64,
}

/// How scans are read.
#[derive(Args)]
pub(in crate::cli) struct InputArgs {
    /// The label of the grain in a segmented volume that has several
    #[arg(long, value_name = "K", value_parser = label, help_heading = RUN)]
    pub(in crate::cli) label: Option<i64>,

    /// Format of the scan, where its content does not tell: ply, stl, obj or xyz [default: that of its extension]
    #[arg(long, value_name = "FORMAT", help_heading = RUN)]
    pub(in crate::cli) format: Option<ScanFormat>,

    #[command(flatten)]
    pub(in crate::cli) limit: LimitArgs,
}

/// What `fit` and `search` share.
#[derive(Args)]
pub(in crate::cli) struct FittingArgs {
    /// The scan: PLY, STL, OBJ or XYZ, or a segmented volume: NRRD, MetaImage, NIfTI, a TIFF stack or .npy; packed with
    /// gzip or not (- for standard input)
    #[arg(value_name = "SCAN")]
    pub(in crate::cli) scan: PathBuf,

    /// Of several bodies in the scan, fit the largest
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) largest: bool,

    /// How segments are joined: blended (overlapping cells, fitted together) or none (k x k
    /// independent segments of the angle domain, with steps between them)
    #[arg(long, value_name = "blended|none", default_value = "blended", help_heading = SEARCH)]
    pub(in crate::cli) seams: SeamsArg,

    /// Mirror planes of the grain, told by the scan's axes normal to them, such as z or xyz: one
    /// expansion is fitted to a half, a quarter or an octant, and mirrored. The planes go through the
    /// centre; turn the scan beforehand if its axes are not those of the grain
    #[arg(long, value_name = "AXES|none", default_value_t = Symmetry::NONE, help_heading = SEARCH)]
    pub(in crate::cli) symmetry: Symmetry,

    /// Degree of every segment's expansion, or auto to search. Of positions also that of the whole sphere, which is tried
    /// before cells
    #[arg(long, value_name = "L|auto", default_value = "auto", help_heading = SEARCH)]
    pub(in crate::cli) degree: Auto,

    /// Number of segments: 1 for the estimate itself, one expansion of the whole sphere; 6 n^2 blended cells; or
    /// k^2 independent segments. adaptive (or auto) splits cells where the shape asks for it, or searches all k
    #[arg(long, value_name = "N|adaptive", default_value = "adaptive", help_heading = SEARCH)]
    pub(in crate::cli) segments: Auto,

    /// Largest degree searched: bounds the cost of an evaluation [default: 4 in blended cells, else 3; of positions 7 on
    /// the whole sphere, which is tried before cells, and 3 in these]
    #[arg(long, value_name = "L", value_parser = count::<usize>, help_heading = SEARCH)]
    pub(in crate::cli) max_degree: Option<usize>,

    /// Largest number of segments searched [default: 600 blended, 100 independent]
    #[arg(long, value_name = "N", value_parser = count::<usize>, help_heading = SEARCH)]
    pub(in crate::cli) max_segments: Option<usize>,

    /// RMS difference from the estimate that is good enough: a length in the scan's unit, a share of the mean
    /// radius such as 0.3%, or auto (0.03%); a third of the estimate's own standard deviation always
    /// is, a quarter to a half where what is left of the points is detail
    #[arg(long, value_name = "T|auto", default_value = "auto", value_parser = tolerance,
          help_heading = SEARCH)]
    pub(in crate::cli) tolerance: Tolerance,

    /// Threads, 0 for all cores; at most 4 per core are used, and the result does not depend on it
    #[arg(long, value_name = "N", value_parser = count::<usize>, default_value_t = 0, help_heading = RUN)]
    pub(in crate::cli) threads: usize,

    /// Print one JSON object, warnings included
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    /// Tell on standard error what was fitted and skipped, and how long it took
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) stats: bool,

    /// Unit of the scan's lengths, told beside them: nm, um, mm, cm, dm, m or inch; without it, what its file says
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}

/// How meshes are made.
#[derive(Args)]
pub(in crate::cli) struct MeshingArgs {
    /// Cells N along each edge of a cube of directions: 6 N^2 + 2 vertices, 12 N^2 triangles; at most 2886, or
    /// 1348 of VTP, of GLB and of the PLY that `mesh` writes, which takes 4 GB of memory
    #[arg(long, value_name = "N", default_value_t = DEFAULT_RESOLUTION, help_heading = OUTPUT,
          value_parser = resolution)]
    pub(in crate::cli) resolution: u16,
}
