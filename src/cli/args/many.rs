//! The arguments of commands for many grains.

use super::{InputArgs, LimitArgs, OUTPUT, RUN, SEARCH};
use crate::cli::numbers::count;
use crate::cli::values::{Auto, tolerance};
use crate::fit::Tolerance;
use crate::report::{Measure, Unit};
use clap::Args;
use std::path::PathBuf;

/// Split a scan of many grains into a file for each
///
/// Of a mesh, a grain is what shares no point with the rest, with its hollows. Of a cloud, the plane that grains lie on is left out, and
/// a grain is what hangs together by the distances between its points; grains that touch are cut apart at their neck.
/// Of a segmented volume, a grain is what has one label and hangs together by faces of voxels. What is too small for a grain is dust. Files are numbered by where the grains lie, or in the order of the labels, and keep the frame of the scan.
#[derive(Args)]
pub(in crate::cli) struct SplitArgs {
    /// The scan: PLY, STL, OBJ or XYZ, or a segmented volume: NRRD, MetaImage, NIfTI, a TIFF stack or .npy; packed with
    /// gzip or not (- for standard input)
    #[arg(value_name = "SCAN")]
    pub(in crate::cli) scan: PathBuf,

    /// Write the grains into this folder, as grain_0001.ply and so on; those of a volume as .nrrd, which are measured as
    /// the voxels that they are
    #[arg(short, long, value_name = "DIR", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Cut no cloud at a neck: for grains that have a waist themselves
    #[arg(long)]
    pub(in crate::cli) uncut: bool,

    /// Unit of the scan's lengths, told beside them: nm, um, mm, cm, dm, m or inch
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    /// Threads, 0 for all cores; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = count::<usize>, default_value_t = 0, help_heading = RUN)]
    pub(in crate::cli) threads: usize,

    /// Print one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}

/// Fit and measure many scans: a row for each, and what they are like together
///
/// Writes results.csv and results.parquet (the same rows), summary.json and seconds.csv. A run that was stopped goes on
/// where it was when it is started again: what an earlier run found for the same scan and the same settings is kept, in
/// journal.jsonl. A scan that cannot be fitted is told with its reason and stops nothing. Of a segmented volume each label
/// is a row, such as ct.nrrd#3.
#[derive(Args)]
pub(in crate::cli) struct BatchArgs {
    /// Scans; folders of scans, also within each other; patterns in quotes, such as 'lot*/*.ply'; or @list.txt, a path
    /// per line, but for lines that begin with #
    #[arg(value_name = "PATH", required = true)]
    pub(in crate::cli) paths: Vec<PathBuf>,

    /// Write the results into this folder
    #[arg(short, long, value_name = "DIR", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Save the models too, in the folder models
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) models: bool,

    /// Save meshes of the models too, in the folder meshes
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) meshes: bool,

    /// Measure these only, separated by commas, see `grainform measure --help`
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(in crate::cli) only: Vec<Measure>,

    /// How near the segments of a fit are to its estimate, see `grainform fit --help`
    #[arg(long, value_name = "T|auto", default_value = "auto", value_parser = tolerance)]
    pub(in crate::cli) tolerance: Tolerance,

    /// Number of segments, see `grainform fit --help`
    #[arg(long, value_name = "N|adaptive", default_value = "adaptive")]
    pub(in crate::cli) segments: Auto,

    /// Of several bodies in a scan, fit the largest
    #[arg(long)]
    pub(in crate::cli) largest: bool,

    /// Unit of the scans' lengths, told beside them: nm, um, mm, cm, dm, m or inch; without it, what their files say
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    /// Grains that are worked on at the same time, 0 for one per core; at most 4 per core are, and the results do not
    /// depend on it
    #[arg(long, value_name = "N", value_parser = count::<usize>, default_value_t = 0, help_heading = RUN)]
    pub(in crate::cli) jobs: usize,

    #[command(flatten)]
    pub(in crate::cli) limit: LimitArgs,
}

/// Compare two lots of grains: difference and effect size of every measure, with intervals
#[derive(Args)]
pub(in crate::cli) struct CompareArgs {
    /// Results of `batch`: its folder, results.parquet or results.csv
    #[arg(value_name = "RESULTS")]
    pub(in crate::cli) first: PathBuf,

    /// Results of the other lot
    #[arg(value_name = "OTHER")]
    pub(in crate::cli) second: PathBuf,

    /// Print one JSON object, warnings included
    #[arg(long)]
    pub(in crate::cli) json: bool,
}

/// Write a page about scans, models and results that opens in any browser
///
/// One file that needs nothing else. Of a scan, which is fitted, or a model: the surface, to be turned, in colours that
/// tell how far the scan is off, or the curvature; maps over the angles; measures with standard errors and definitions.
/// Of a folder of results: a table that can be sorted, distributions, any two measures against each other, and every
/// grain whose model `batch --models` has saved.
#[derive(Args)]
pub(in crate::cli) struct ReportArgs {
    /// Scans, models written by `fit`, and folders of results of `batch`
    #[arg(value_name = "SCAN|MODEL.json|RESULTS", required = true)]
    pub(in crate::cli) paths: Vec<PathBuf>,

    /// Write the page here
    #[arg(short, long, value_name = "REPORT.html", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Write a picture of the grain here
    #[arg(long, value_name = "OUT.png", help_heading = OUTPUT)]
    pub(in crate::cli) png: Option<PathBuf>,

    /// Compare results with what is known of their grains: a table whose first column names the files of scans, and whose
    /// others are named as those of results.csv
    #[arg(long, value_name = "TRUTH.csv")]
    pub(in crate::cli) truth: Option<PathBuf>,

    /// Show the errors of k x k independent segments of every degree too, as `search --seams none` fits them
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) search: bool,

    /// Show run time and coefficients of every family of models against their errors too, as `bench` takes them; times
    /// are of this run
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) bench: bool,

    /// Of several bodies in a scan, fit the largest
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) largest: bool,

    /// Tell measures also where much of the surface was not seen, as guesses with the errors of guesses
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) extrapolate: bool,

    /// Unit of the scans' lengths, told beside them: nm, um, mm, cm, dm, m or inch; without it, what their files say
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
