//! `grainform mesh`

use super::args::MeshArgs;
use super::progress::Progress;
use super::{outputs, print};
use crate::export::save_mesh;
use crate::model::{Grain, parse_grain};
use anyhow::{Context, Result, anyhow};
use std::path::Path;

pub(super) fn run(args: MeshArgs) -> Result<()> {
    outputs::check(Some(&args.model), &[(Some(&args.output), outputs::MESH)])?;
    let bytes = read(&args.model)?;
    let progress = Progress::new(false);
    progress.stage("Meshing");
    let mesh = grain(&args.model, &bytes)?.mesh(args.meshing.resolution.into());
    save_mesh(&args.output, &mesh)?;
    drop(progress);
    print(format_args!(
        "wrote {}: {} vertices, {} triangles",
        args.output.display(),
        mesh.vertices.len(),
        mesh.triangles.len()
    ))
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(|| format!("cannot read the file {}", path.display()))
}

/// The grain in the bytes of a model file.
pub(super) fn grain(path: &Path, bytes: &[u8]) -> Result<Grain> {
    parse_grain(&String::from_utf8_lossy(bytes))
        .map_err(|error| anyhow!("cannot read a model from {}: {error}", path.display()))
}
