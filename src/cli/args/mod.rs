//! The arguments as they are typed.

mod bed;
mod engines;
mod many;
mod shared;

pub(super) use bed::BedArgs;
pub(super) use engines::{ClumpArgs, DeckArgs, ExportDemArgs, SpheresArgs};
pub(super) use many::{BatchArgs, CompareArgs, ReportArgs, SplitArgs};
pub(super) use shared::{FittingArgs, InputArgs, LimitArgs, MeshingArgs};

use super::numbers::{angle, count, exponents, share, vector};
use super::values::{CloudFormat, LawArg, PoseArg, SchemeArg, SemiAxes, Subject, SurfaceArg};
use crate::export::MeshFormat;
use crate::report::{Measure, Unit};
use crate::shapes::Sampling;
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use nalgebra::Vector3;
use std::path::PathBuf;

const OUTPUT: &str = "Output";
const SEARCH: &str = "Search";
const RUN: &str = "Run";

/// Fits a small analytic surface, segmented spherical harmonics, to the 3D scan of a grain, and tells
/// how good it is.
///
/// Scans are read from PLY, STL, OBJ and XYZ files and from segmented volumes (NRRD, MetaImage, NIfTI, TIFF stacks,
/// .npy), packed with gzip or not. The name - is standard input, or
/// standard output; what is said beside an output goes to standard error. Lengths are in the scan's unit. Exit
/// codes: 0 all done; 1 done, but some inputs of a batch failed; 2 bad usage or
/// unusable input.
#[derive(Parser)]
#[command(name = "grainform", version, max_term_width = 100)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,

    /// Print errors only, and what --json and --stats ask for
    #[arg(short, long, global = true, help_heading = OUTPUT)]
    pub(super) quiet: bool,

    /// Tell on standard error what is done, and when
    #[arg(short, long, global = true, help_heading = OUTPUT, conflicts_with = "quiet")]
    pub(super) verbose: bool,
}

#[derive(Subcommand)]
pub(super) enum Command {
    Fit(FitArgs),
    Search(SearchArgs),
    Mesh(MeshArgs),
    Measure(MeasureArgs),
    Contact(ContactArgs),
    Clump(ClumpArgs),
    ExportDem(ExportDemArgs),
    Synth(SynthArgs),
    Split(SplitArgs),
    Batch(BatchArgs),
    Compare(CompareArgs),
    Bed(BedArgs),
    Bench(BenchArgs),
    Report(ReportArgs),
    Completions(CompletionsArgs),
    Man(ManArgs),
}

/// Print a script that completes commands and options in a shell
#[derive(Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    pub(super) shell: Shell,
}

/// Print a page for man
#[derive(Args)]
pub(super) struct ManArgs {
    /// The command it is about [default: grainform as a whole]
    pub(super) command: Option<String>,
}

/// Fit a scan and say how good the fit is; write files only where asked to
#[derive(Args)]
pub(super) struct FitArgs {
    #[command(flatten)]
    pub(super) fitting: FittingArgs,

    /// What is fitted: star (a radius in every direction from a centre), position (of points over the sphere, of any
    /// closed faces without handles, or of dense points), or auto: a radius, and where that hides area, ends above its limit or is
    /// steep, the better of both. Or the few numbers of a superquadric (5), of one whose octants differ (poly, 8;
    /// poly12), or of a union of superquadrics (multi: as many as held-out points ask for, 4 or PARTS at most)
    #[arg(long, value_name = "auto|star|position|superquadric|poly|poly12|multi[:PARTS]", default_value = "auto",
          help_heading = SEARCH)]
    pub(super) surface: SurfaceArg,

    /// Write the model here, as JSON (- for standard output)
    #[arg(short, long, value_name = "MODEL.json", help_heading = OUTPUT)]
    pub(super) output: Option<PathBuf>,

    /// Write a closed mesh of the fitted surface here: .stl, .ply, .obj, .vtp or .glb (- for standard output, as PLY)
    #[arg(long, value_name = "OUT", help_heading = OUTPUT)]
    pub(super) mesh: Option<PathBuf>,

    /// Write the published coefficients a_l^m of every segment here
    #[arg(long, value_name = "OUT.csv", help_heading = OUTPUT)]
    pub(super) harmonics: Option<PathBuf>,

    /// Write a picture here: scan and surface, and three views with how far the scan is off in colours
    #[arg(long, value_name = "OUT.png", help_heading = OUTPUT)]
    pub(super) png: Option<PathBuf>,

    #[command(flatten)]
    pub(super) meshing: MeshingArgs,
}

/// Fit every candidate of the search and list them
///
/// Nothing is skipped, as with --exhaustive. Listed are models of the radius, and the choice is that of
/// `fit --surface star`: where `fit` takes the position of points instead, its model is another.
#[derive(Args)]
pub(super) struct SearchArgs {
    #[command(flatten)]
    pub(super) fitting: FittingArgs,

    /// Write the candidates here, a row each
    #[arg(long, value_name = "FILE.csv", help_heading = OUTPUT)]
    pub(super) csv: Option<PathBuf>,
}

/// Mesh a model
///
/// PLY, VTP and GLB hold what is known at each vertex too: normal, mean and Gaussian curvature, number of the segment,
/// and with --scan the signed distance of the scan from the surface (positive outside; not a number where the scan has
/// no points near by).
#[derive(Args)]
pub(super) struct MeshArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(super) model: PathBuf,

    /// Write the mesh here: .stl, .ply, .obj, .vtp (VTK) or .glb (glTF) (- for standard output)
    #[arg(short, long, value_name = "OUT")]
    pub(super) output: PathBuf,

    /// The scan that the model was fitted to
    #[arg(long, value_name = "SCAN")]
    pub(super) scan: Option<PathBuf>,

    /// Format of the mesh on standard output: stl, ply, obj, vtp or glb
    #[arg(long, value_name = "FORMAT", default_value = "ply")]
    pub(super) format: MeshFormat,

    #[command(flatten)]
    pub(super) meshing: MeshingArgs,

    #[command(flatten)]
    pub(super) limit: LimitArgs,
}

/// Measure a scan or a model: size, mass properties, shape descriptors, curvature
///
/// Of a scan, its own faces are measured if they are closed, else the points are triangulated by their
/// directions. What has to do with curvature is measured of models only.
#[derive(Args)]
pub(super) struct MeasureArgs {
    /// A scan, or a model written by `fit`; the content decides
    #[arg(value_name = "SCAN|MODEL.json")]
    pub(super) path: PathBuf,

    /// Measure these only, separated by commas, and compute nothing else: area, volume, centroid,
    /// inertia, principal, dimensions, minimum_box, ratios, form, spheres, sphericity, roundness, regularity,
    /// angularity, convexity, ellipsoid, projections, curvature, spectrum
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(super) only: Vec<Measure>,

    /// Measure a model also where its scan did not see much of the surface: the measures are guesses then
    #[arg(long)]
    pub(super) extrapolate: bool,

    /// How area, volume and moments of a model are integrated: exact, or four-triangles, the source's
    /// polyhedron on a 128 x 128 grid
    #[arg(long, value_name = "exact|four-triangles", default_value = "exact")]
    pub(super) scheme: SchemeArg,

    /// Unit of the scan's lengths, told beside them: um, mm, cm or m
    #[arg(long, value_name = "UNIT")]
    pub(super) unit: Option<Unit>,

    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,

    #[command(flatten)]
    pub(super) input: InputArgs,
}

/// Tell the normal force of a grain pressed against a plane or another grain, by the theory of Hertz; or, with
/// --pose-b, where two bodies touch
///
/// The force follows from the curvature where they touch, which asks more of a fit than size does: fit
/// with --segments 1. Bodies are prepared and their contacts looked for from nothing in each run, in milliseconds; of
/// bodies that move, `contact::ContactPair` of the library keeps both, and follows a contact in microseconds.
#[derive(Args)]
pub(super) struct ContactArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(super) model: PathBuf,

    /// The grain that it is pressed against [default: a plane]
    #[arg(value_name = "OTHER.json")]
    pub(super) other: Option<PathBuf>,

    /// Direction in which the grain is touched, in its scan's frame: it touches by its farthest point
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,-1", value_parser = vector)]
    pub(super) towards: Vector3<f64>,

    /// Likewise of the other grain
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,1", value_parser = vector, requires = "other")]
    pub(super) other_towards: Vector3<f64>,

    /// Angle between the directions of largest curvature of the two grains
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = angle, requires = "other")]
    pub(super) angle_deg: f64,

    /// Place the second body: what its scan is moved by and, as a quaternion, turned by about the origin before; tells
    /// all places where they overlap, and with --unit and --youngs-modulus-mpa the forces there
    #[arg(long, value_name = "X,Y,Z,QW,QX,QY,QZ", requires = "other",
          conflicts_with_all = ["indentation_um", "edge_radius", "towards", "other_towards", "angle_deg"])]
    pub(super) pose_b: Option<PoseArg>,

    /// Write both bodies and the frames of their contacts as one mesh, with the number of the body at every vertex
    #[arg(long, value_name = "MESH", requires = "pose_b")]
    pub(super) mesh: Option<PathBuf>,

    /// The law of these forces: hertz, of the depth and the curvatures, or volume, of the volume that both bodies share,
    /// which keeps energy [default: hertz]
    #[arg(long, value_name = "LAW", requires = "pose_b")]
    pub(super) law: Option<LawArg>,

    /// Unit of the scans' lengths: um, mm, cm or m
    #[arg(long, value_name = "UNIT", required_unless_present = "pose_b")]
    pub(super) unit: Option<Unit>,

    /// How far the bodies approach after they touch
    #[arg(long, value_name = "U", required_unless_present = "pose_b")]
    pub(super) indentation_um: Option<f64>,

    /// Young's modulus of the grain (inf: rigid)
    #[arg(long, value_name = "E", required_unless_present = "pose_b")]
    pub(super) youngs_modulus_mpa: Option<f64>,

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

    #[command(flatten)]
    pub(super) limit: LimitArgs,
}

/// Make a synthetic scan of a body whose area, volume and inertia are known, or of a tray of grains
#[derive(Args)]
pub(super) struct SynthArgs {
    /// bean, chickpea or maize; a shape: sphere, ellipsoid, cylinder, bicone, octahedron, cuboid or cube; a
    /// superquadric, or poly, whose octants differ; what no centre sees whole: banana, cup, mushroom, hook or random,
    /// another one for every seed, as a mesh or, with --points, as points; or tray: grains on a plane, one in ten
    /// touching another, with dust
    pub(super) body: Subject,

    /// Number of grains on a tray [default: 100]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(super) grains: Option<usize>,

    /// Of a tray, write here what each point was taken from, a line each: plane, dust or the number of a grain
    #[arg(long, value_name = "FILE.txt")]
    pub(super) labels: Option<PathBuf>,

    /// Semi-axes of a shape, or half its extents, in x, y and z; six of a poly, on the positive and on the negative
    /// side of each [default: the shape's own]
    #[arg(long, value_name = "A,B,C")]
    pub(super) axes: Option<SemiAxes>,

    /// Exponents of a superquadric or a poly: n1 of z, n2 of x and y [default: 4,2]
    #[arg(long, value_name = "N1,N2", value_parser = exponents)]
    pub(super) exponents: Option<[f64; 2]>,

    /// Number of points; met as nearly as the sampling can [default: the body's own]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(super) points: Option<usize>,

    /// Layout of the directions: cube, fibonacci, rings or random [default: cube]
    #[arg(long)]
    pub(super) sampling: Option<Sampling>,

    /// Standard deviation of the radial noise, as a share of the mean radius: 0.5% or 0.005
    #[arg(long, value_name = "S", default_value = "0", value_parser = share)]
    pub(super) noise: f64,

    /// Share of the points that lie 20 % too far in or out: 1% or 0.01
    #[arg(long, value_name = "S", default_value = "0", value_parser = share)]
    pub(super) outliers: f64,

    /// Half-opening angle, in degrees, of a cap around -z that was not seen
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    pub(super) missing_cap: f64,

    /// Where the body's origin lies
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", value_parser = vector)]
    pub(super) offset: Vector3<f64>,

    /// Seed of everything random
    #[arg(long, value_name = "K", value_parser = count::<u64>, default_value_t = 0)]
    pub(super) seed: u64,

    /// Write the points here: .ply or .xyz, a mesh .stl or .obj too (- for standard output)
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,

    /// Format of the points on standard output: ply or xyz
    #[arg(long, value_name = "FORMAT", default_value = "ply")]
    pub(super) format: CloudFormat,

    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

/// Measure run time against error over many settings
///
/// Families, on one thread: whole-surface fits of degree 1 to 20; 1 x 1 to 16 x 16 independent segments
/// of degree 0 to 6; 6 to 150 blended cells of degree 1 to 5; and adaptive cells within 1 % to 0.02 % of
/// the mean radius, of degree 3 or less and of any degree. Seconds are the processor's, the least of three runs or
/// more, of preparing the scan and fitting it; bench.csv has a column for each. Printed are the settings with the least
/// held-out RMS for their coefficients, their seconds or the nanoseconds of one evaluation.
#[derive(Args)]
pub(super) struct BenchArgs {
    /// Scans [default: a synthetic bean, chickpea and maize kernel, clean and noisy, whose truth is
    /// known]
    #[arg(value_name = "SCAN")]
    pub(super) scans: Vec<PathBuf>,

    /// Write bench.csv and the plots into this folder
    #[arg(short, long, value_name = "DIR", default_value = "bench", help_heading = OUTPUT)]
    pub(super) output: PathBuf,

    /// Beside ducc0's least-squares fits of the whole sphere, of degree 1 to 40, where python3 has ducc0 and numpy
    /// (python3 -m pip install ducc0 numpy): one point in ten is hidden from all fits and judges them. ducc0 is given the
    /// centre, and for each degree the solver's tolerance and iterations that suit it best
    #[arg(long, help_heading = RUN)]
    pub(super) rivals: bool,

    /// Print all rows as one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(super) json: bool,

    /// Unit of the scans' lengths, told in the object: um, mm, cm or m
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(super) unit: Option<Unit>,

    #[command(flatten)]
    pub(super) input: InputArgs,
}

#[cfg(test)]
mod tests {
    use super::Cli;
    use crate::report::Measure;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_help_of_measure_has_the_name_of_every_measure() {
        let mut cli = Cli::command();
        let measure = cli.find_subcommand_mut("measure").unwrap();
        let only = measure.get_arguments().find(|a| a.get_id() == "only");
        let help = only.and_then(|only| only.get_help()).unwrap().to_string();
        let names: Vec<&str> = help.split([' ', ',', ':', '\n']).collect();
        for measure in Measure::ALL {
            assert!(names.contains(&measure.to_string().as_str()), "{measure}");
        }
    }
}
