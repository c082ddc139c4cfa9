//! The arguments of `grainform fit` and `grainform search`.

use super::{FittingArgs, MeshingArgs, OUTPUT, SEARCH};
use crate::cli::values::SurfaceArg;
use clap::Args;
use std::path::PathBuf;

/// Fit a scan and say how good the fit is; write files only where asked to
#[derive(Args)]
#[command(mut_arg("resolution", |resolution| resolution.requires("mesh")))]
pub(in crate::cli) struct FitArgs {
    #[command(flatten)]
    pub(in crate::cli) fitting: FittingArgs,

    /// What is fitted: star (a radius in every direction from a centre), position (of points over the sphere, of any
    /// closed faces without handles, or of dense points), or auto: a radius, and where that hides area, ends above its limit or is
    /// steep, the better of both. Or the few numbers of a superquadric (superquadric: 5), of one whose octants differ
    /// (poly: 8; poly12), or of a union of superquadrics (multi or multi:PARTS: as many as held-out points ask for, 4 or
    /// PARTS at most)
    #[arg(long, value_name = "KIND", default_value = "auto", help_heading = SEARCH)]
    pub(in crate::cli) surface: SurfaceArg,

    /// Tell area, volume, moments and size where much of the surface was not seen, as guesses with the errors of
    /// guesses
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) extrapolate: bool,

    /// With --seams none or --symmetry, fit every candidate, also those that cannot win; the choice is the same
    #[arg(long, help_heading = SEARCH)]
    pub(in crate::cli) exhaustive: bool,

    /// Write the model here, as JSON (- for standard output)
    #[arg(short, long, value_name = "MODEL.json", help_heading = OUTPUT)]
    pub(in crate::cli) output: Option<PathBuf>,

    /// Write a closed mesh of the fitted surface here: .stl, .ply, .obj, .vtp or .glb (- for standard output, as PLY).
    /// It holds places and faces alone; PLY, VTP and GLB that `mesh` writes of the model hold normals and curvatures too
    #[arg(long, value_name = "OUT", help_heading = OUTPUT)]
    pub(in crate::cli) mesh: Option<PathBuf>,

    /// Write the published coefficients a_l^m of every segment here; of positions those of x, y and z
    #[arg(long, value_name = "OUT.csv", help_heading = OUTPUT)]
    pub(in crate::cli) harmonics: Option<PathBuf>,

    /// Write a picture here: scan and surface, and three views with how far the scan is off in colours
    #[arg(long, value_name = "OUT.png", help_heading = OUTPUT)]
    pub(in crate::cli) png: Option<PathBuf>,

    #[command(flatten)]
    pub(in crate::cli) meshing: MeshingArgs,
}

impl FitArgs {
    /// Whether a file is asked for, beside a picture, which is drawn.
    pub(in crate::cli) fn writes(&self) -> bool {
        self.output.is_some() || self.mesh.is_some() || self.harmonics.is_some()
    }
}

/// Fit every candidate of the search and list them
///
/// Nothing is skipped, as by `fit --exhaustive`. Listed are models of the radius, and the choice is that of
/// `fit --surface star`: where `fit` takes the position of points instead, its model is another.
#[derive(Args)]
pub(in crate::cli) struct SearchArgs {
    #[command(flatten)]
    pub(in crate::cli) fitting: FittingArgs,

    /// Write the candidates here, a row each
    #[arg(long, value_name = "FILE.csv", help_heading = OUTPUT)]
    pub(in crate::cli) csv: Option<PathBuf>,
}
