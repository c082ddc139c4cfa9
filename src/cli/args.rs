//! The arguments as they are typed.

use super::values::{Auto, SchemeArg, SeamsArg, Unit, tolerance, vector};
use crate::fit::Tolerance;
use crate::report::Measure;
use crate::shapes::{Body, Sampling};
use crate::sphere::Symmetry;
use clap::{Args, Parser, Subcommand, value_parser};
use nalgebra::Vector3;
use std::path::PathBuf;

const SEARCH: &str = "Search";
const OUTPUT: &str = "Output";
const RUN: &str = "Run";

/// Cells per edge of the cube of directions.
pub(super) const DEFAULT_RESOLUTION: u16 = 64;

/// Most threads that can be asked for.
const MAX_THREADS: u16 = 1024;

/// Fits a small analytic surface, segmented spherical harmonics, to the 3D scan of a grain, and tells
/// how good it is.
///
/// Scans are read from PLY, STL, OBJ and XYZ files. Lengths are in the scan's unit. Exit codes: 0 all
/// done; 1 done, but some inputs of a batch failed (no command uses it yet); 2 bad usage or unusable
/// input.
#[derive(Parser)]
#[command(name = "grainform", version, max_term_width = 100)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Subcommand)]
pub(super) enum Command {
    Fit(FitArgs),
    Search(SearchArgs),
    Mesh(MeshArgs),
    Measure(MeasureArgs),
    Contact(ContactArgs),
    Synth(SynthArgs),
    Bench(BenchArgs),
}

/// Fit a scan and say how good the fit is; write files only where asked to
#[derive(Args)]
pub(super) struct FitArgs {
    #[command(flatten)]
    pub(super) fitting: FittingArgs,

    /// Write the model here, as JSON
    #[arg(short, long, value_name = "MODEL.json", help_heading = OUTPUT)]
    pub(super) output: Option<PathBuf>,

    /// Write a closed mesh of the fitted surface here: .stl, .ply or .obj
    #[arg(long, value_name = "OUT", help_heading = OUTPUT)]
    pub(super) mesh: Option<PathBuf>,

    /// Write the published coefficients a_l^m of every segment here
    #[arg(long, value_name = "OUT.csv", help_heading = OUTPUT)]
    pub(super) harmonics: Option<PathBuf>,

    #[command(flatten)]
    pub(super) meshing: MeshingArgs,
}

/// Fit every candidate of the search and list them
///
/// Nothing is skipped, as with --exhaustive; the choice is the same as that of `fit`.
#[derive(Args)]
pub(super) struct SearchArgs {
    #[command(flatten)]
    pub(super) fitting: FittingArgs,

    /// Write the candidates here, a row each
    #[arg(long, value_name = "FILE.csv", help_heading = OUTPUT)]
    pub(super) csv: Option<PathBuf>,
}

/// Mesh a model
#[derive(Args)]
pub(super) struct MeshArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(super) model: PathBuf,

    /// Write the mesh here: .stl, .ply or .obj
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,

    #[command(flatten)]
    pub(super) meshing: MeshingArgs,
}

/// Measure a scan or a model: size, mass properties, shape descriptors, curvature
///
/// Of a scan, its own faces are measured if they are closed, else the points are triangulated by their
/// directions. What has to do with curvature is measured of models only.
#[derive(Args)]
pub(super) struct MeasureArgs {
    /// A scan, or a model written by `fit`; the content decides
    #[arg(value_name = "SCAN|MODEL.json")]
    pub(super) input: PathBuf,

    /// Measure these only, separated by commas, and compute nothing else: area, volume, centroid,
    /// inertia, principal, dimensions, minimum_box, form, spheres, sphericity, roundness, regularity,
    /// angularity, convexity, ellipsoid, projections, curvature, spectrum
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) only: Vec<Measure>,

    /// How area, volume and moments of a model are integrated: exact, or four-triangles, the source's
    /// polyhedron on a 128 x 128 grid
    #[arg(long, value_name = "exact|four-triangles", default_value = "exact")]
    pub(super) scheme: SchemeArg,

    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

/// Tell the normal force of a grain pressed against a plane or another grain, by the theory of Hertz
///
/// The force follows from the curvature where they touch, which asks more of a fit than size does: fit
/// with a tolerance of 0.01 %.
#[derive(Args)]
pub(super) struct ContactArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(super) model: PathBuf,

    /// The grain that it is pressed against [default: a plane]
    #[arg(value_name = "OTHER.json")]
    pub(super) other: Option<PathBuf>,

    /// Direction in which the grain is touched, in its scan's frame: it touches by its farthest point
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,-1", value_parser = vector,
          allow_hyphen_values = true)]
    pub(super) towards: Vector3<f64>,

    /// Likewise of the other grain
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,1", value_parser = vector,
          allow_hyphen_values = true)]
    pub(super) other_towards: Vector3<f64>,

    /// Angle between the directions of largest curvature of the two grains
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub(super) angle_deg: f64,

    /// Unit of the scans' lengths: um, mm, cm or m
    #[arg(long, value_name = "UNIT")]
    pub(super) unit: Unit,

    /// How far the bodies approach after they touch
    #[arg(long, value_name = "U", allow_hyphen_values = true)]
    pub(super) indentation_um: f64,

    /// Young's modulus of the grain (inf: rigid)
    #[arg(long, value_name = "E")]
    pub(super) youngs_modulus_mpa: f64,

    /// Poisson's ratio of the grain
    #[arg(long, value_name = "NU", default_value_t = 0.3)]
    pub(super) poissons_ratio: f64,

    /// Young's modulus of the plane or the other grain [default: the same]
    #[arg(long, value_name = "E")]
    pub(super) other_youngs_modulus_mpa: Option<f64>,

    /// Poisson's ratio of the plane or the other grain [default: the same]
    #[arg(long, value_name = "NU")]
    pub(super) other_poissons_ratio: Option<f64>,

    /// Radius, in the scan's unit, of the cap that rounds an edge by which a grain is touched
    #[arg(long, value_name = "R")]
    pub(super) edge_radius: Option<f64>,

    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

/// Make a synthetic scan of a body whose area, volume and inertia are known
#[derive(Args)]
pub(super) struct SynthArgs {
    /// bean, chickpea or maize, or a shape: sphere, ellipsoid, cylinder, bicone, octahedron, cuboid or
    /// cube
    pub(super) body: Body,

    /// Semi-axes of a shape, or half its extents, in x, y and z [default: the shape's own]
    #[arg(long, value_name = "A,B,C", value_parser = vector, allow_hyphen_values = true)]
    pub(super) axes: Option<Vector3<f64>>,

    /// Number of points; met as nearly as the sampling can [default: the body's own]
    #[arg(long, value_name = "N")]
    pub(super) points: Option<usize>,

    /// Layout of the directions: cube, fibonacci, rings or random
    #[arg(long, default_value_t = Sampling::Cube)]
    pub(super) sampling: Sampling,

    /// Standard deviation of the radial noise, as a share of the mean radius (0.005 is 0.5 %)
    #[arg(long, value_name = "S", default_value_t = 0.0)]
    pub(super) noise: f64,

    /// Share of the points that lie 20 % too far in or out
    #[arg(long, value_name = "S", default_value_t = 0.0)]
    pub(super) outliers: f64,

    /// Half-opening angle, in degrees, of a cap around -z that was not seen
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub(super) missing_cap: f64,

    /// Where the body's origin lies
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", value_parser = vector,
          allow_hyphen_values = true)]
    pub(super) offset: Vector3<f64>,

    /// Seed of everything random
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(super) seed: u64,

    /// Write the points here: .ply or .xyz
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,

    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

/// Measure run time against error over many settings
///
/// Families, on one thread: whole-surface fits of degree 1 to 20; 1 x 1 to 16 x 16 independent segments
/// of degree 0 to 6; 6 to 150 blended cells of degree 1 to 5; and adaptive cells within 1 % to 0.02 % of
/// the mean radius, of degree 3 or less and of any degree. Seconds are those of the fit alone; what
/// preparing the scan takes is a column of bench.csv. Printed are the settings with the least held-out
/// RMS for their coefficients or their seconds.
#[derive(Args)]
pub(super) struct BenchArgs {
    /// Scans [default: a synthetic bean, chickpea and maize kernel, clean and noisy, whose truth is
    /// known]
    #[arg(value_name = "SCAN")]
    pub(super) scans: Vec<PathBuf>,

    /// Write bench.csv and the plots into this folder
    #[arg(short, long, value_name = "DIR", default_value = "bench", help_heading = OUTPUT)]
    pub(super) output: PathBuf,

    /// Print all rows as one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(super) json: bool,

    /// Print errors only, and what --json asks for
    #[arg(long, help_heading = OUTPUT)]
    pub(super) quiet: bool,
}

/// What `fit` and `search` share.
#[derive(Args)]
pub(super) struct FittingArgs {
    /// The scan: PLY, STL, OBJ or XYZ
    #[arg(value_name = "SCAN")]
    pub(super) scan: PathBuf,

    /// How segments are joined: blended (overlapping cells, fitted together) or none (k x k
    /// independent segments of the angle domain, with steps between them)
    #[arg(long, value_name = "blended|none", default_value = "blended", help_heading = SEARCH)]
    pub(super) seams: SeamsArg,

    /// Mirror planes of the grain, told by the scan's axes normal to them, such as z or xyz: one
    /// expansion is fitted to a half, a quarter or an octant, and mirrored. The planes go through the
    /// centre; turn the scan beforehand if its axes are not those of the grain
    #[arg(long, value_name = "AXES|none", default_value_t = Symmetry::NONE, help_heading = SEARCH)]
    pub(super) symmetry: Symmetry,

    /// Degree of every segment's expansion, or auto to search
    #[arg(long, value_name = "L|auto", default_value = "auto", help_heading = SEARCH)]
    pub(super) degree: Auto,

    /// Number of segments: 1 for the estimate itself, one expansion of the whole sphere; 6 n^2 blended cells; or
    /// k^2 independent segments. adaptive (or auto) splits cells where the shape asks for it, or searches all k
    #[arg(long, value_name = "N|adaptive", default_value = "adaptive", help_heading = SEARCH)]
    pub(super) segments: Auto,

    /// Largest degree searched: bounds the cost of an evaluation [default: 4 in blended cells, else 3]
    #[arg(long, value_name = "L", help_heading = SEARCH)]
    pub(super) max_degree: Option<usize>,

    /// Largest number of segments searched [default: 600 blended, 100 independent]
    #[arg(long, value_name = "N", help_heading = SEARCH)]
    pub(super) max_segments: Option<usize>,

    /// RMS difference from the estimate that is good enough: a length in the scan's unit, a share of the mean
    /// radius such as 0.3%, or auto (0.03%); a third of the estimate's own standard deviation always is
    #[arg(long, value_name = "T|auto", default_value = "auto", value_parser = tolerance,
          help_heading = SEARCH)]
    pub(super) tolerance: Tolerance,

    /// Fit every candidate, also those that cannot win; the choice is the same
    #[arg(long, help_heading = SEARCH)]
    pub(super) exhaustive: bool,

    /// Threads, 0 for all cores; the result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, help_heading = RUN,
          value_parser = value_parser!(u16).range(0..=i64::from(MAX_THREADS)))]
    pub(super) threads: u16,

    /// Print one JSON object, warnings included
    #[arg(long, help_heading = OUTPUT)]
    pub(super) json: bool,

    /// Tell on standard error what was fitted and skipped, and how long it took
    #[arg(long, help_heading = OUTPUT)]
    pub(super) stats: bool,

    /// Print errors only, and what --json and --stats ask for
    #[arg(long, help_heading = OUTPUT)]
    pub(super) quiet: bool,
}

/// How meshes are made.
#[derive(Args)]
pub(super) struct MeshingArgs {
    /// Cells N along each edge of a cube of directions: 6 N^2 + 2 vertices, 12 N^2 triangles
    #[arg(long, value_name = "N", default_value_t = DEFAULT_RESOLUTION, help_heading = OUTPUT,
          value_parser = value_parser!(u16).range(1..=2048))]
    pub(super) resolution: u16,
}

#[cfg(test)]
mod tests {
    use super::Cli;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
