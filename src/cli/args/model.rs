//! The arguments of `grainform mesh` and `grainform measure`.

use super::{InputArgs, LimitArgs, MeshingArgs};
use crate::cli::values::SchemeArg;
use crate::export::MeshFormat;
use crate::report::{Measure, Unit};
use clap::Args;
use std::path::PathBuf;

/// Mesh a model
///
/// PLY, VTP and GLB hold what is known at each vertex too: normal, mean and Gaussian curvature, number of the segment,
/// and with --scan the signed distance of the scan from the surface (positive outside; not a number where the scan has
/// no points near by).
#[derive(Args)]
pub(in crate::cli) struct MeshArgs {
    /// A model written by `fit`
    #[arg(value_name = "MODEL.json")]
    pub(in crate::cli) model: PathBuf,

    /// Write the mesh here: .stl, .ply, .obj, .vtp (VTK) or .glb (glTF) (- for standard output)
    #[arg(short, long, value_name = "OUT")]
    pub(in crate::cli) output: PathBuf,

    /// The scan that the model was fitted to
    #[arg(long, value_name = "SCAN")]
    pub(in crate::cli) scan: Option<PathBuf>,

    /// Format of the mesh on standard output: stl, ply, obj, vtp or glb [default: ply]
    #[arg(long, value_name = "FORMAT")]
    pub(in crate::cli) format: Option<MeshFormat>,

    #[command(flatten)]
    pub(in crate::cli) meshing: MeshingArgs,

    #[command(flatten)]
    pub(in crate::cli) limit: LimitArgs,
}

/// Measure a scan or a model: size, mass properties, shape descriptors, curvature
///
/// Of a scan, its own faces are measured if they are closed, else the points are triangulated by their
/// directions. What has to do with curvature is measured of models only.
#[derive(Args)]
pub(in crate::cli) struct MeasureArgs {
    /// A scan, or a model written by `fit`; the content decides
    #[arg(value_name = "SCAN|MODEL.json")]
    pub(in crate::cli) path: PathBuf,

    /// Measure these only, separated by commas, and compute nothing else: area, volume, centroid,
    /// inertia, principal, dimensions, minimum_box, ratios, form, spheres, sphericity, roundness, regularity,
    /// angularity, convexity, ellipsoid, projections, curvature, spectrum
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(in crate::cli) only: Vec<Measure>,

    /// Measure also where much of the surface was not seen: the measures are guesses then, of a model with the errors that
    /// its file keeps, of points without any
    #[arg(long)]
    pub(in crate::cli) extrapolate: bool,

    /// How area, volume and moments of a model are integrated: exact, or four-triangles, the source's
    /// polyhedron on a 128 x 128 grid
    #[arg(long, value_name = "exact|four-triangles", default_value = "exact")]
    pub(in crate::cli) scheme: SchemeArg,

    /// Unit of the scan's lengths, told beside them: nm, um, mm, cm, dm, m or inch; without it, what its file says
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) unit: Option<Unit>,

    /// Print one JSON object
    #[arg(long)]
    pub(in crate::cli) json: bool,

    #[command(flatten)]
    pub(in crate::cli) input: InputArgs,
}
