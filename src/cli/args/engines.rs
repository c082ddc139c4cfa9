//! The arguments of what other engines take: clumps and their inputs.

use super::{InputArgs, OUTPUT};
use crate::cli::numbers::{count, share};
use crate::cli::values::EngineArg;
use crate::report::Unit;
use clap::Args;
use std::path::PathBuf;

/// How many spheres a clump has.
#[derive(Args)]
pub(in crate::cli) struct SpheresArgs {
    /// Number of spheres, 1 to 500; fewer where more bring nothing [default: 10]
    #[arg(long, value_name = "N", value_parser = count::<usize>)]
    pub(in crate::cli) spheres: Option<usize>,

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

    /// Unit of the scan's lengths, told beside them: nm, um, mm, cm, dm, m or inch
    #[arg(long, value_name = "UNIT", help_heading = OUTPUT)]
    pub(in crate::cli) unit: Option<Unit>,

    /// Print one JSON object
    #[arg(long, help_heading = OUTPUT)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}

/// What is asked of grains that fall in an engine.
#[derive(Args)]
pub(in crate::cli) struct DeckArgs {
    #[command(flatten)]
    pub(in crate::cli) spheres: SpheresArgs,

    /// Number of grains; of mercurydpm its driver tells it [default: 200]
    #[arg(long, value_name = "K", value_parser = count::<usize>)]
    pub(in crate::cli) grains: Option<usize>,

    /// Seed of the orientations at the start, of lammps and yade [default: 1]
    #[arg(long, value_name = "S", value_parser = count::<u64>)]
    pub(in crate::cli) seed: Option<u64>,

    /// Density of the grains, in kg/m³ [default: 2500]
    #[arg(long, value_name = "RHO")]
    pub(in crate::cli) density: Option<f64>,

    /// Young's modulus of grains and walls: softer than the grain's own, for the time step is as the inverse of its root
    /// [default: 10]
    #[arg(long, value_name = "E")]
    pub(in crate::cli) youngs_modulus_mpa: Option<f64>,

    /// Poisson's ratio [default: 0.3]
    #[arg(long, value_name = "NU")]
    pub(in crate::cli) poissons_ratio: Option<f64>,

    /// Coefficient of sliding friction [default: 0.3]
    #[arg(long, value_name = "MU")]
    pub(in crate::cli) friction: Option<f64>,

    /// Coefficient of restitution [default: 0.5]
    #[arg(long, value_name = "E")]
    pub(in crate::cli) restitution: Option<f64>,
}

/// Write a folder that an engine of the discrete element method runs as it is
///
/// Each grain becomes a clump of spheres, with mass, centre and inertia of the grain; for anm, harmonics about its centre
/// of mass. In the engine they fall from a column into a box and come to rest. Everything in the folder is in SI units.
/// Where each grain is fitted as one superquadric, a second script takes them as such: in LIGGGHTS built with them, and in
/// LAMMPS of 30 March 2026 or later (not run by us), for which exponents below 2 are raised to 2.
#[derive(Args)]
pub(in crate::cli) struct ExportDemArgs {
    /// Models written by `fit`, or scans; several are mixed in equal numbers
    #[arg(value_name = "MODEL.json|SCAN", required = true)]
    pub(in crate::cli) paths: Vec<PathBuf>,

    /// The engine: lammps, yade, liggghts, mercurydpm, or anm (shapes as NIST publishes them, for SPHERHARM)
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) engine: EngineArg,

    /// Write the files into this folder
    #[arg(short, long, value_name = "DIR", help_heading = OUTPUT)]
    pub(in crate::cli) output: PathBuf,

    /// Unit of the scans' lengths: nm, um, mm, cm, dm, m or inch [default: that which the models tell]
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) unit: Option<Unit>,

    #[command(flatten)]
    pub(in crate::cli) deck: DeckArgs,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
