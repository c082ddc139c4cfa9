//! `grainform mesh`

use super::args::{MeshArgs, MeshingArgs};
use super::console::Console;
use super::{inputs, outputs, threads};
use crate::export::MeshFormat;
use crate::model::Surface;
use anyhow::{Result, bail};

/// Bytes that a mesh takes per square of its resolution, while it is made.
const BYTES_PER_CELL: u64 = 480;

/// The most bytes that a mesh may take.
const MOST_BYTES: u64 = 4_000_000_000;

/// Bytes from which on it is told.
const MANY_BYTES: u64 = 1_000_000_000;

pub(super) fn run(args: MeshArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    let output = (Some(args.output.as_path()), outputs::MESH);
    let console = console.beside(outputs::check(Some(&args.model), &[output], false)?);
    args.meshing.check(true, console)?;
    let bytes = inputs::read(&args.model, &args.limit)?;
    let progress = console.progress();
    progress.stage("Meshing");
    let mesh = inputs::parse_model(&args.model, &bytes)?.mesh(args.meshing.resolution.into());
    progress.stage("Writing");
    let format = MeshFormat::of(&args.output).unwrap_or(args.format);
    outputs::write(&args.output, |file| format.write(&mesh, file))?;
    drop(progress);
    console.wrote(&format!(
        "{}: {} vertices, {} triangles",
        outputs::name(&args.output),
        mesh.vertices.len(),
        mesh.triangles.len()
    ))
}

impl MeshingArgs {
    /// Refuses a mesh that takes too much memory, and tells of one that takes much; `is_asked` is whether there
    /// is one to make.
    pub(super) fn check(&self, is_asked: bool, console: Console) -> Result<()> {
        let cells = u64::from(self.resolution).pow(2);
        let bytes = BYTES_PER_CELL * cells;
        if !is_asked || bytes < MANY_BYTES {
            return Ok(());
        }
        let need = format!(
            "a mesh of resolution {} has {} vertices and needs {:.1} GB of memory",
            self.resolution,
            6 * cells + 2,
            1e-9 * bytes as f64
        );
        if bytes > MOST_BYTES {
            bail!(
                "{need}; ask for at most {:.0}, which needs {:.0} GB",
                ((MOST_BYTES / BYTES_PER_CELL) as f64).sqrt().floor(),
                1e-9 * MOST_BYTES as f64
            );
        }
        console.note("note", &need);
        Ok(())
    }
}
