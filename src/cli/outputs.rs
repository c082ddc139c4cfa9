//! Checks of the files to write, before any work is done for them.

use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

/// Extensions of meshes.
pub(super) const MESH: &[&str] = &["stl", "ply", "obj"];

/// Refuses outputs that would fail at the end: each has a known extension, its folder exists, and it
/// is neither the input nor another output.
pub(super) fn check(input: Option<&Path>, outputs: &[(Option<&Path>, &[&str])]) -> Result<()> {
    let mut taken: Vec<PathBuf> = input.map(identity).into_iter().collect();
    for (path, extensions) in outputs {
        let Some(path) = path else { continue };
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
        if !folder.is_dir() {
            bail!(
                "cannot save {shown}: the folder {} does not exist; create it first",
                folder.display()
            );
        }
        if path.is_dir() {
            bail!("cannot save {shown}: it is a folder; give the name of a file");
        }
        let identity = identity(path);
        if taken.contains(&identity) {
            bail!(
                "cannot save {shown}: it is the input or another output; give it a name of its own"
            );
        }
        taken.push(identity);
    }
    Ok(())
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
