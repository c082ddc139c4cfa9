//! What is written: files, checked before any work is done for them, or standard output.

use super::args::FitArgs;
use super::inputs::is_stream;
use super::solid;
use crate::engines::InputFile;
use crate::export::{MeshFormat, WriteError, sweep, write_atomically};
use crate::mesh::Mesh;
use crate::model::{Grain, Surface, grain_to_json};
use crate::picture::Image;
use crate::portrait::{Caption, portrait};
use crate::report::Unit;
use crate::scan::Scan;
use anyhow::{Context, Result, bail};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Extensions of meshes.
pub(super) const MESH: &[&str] = &["stl", "ply", "obj", "vtp", "glb"];

/// A file to write, if any, and the extensions it may have.
pub(super) type Output<'a> = (Option<&'a Path>, &'a [&'a str]);

/// Refuses outputs that would fail at the end: each has a known extension, its folder exists, and it is neither
/// an input nor another output. What a killed run left in these folders is removed. Gives whether an output goes
/// to standard output, which then has no place for `json`.
pub(super) fn check<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: &[Output<'_>],
    json: bool,
) -> Result<bool> {
    let files = outputs
        .iter()
        .filter_map(|(path, extensions)| Some((path.as_deref()?, extensions)));
    let (streams, files): (Vec<_>, Vec<_>) = files.partition(|(path, _)| is_stream(path));
    if streams.len() + usize::from(json) > 1 && !streams.is_empty() {
        bail!("standard output takes one thing only: give another output the name of a file");
    }
    let inputs = inputs.into_iter().filter(|path| !is_stream(path));
    let mut taken: Vec<PathBuf> = inputs.map(identity).collect();
    for (path, extensions) in files {
        check_file(path, extensions)?;
        let identity = identity(path);
        if taken.contains(&identity) {
            bail!(
                "cannot save {}: it is the input or another output; give it a name of its own",
                path.display()
            );
        }
        sweep(identity.parent().unwrap_or(Path::new(".")));
        taken.push(identity);
    }
    Ok(!streams.is_empty())
}

/// Refuses standard output in place of a folder.
pub(super) fn check_folder(folder: &Path) -> Result<()> {
    if is_stream(folder) {
        bail!("- is standard output, which holds no files: give -o the name of a folder");
    }
    Ok(())
}

/// Makes a folder for outputs, if it is not there, and removes what a killed run left in it.
pub(super) fn make_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    sweep(folder);
    Ok(())
}

fn check_file(path: &Path, extensions: &[&str]) -> Result<()> {
    let shown = path.display();
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    if !extensions
        .iter()
        .any(|e| extension.as_deref() == Some(e.as_ref()))
    {
        bail!(
            "cannot save {shown}: its extension must be {}",
            list(extensions)
        );
    }
    let folder = folder(path);
    let mut there = folder.ancestors().filter(|part| part.exists());
    if let Some(file) = there.next().filter(|part| !part.is_dir()) {
        bail!(
            "cannot save {shown}: {} is a file, and no folder",
            file.display()
        );
    }
    if !folder.is_dir() {
        bail!(
            "cannot save {shown}: the folder {} does not exist; create it first",
            folder.display()
        );
    }
    if path.is_dir() {
        bail!("cannot save {shown}: it is a folder; give the name of a file");
    }
    Ok(())
}

/// Writes a file whole or not at all, or to standard output.
pub(super) fn write(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<()> {
    if !is_stream(path) {
        return Ok(write_atomically(path, |file| write(file))?);
    }
    let mut stream = BufWriter::new(io::stdout().lock());
    write(&mut stream)?;
    Ok(stream.flush()?)
}

/// Writes the mesh of a grain and its model, where they are asked for; gives what is odd about the mesh.
pub(super) fn write_grain(args: &FitArgs, grain: &Grain) -> Result<Vec<String>> {
    let mut doubts = Vec::new();
    if let Some(path) = &args.mesh {
        let format = MeshFormat::of(path).unwrap_or(MeshFormat::Ply);
        let mesh = grain.mesh(args.meshing.resolution.into());
        write(path, |file| format.write(&mesh, file))?;
        doubts.extend(solid::lacking(grain, &mesh));
        doubts.extend(rounded(format, &mesh));
    }
    if let Some(path) = &args.output {
        let text = grain_to_json(grain);
        write(path, |file| Ok(writeln!(file, "{text}")?))?;
    }
    Ok(doubts)
}

/// Share of an edge by which rounding moves corners before it is told.
const ROUNDED: f64 = 0.01;

/// Tells of a mesh that its format rounds.
pub(super) fn rounded(format: MeshFormat, mesh: &Mesh) -> Option<String> {
    let share = rounding(format, mesh);
    (share > ROUNDED).then(|| {
        format!(
            "STL holds seven digits of a coordinate, and the scan lies so far from its origin that these move the corners of the mesh by up \
             to {:.0} % of an edge: write PLY or OBJ, or move the scan to its origin.",
            100.0 * share
        )
    })
}

/// By how much coordinates of a mesh are rounded at most, as a share of the mean edge of its triangles: those of STL have 24
/// binary digits, and far from its origin few are left for the body.
fn rounding(format: MeshFormat, mesh: &Mesh) -> f64 {
    if format != MeshFormat::Stl {
        return 0.0;
    }
    let place = |corner: u32| mesh.vertices[corner as usize];
    let edges = mesh.triangles.iter();
    let edges = edges.map(|corners| (place(corners[1]) - place(corners[0])).norm());
    let farthest = mesh.vertices.iter().map(|vertex| vertex.coords.amax());
    let rounding = farthest.fold(0.0, f64::max) * f64::from(f32::EPSILON) / 2.0;
    rounding * mesh.triangles.len() as f64 / edges.sum::<f64>()
}

/// Draws the portrait of a grain into a PNG file.
pub(super) fn write_picture(
    path: &Path,
    grain: &Grain,
    scan: Option<&Scan>,
    title: String,
    unit: Option<Unit>,
) -> Result<()> {
    let caption = Caption {
        title,
        unit: unit.map_or(String::new(), |unit| unit.to_string()),
    };
    write_image(path, &portrait(grain, scan, &caption))
}

/// Writes a picture as PNG.
pub(super) fn write_image(path: &Path, image: &Image) -> Result<()> {
    write(path, |file| {
        let written = image.write_png(file);
        written.map_err(|error| WriteError::Io(io::Error::other(error)))
    })
}

/// Writes the inputs of an engine into a folder.
pub(super) fn write_inputs(folder: &Path, files: &[InputFile<'_>]) -> Result<()> {
    for file in files {
        let path = folder.join(&file.path);
        make_folder(path.parent().unwrap_or(folder))?;
        write(&path, |writer| Ok(file.write(writer)?))?;
    }
    Ok(())
}

/// A sentence of what a folder holds beside the files of a run: an engine would run them too.
pub(super) fn beside(
    folder: &Path,
    files: impl Iterator<Item = impl AsRef<Path>> + Clone,
) -> Option<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_own = |path: &PathBuf| files.clone().any(|own| folder.join(own).starts_with(path));
    let others = entries
        .map(|entry| entry.path())
        .filter(|path| !is_own(path));
    let mut names: Vec<String> = others
        .filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    (!names.is_empty()).then(|| {
        format!(
            "{} also holds what this run did not write: {}.",
            folder.display(),
            names.join(", ")
        )
    })
}

/// What an output is called.
pub(super) fn name(path: &Path) -> String {
    match is_stream(path) {
        true => "standard output".into(),
        false => path.display().to_string(),
    }
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// The same for all names of the same file.
fn identity(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let folder = folder(path).canonicalize().unwrap_or_default();
        folder.join(path.file_name().unwrap_or_default())
    })
}

/// `stl, ply or obj`
fn list(extensions: &[&str]) -> String {
    match extensions {
        [one] => (*one).into(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
        [] => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn stl_rounds_what_is_far_from_its_origin() {
        let mut mesh = Mesh::radial(8, |_| 1.0);
        assert!(rounding(MeshFormat::Stl, &mesh) < 1e-6);
        let offset = Vector3::x() * 1e6;
        mesh.vertices
            .iter_mut()
            .for_each(|vertex| *vertex += offset);
        // Numbers near a million in 24 binary digits are a sixteenth apart.
        let written = |x: f64| f64::from(x as f32);
        let moved = mesh.vertices.iter().map(|v| (written(v.x) - v.x).abs());
        let most = moved.fold(0.0, f64::max);
        let edge = 0.2;
        let share = rounding(MeshFormat::Stl, &mesh) * edge / most;
        assert!((0.7..2.5).contains(&share), "{share}");
        assert_eq!(rounding(MeshFormat::Ply, &mesh), 0.0);
    }
}
