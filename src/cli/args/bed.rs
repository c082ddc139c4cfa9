//! The arguments of `grainform bed`.

use super::{InputArgs, OUTPUT, RUN};
use crate::cli::lengths::{length, lengths};
use crate::cli::numbers::{count, pair};
use crate::cli::values::ShareArg;
use crate::report::Unit;
use clap::builder::RangedI64ValueParser;
use clap::{ArgGroup, Args, value_parser};
use std::path::PathBuf;

const MATERIAL: &str = "Material, of grains and walls";

/// Drop grains into a box, let them settle, and tell how densely they are packed and how they carry
///
/// Grains are models of convex parts, as `fit --surface superquadric`, poly, poly12 or multi makes, or with --spheres
/// any models and scans as clumps. They fall from a loose column, each turned at random. What is not asked for of the material is assumed, and told. The folder holds
/// state.json, from which a bed that was stopped goes on when it is started again; frames, LAMMPS dumps that OVITO
/// opens; bed.vtk, the grains as polygons for ParaView; and a picture, bed.png.
#[derive(Args)]
#[command(group(ArgGroup::new("container").args(["sides", "cylinder"]).required(true)))]
pub(in crate::cli) struct BedArgs {
    /// Models, each with its share of the grains, 1 where it is not told: lens.json:0.7 rod.json:0.3
    #[arg(value_name = "GRAIN[:SHARE]", required = true)]
    pub(in crate::cli) grains: Vec<ShareArg>,

    /// Number of grains
    #[arg(long = "grains", value_name = "N", value_parser = count::<usize>, default_value_t = 1500)]
    pub(in crate::cli) count: usize,

    /// Width and depth of the box, from the origin on, whose walls have no end
    #[arg(long = "box", value_name = "X,Y", value_parser = lengths)]
    pub(in crate::cli) sides: Option<[f64; 2]>,

    /// Diameter of an upright cylinder about the z axis, in place of a box
    #[arg(long, value_name = "D", value_parser = length)]
    pub(in crate::cli) cylinder: Option<f64>,

    /// A mesh whose faces are walls too; grains fall from above it
    #[arg(long, value_name = "MESH")]
    pub(in crate::cli) walls: Option<PathBuf>,

    /// Unit of all lengths here and in the models, and in the table of --sizes if that tells none: nm, um, mm, cm, dm, m or inch [default: that which the models tell]
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) unit: Option<Unit>,

    /// Give all grains the volume of a sphere of this diameter [default: as they are]
    #[arg(long, value_name = "D", value_parser = length)]
    pub(in crate::cli) diameter: Option<f64>,

    /// Give each grain the volume of one in these results of `batch`: a folder or a table, of which at most 100 sizes
    /// are taken, each for as many grains
    #[arg(long, value_name = "RESULTS", conflicts_with = "diameter")]
    pub(in crate::cli) sizes: Option<PathBuf>,

    /// Make each grain a clump of at most so many spheres, whatever model or scan it is; mass, centre and inertia stay
    /// the grain's [default: 10 with --engine]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(in crate::cli) spheres: Option<usize>,

    /// Let another engine run the same bed, of clumps: lammps, which must be installed
    #[arg(long, value_name = "NAME", value_parser = ["lammps"], conflicts_with = "walls", help_heading = RUN)]
    pub(in crate::cli) engine: Option<String>,

    /// Processes of the engine; mpirun starts them if they are more than one
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..),
          requires = "engine", help_heading = RUN)]
    pub(in crate::cli) ranks: u32,

    /// Write the engine's files, and let it read them without running, on no more processes than there are cores
    #[arg(long, requires = "engine", help_heading = RUN)]
    pub(in crate::cli) dry_run: bool,

    /// Write the bed into this folder
    #[arg(short, long, value_name = "DIR", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Seed of places, headings and order
    #[arg(long, value_name = "K", value_parser = count::<u64>, default_value_t = 0)]
    pub(in crate::cli) seed: u64,

    /// Make so many beds, of this seed and those after it, in folders seed_K, and tell standard errors over them
    // Read with a sign, so that a negative one is told this range.
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = RangedI64ValueParser::<u64>::new().range(1..=1000))]
    pub(in crate::cli) seeds: u64,

    /// End after so many simulated seconds, at rest or not; more of them let a bed that was ended go on
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    pub(in crate::cli) seconds: f64,

    /// Kinetic energy per grain at which the bed is at rest, as a share of m g d
    #[arg(long, value_name = "S", default_value_t = 1e-5)]
    pub(in crate::cli) rest: f64,

    /// Density, in kg/m³
    #[arg(long, value_name = "RHO", default_value_t = 2500.0, help_heading = MATERIAL)]
    pub(in crate::cli) density: f64,

    /// Young's modulus; steps are as long as softness allows
    #[arg(long, value_name = "E", default_value_t = 10.0, help_heading = MATERIAL)]
    pub(in crate::cli) youngs_modulus_mpa: f64,

    /// Poisson's ratio
    #[arg(long, value_name = "NU", default_value_t = 0.3, help_heading = MATERIAL)]
    pub(in crate::cli) poissons_ratio: f64,

    /// Coefficient of friction
    #[arg(long, value_name = "MU", default_value_t = 0.3, help_heading = MATERIAL)]
    pub(in crate::cli) friction: f64,

    /// Coefficient of rolling friction
    #[arg(long, value_name = "MU_R", default_value_t = 0.0, help_heading = MATERIAL)]
    pub(in crate::cli) rolling_friction: f64,

    /// Coefficients of damping, along the normal and across it
    #[arg(long, value_name = "C_N,C_T", value_parser = pair, default_value = "0.2,0.2", help_heading = MATERIAL)]
    pub(in crate::cli) damping: [f64; 2],

    /// Threads, 0 for all cores; the bed does not depend on it
    #[arg(long, value_name = "N", value_parser = count::<usize>, default_value_t = 0, help_heading = RUN)]
    pub(in crate::cli) threads: usize,

    /// Print one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
