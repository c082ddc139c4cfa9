//! Which scans a batch is of.

use super::error::BatchError;
use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// How the names of scans end, packed or not.
const EXTENSIONS: [&str; 12] = [
    "ply", "stl", "obj", "xyz", "nrrd", "nhdr", "mha", "mhd", "nii", "npy", "tif", "tiff",
];

/// The files that paths name, in their order and each once: a file is itself, a folder the scans right in it by name,
/// `@list.txt` the paths in its lines, and what is no file is a pattern such as `lot*/*.ply`.
///
/// # Errors
/// [`BatchError`] where a folder or list cannot be read, or where nothing is found. A file that is not there is told in
/// its row.
pub(crate) fn inputs(paths: &[PathBuf]) -> Result<Vec<PathBuf>, BatchError> {
    let mut all = Vec::new();
    for path in paths {
        all.extend(named(path)?);
    }
    let mut seen = HashSet::new();
    all.retain(|path| seen.insert(path.clone()));
    Ok(all)
}

fn named(path: &Path) -> Result<Vec<PathBuf>, BatchError> {
    let text = path.to_string_lossy();
    if let Some(list) = text.strip_prefix('@') {
        let list = PathBuf::from(list);
        let text = std::fs::read_to_string(&list)
            .map_err(|source| BatchError::Read { path: list, source })?;
        let lines = text.lines().map(str::trim);
        return Ok(lines
            .filter(|line| !line.is_empty())
            .map(PathBuf::from)
            .collect());
    }
    let found = if path.is_dir() {
        scans_in(path)?
    } else if path.exists() || !text.contains(['*', '?', '[']) {
        vec![path.to_path_buf()]
    } else {
        let pattern = glob::glob(&text).map_err(|source| BatchError::Pattern {
            pattern: text.into_owned(),
            source,
        })?;
        pattern.flatten().filter(|path| path.is_file()).collect()
    };
    match found.is_empty() {
        true => Err(BatchError::Empty {
            path: path.into(),
            endings: &EXTENSIONS,
        }),
        false => Ok(found),
    }
}

fn scans_in(folder: &Path) -> Result<Vec<PathBuf>, BatchError> {
    let entries = folder.read_dir().map_err(|source| BatchError::Read {
        path: folder.into(),
        source,
    })?;
    let mut scans: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.is_file() && is_scan(path))
        .collect();
    scans.sort();
    Ok(scans)
}

fn is_scan(path: &Path) -> bool {
    let is = |path: &Path, extension: &str| {
        path.extension()
            .is_some_and(|own| own.eq_ignore_ascii_case(extension))
    };
    let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
    let unpacked = match is(path, "gz") {
        true => Path::new(path.file_stem().unwrap_or_default()),
        false => path,
    };
    !name.starts_with('.') && EXTENSIONS.iter().any(|extension| is(unpacked, extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_patterns_and_lists_name_scans_each_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["b.ply", "a.STL", "c.xyz.gz", "notes.txt", ".d.ply"] {
            std::fs::write(path(name), "").unwrap();
        }
        let list = format!(
            "{}\n\n{}\n",
            path("notes.txt").display(),
            path("b.ply").display()
        );
        std::fs::write(path("list.txt"), list).unwrap();
        let of = |paths: &[PathBuf]| -> Vec<String> {
            let names = inputs(paths).unwrap().into_iter();
            names
                .map(|path| path.file_name().unwrap().to_str().unwrap().into())
                .collect()
        };
        assert_eq!(of(&[folder.path().into()]), ["a.STL", "b.ply", "c.xyz.gz"]);
        assert_eq!(of(&[path("[bn]*")]), ["b.ply", "notes.txt"]);
        let list = PathBuf::from(format!("@{}", path("list.txt").display()));
        assert_eq!(of(&[path("b.ply"), list]), ["b.ply", "notes.txt"]);
        assert_eq!(of(&[path("gone.ply")]), ["gone.ply"]);
        let nothing = inputs(&[path("*.obj")]);
        assert!(matches!(nothing, Err(BatchError::Empty { .. })));
    }
}
