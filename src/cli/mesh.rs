//! `grainform mesh`

use super::args::{InputArgs, LimitArgs, MeshArgs, MeshingArgs};
use super::console::Console;
use super::{inputs, outputs, solid, threads};
use crate::annotate::{Annotated, ScanDeviation};
use crate::export::{Detail, MeshFormat};
use crate::measure::{Deviation, equivalent_radius, mesh_properties};
use crate::model::{Grain, Surface};
use crate::portrait::colours;
use crate::report::Withheld;
use anyhow::{Result, bail};
use std::path::Path;

/// Bytes that a mesh takes per square of its resolution, while it is made: of places only, and with what is known at
/// vertices or in formats that are put together in memory.
const PLAIN: u64 = 480;
const DETAILED: u64 = 2200;

/// The most bytes that a mesh may take.
const MOST_BYTES: u64 = 4_000_000_000;

/// Bytes from which on it is told.
const MANY_BYTES: u64 = 1_000_000_000;

/// Share of the surface from which on it is told that a scan has no points near it.
const UNSEEN: f64 = 0.01;

/// How far off a scan of the same grain may be, as a share of the radius of a ball of its volume (RMS).
const FAR_OFF: f64 = 0.03;

pub(super) fn run(args: MeshArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    let output = (Some(args.output.as_path()), outputs::MESH);
    let read = [Some(args.model.as_path()), args.scan.as_deref()];
    let is_taken = outputs::check(read.into_iter().flatten(), &[output], false)?;
    let console = console.beside(is_taken);
    let format = match (MeshFormat::of(&args.output), args.format) {
        (Some(_), Some(_)) => bail!(
            "--format is that of standard output (-o -), and the name of a file tells its own: leave it out"
        ),
        (of_file, asked) => of_file.or(asked).unwrap_or(MeshFormat::Ply),
    };
    let bytes = match format {
        MeshFormat::Stl | MeshFormat::Obj => PLAIN,
        MeshFormat::Ply | MeshFormat::Vtp | MeshFormat::Glb => DETAILED,
    };
    args.meshing.check(bytes, console)?;
    let bytes = inputs::read(&args.model, &args.limit)?;
    let progress = console.progress();
    progress.stage("Meshing");
    let grain = inputs::parse_model(&args.model, &bytes, None)?;
    let mut doubts = Withheld::of(&grain, false).sentences(&inputs::name(&args.model));
    let resolution = args.meshing.resolution.into();
    let (vertices, triangles) = match format {
        MeshFormat::Stl | MeshFormat::Obj if args.scan.is_some() => {
            bail!(
                "STL and OBJ hold no distances of the scan at vertices: write PLY, VTP or GLB, or leave --scan out"
            )
        }
        MeshFormat::Stl | MeshFormat::Obj => {
            let mesh = grain.mesh(resolution);
            progress.stage("Writing");
            outputs::write(&args.output, |file| format.write(&mesh, file))?;
            doubts.extend(solid::lacking(&grain, &mesh));
            doubts.extend(outputs::rounded(format, &mesh));
            (mesh.vertices.len(), mesh.triangles.len())
        }
        MeshFormat::Ply | MeshFormat::Vtp | MeshFormat::Glb => {
            let surface = annotated(&args, &grain)?;
            doubts.extend(unseen(&args, &surface)?);
            doubts.extend(far_off(&surface));
            let detail = Detail {
                normals: &surface.normals,
                fields: &surface.fields,
                colours: &colours(&surface),
            };
            progress.stage("Writing");
            outputs::write(&args.output, |file| {
                format.write_detailed(&surface.mesh, &detail, file)
            })?;
            doubts.extend(solid::lacking(&grain, &surface.mesh));
            (surface.mesh.vertices.len(), surface.mesh.triangles.len())
        }
    };
    drop(progress);
    console.warn(&doubts);
    console.wrote(&format!(
        "{}: {vertices} vertices, {triangles} triangles",
        outputs::name(&args.output),
    ))
}

/// The mesh with what is known at its vertices.
fn annotated(args: &MeshArgs, grain: &Grain) -> Result<Annotated> {
    let surface = Annotated::new(grain, args.meshing.resolution.into());
    let Some(path) = &args.scan else {
        return Ok(surface);
    };
    let name = inputs::name(&args.model);
    solid::is_seen_whole(
        grain,
        &name,
        "how far a scan is off it is not told; leave --scan out",
    )?;
    let input = InputArgs {
        format: None,
        label: None,
        limit: LimitArgs {
            max_bytes: args.limit.max_bytes,
        },
    };
    let scan = inputs::scan(path, &input, None)?;
    Ok(surface.with_deviation(&ScanDeviation::new(grain, &scan)))
}

/// Tells of a scan that has no points near part of the surface, and refuses one that has none near any of it.
fn unseen(args: &MeshArgs, surface: &Annotated) -> Result<Option<String>> {
    let (Some(path), Some(share)) = (&args.scan, surface.unseen_share()) else {
        return Ok(None);
    };
    if share == 1.0 {
        bail!(
            "no point of {} is near the surface of {}: give the scan that the model was fitted to, or one in its place",
            inputs::name(path),
            inputs::name(&args.model)
        );
    }
    let told = || {
        let share = 100.0 * share;
        format!(
            "The scan has no points near {share:.1} % of the surface: no distance is told there."
        )
    };
    Ok((share > UNSEEN).then(told))
}

/// Tells of a scan that is far off the surface all over: it may be that of another grain.
fn far_off(surface: &Annotated) -> Option<String> {
    let known = surface.field("deviation")?.iter();
    let known = known.copied().filter(|distance| distance.is_finite());
    let off = Deviation::of(known.map(|distance| (distance, 1.0))).rms();
    let volume = mesh_properties(&surface.mesh).ok()?.volume;
    let share = off / equivalent_radius(volume);
    let told = || {
        let share = 100.0 * share;
        format!(
            "The scan is {share:.0} % of the radius of a ball of equal volume off the surface (RMS): look whether it is that of this grain."
        )
    };
    (share > FAR_OFF).then(told)
}

impl MeshingArgs {
    /// Refuses the mesh of a fit for a file if it takes too much memory, and tells of one that takes much.
    pub(super) fn check_for(&self, file: &Path, console: Console) -> Result<()> {
        let bytes = match MeshFormat::of(file) {
            Some(MeshFormat::Vtp | MeshFormat::Glb) => DETAILED,
            _ => PLAIN,
        };
        self.check(bytes, console)
    }

    fn check(&self, bytes_per_cell: u64, console: Console) -> Result<()> {
        let cells = u64::from(self.resolution).pow(2);
        let bytes = bytes_per_cell * cells;
        if bytes < MANY_BYTES {
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
                ((MOST_BYTES / bytes_per_cell) as f64).sqrt().floor(),
                1e-9 * MOST_BYTES as f64
            );
        }
        console.note("note", &need);
        Ok(())
    }
}
