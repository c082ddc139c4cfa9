//! The arguments of `grainform contact`.

use super::LimitArgs;
use crate::cli::numbers::{angle, vector};
use crate::cli::values::{LawArg, PoseArg};
use crate::report::Unit;
use clap::Args;
use nalgebra::Vector3;
use std::path::PathBuf;

/// Tell the normal force of a grain pressed against a plane or another grain, by the theory of Hertz; or, with
/// --pose-b, where two bodies touch
///
/// The force follows from the curvature where they touch, which asks more of a fit than size does: fit
/// with --segments 1. Bodies are prepared and their contacts looked for from nothing in each run, in milliseconds; of
/// bodies that move, `contact::ContactPair` of the library keeps both, and follows a contact in microseconds.
#[derive(Args)]
pub(in crate::cli) struct ContactArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(in crate::cli) model: PathBuf,

    /// The grain that it is pressed against [default: a plane]
    #[arg(value_name = "OTHER.json")]
    pub(in crate::cli) other: Option<PathBuf>,

    /// Direction in which the grain is touched, in its scan's frame: it touches by its farthest point
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,-1", value_parser = vector)]
    pub(in crate::cli) towards: Vector3<f64>,

    /// Likewise of the other grain
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,1", value_parser = vector, requires = "other")]
    pub(in crate::cli) other_towards: Vector3<f64>,

    /// Angle between the directions of largest curvature of the two grains
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = angle, requires = "other")]
    pub(in crate::cli) angle_deg: f64,

    /// Place the second body: what its scan is moved by and, as a quaternion, turned by about the origin before; tells
    /// all places where they overlap, and with --unit and --youngs-modulus-mpa the forces there
    #[arg(long, value_name = "X,Y,Z,QW,QX,QY,QZ", requires = "other",
          conflicts_with_all = ["indentation_um", "edge_radius", "towards", "other_towards", "angle_deg"])]
    pub(in crate::cli) pose_b: Option<PoseArg>,

    /// Write both bodies and the frames of their contacts as one mesh, with the number of the body at every vertex
    #[arg(long, value_name = "MESH", requires = "pose_b")]
    pub(in crate::cli) mesh: Option<PathBuf>,

    /// The law of these forces: hertz, of the depth and the curvatures, or volume, of the volume that both bodies share,
    /// which keeps energy [default: hertz]
    #[arg(long, value_name = "LAW", requires = "pose_b")]
    pub(in crate::cli) law: Option<LawArg>,

    /// Unit of the scans' lengths: nm, um, mm, cm, dm, m or inch; without it, what the models tell
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) unit: Option<Unit>,

    /// How far the bodies approach after they touch
    #[arg(long, value_name = "U", required_unless_present = "pose_b")]
    pub(in crate::cli) indentation_um: Option<f64>,

    /// Young's modulus of the grain (inf: rigid)
    #[arg(long, value_name = "E", required_unless_present = "pose_b")]
    pub(in crate::cli) youngs_modulus_mpa: Option<f64>,

    /// Poisson's ratio of the grain
    #[arg(
        long,
        value_name = "NU",
        default_value_t = 0.3,
        requires = "youngs_modulus_mpa"
    )]
    pub(in crate::cli) poissons_ratio: f64,

    /// Young's modulus of the plane or the other grain [default: the same]
    #[arg(long, value_name = "E", requires = "youngs_modulus_mpa")]
    pub(in crate::cli) other_youngs_modulus_mpa: Option<f64>,

    /// Poisson's ratio of the plane or the other grain [default: the same]
    #[arg(long, value_name = "NU", requires = "youngs_modulus_mpa")]
    pub(in crate::cli) other_poissons_ratio: Option<f64>,

    /// Radius, in the scan's unit, of the cap that rounds an edge by which a grain is touched
    #[arg(long, value_name = "R")]
    pub(in crate::cli) edge_radius: Option<f64>,

    /// Print one JSON object
    #[arg(long)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) limit: LimitArgs,
}
