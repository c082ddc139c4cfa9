//! Which scans a batch is of.

use super::error::BatchError;
use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

/// How the names of scans end, packed or not: of meshes and points, ...
const SURFACES: [&str; 4] = ["ply", "stl", "obj", "xyz"];

/// ... and of images of labels.
const IMAGES: [&str; 8] = ["nrrd", "nhdr", "mha", "mhd", "nii", "npy", "tif", "tiff"];

/// The file that makes a folder one of results: no scans are looked for in it.
pub(super) const JOURNAL: &str = "journal.jsonl";

/// What is named to a batch.
#[derive(Debug, Default)]
pub(crate) struct Inputs {
    /// Each scan once, by its first name, and each folder that cannot be read.
    pub scans: Vec<PathBuf>,
    /// What is in folders and not named as a scan is, or no file: a pipe, a device.
    pub left_out: Vec<PathBuf>,
}

/// The files that paths name, in their order and each once, by its first name: a file is itself, a folder the scans in it
/// and in its folders, `@list.txt` the paths in its lines, but for those that begin with `#`, and what is no file is a pattern such as `lot*/*.ply`. Links
/// to folders are not followed in folders, nor by `**`. A folder that cannot be read stands for its scans.
///
/// # Errors
/// [`BatchError`] where a list cannot be read, what is named is a pipe or a device, or where nothing is found. A file that
/// is not there, and a folder that cannot be read, are told in their rows.
pub(crate) fn inputs(paths: &[PathBuf]) -> Result<Inputs, BatchError> {
    let mut all = Inputs::default();
    for path in paths {
        all.scans.extend(named(path, &mut all.left_out)?);
    }
    let mut scans = all.scans.iter();
    if let Some(path) = scans.find(|path| is_endless(path)) {
        return Err(BatchError::NoFile { path: path.clone() });
    }
    let mut seen = HashSet::new();
    all.scans.retain(|path| seen.insert(place(path)));
    all.left_out.retain(|path| seen.insert(place(path)));
    Ok(all)
}

/// Refuses a folder for results in which scans are looked for: the next run would find none there.
///
/// # Errors
/// [`BatchError::AmongScans`].
pub(crate) fn check_folder(folder: &Path, paths: &[PathBuf]) -> Result<(), BatchError> {
    let looked_into = paths.iter().filter_map(|path| {
        let text = path.to_string_lossy();
        match text.split_once("**") {
            _ if path.is_dir() => Some(path.clone()),
            Some((before, _)) => Some(plain(before)),
            None => None,
        }
    });
    let results = place(folder);
    let mut folders = looked_into.map(|path| place(&path));
    match folders.any(|folder| folder == results) {
        true => Err(BatchError::AmongScans {
            folder: folder.into(),
        }),
        false => Ok(()),
    }
}

/// Where a path leads; of a file that is not there, where it would.
fn place(path: &Path) -> PathBuf {
    let found = path.canonicalize().or_else(|_| std::path::absolute(path));
    found.unwrap_or_else(|_| path.into())
}

fn named(path: &Path, left_out: &mut Vec<PathBuf>) -> Result<Vec<PathBuf>, BatchError> {
    let text = path.to_string_lossy();
    if let Some(list) = text.strip_prefix('@') {
        if list.is_empty() {
            return Err(BatchError::NamelessList);
        }
        let list = PathBuf::from(list);
        let text = std::fs::read_to_string(&list).map_err(|source| BatchError::Read {
            path: list.clone(),
            source,
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
        let lines = text.lines().map(str::trim);
        let lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
        let paths: Vec<PathBuf> = lines.map(PathBuf::from).collect();
        return match paths.is_empty() {
            true => Err(BatchError::EmptyList { path: list }),
            false => Ok(paths),
        };
    }
    let found = if path.is_dir() {
        if path.join(JOURNAL).is_file() {
            return Err(BatchError::Results {
                folder: path.into(),
            });
        }
        let (scans, others): (Vec<_>, Vec<_>) = files_in(path)?
            .into_iter()
            .partition(|path| path.is_dir() || is_scan(path) && !is_endless(path));
        left_out.extend(others);
        scans
    } else if path.exists() || !text.contains(['*', '?', '[']) {
        vec![path.to_path_buf()]
    } else {
        let (others, found): (Vec<_>, Vec<_>) = matching(&text)?
            .into_iter()
            .partition(|path| is_endless(path));
        left_out.extend(others);
        found
    };
    match found.is_empty() {
        true => Err(BatchError::Empty {
            path: path.into(),
            endings: [&SURFACES[..], &IMAGES].concat(),
        }),
        false => Ok(found),
    }
}

/// Whether something is there that is neither file nor folder, and may never end, such as a pipe.
fn is_endless(path: &Path) -> bool {
    path.exists() && !path.is_file() && !path.is_dir()
}

/// The files that match a pattern, and the folders that were looked into and cannot be read.
fn matching(text: &str) -> Result<Vec<PathBuf>, BatchError> {
    let failed = |source| BatchError::Pattern {
        pattern: text.into(),
        source,
    };
    let Some((before, _)) = text.split_once("**") else {
        let found = glob::glob(text).map_err(failed)?;
        let found = found.filter_map(|found| match found {
            Ok(path) => (!path.is_dir()).then_some(path),
            Err(unread) => Some(unread.path().into()),
        });
        return Ok(found.collect());
    };
    let pattern = glob::Pattern::new(text).map_err(failed)?;
    let folder = plain(before);
    let is_here = folder == Path::new(".") && !before.starts_with('.');
    let options = glob::MatchOptions {
        require_literal_separator: true,
        ..glob::MatchOptions::new()
    };
    let files = files_in(&folder)?.into_iter();
    let files = files.map(|file| match file.strip_prefix(".") {
        Ok(own) if is_here => own.to_path_buf(),
        _ => file,
    });
    Ok(files
        .filter(|file| file.is_dir() || pattern.matches_path_with(file, options))
        .collect())
}

/// The folder that a pattern begins with.
fn plain(pattern: &str) -> PathBuf {
    let is_plain = |part: &Component| !part.as_os_str().to_string_lossy().contains(['*', '?', '[']);
    let parts = Path::new(pattern).components().take_while(is_plain);
    let folder: PathBuf = parts.collect();
    match folder.as_os_str().is_empty() {
        true => ".".into(),
        false => folder,
    }
}

/// The files in a folder and in its folders, by name; also those that are not to be read. A folder that cannot be read is
/// among them, in place of what is in it.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>, BatchError> {
    let mut files = Vec::new();
    walk(folder, &mut files)?;
    files.sort();
    Ok(files)
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), BatchError> {
    if folder.join(JOURNAL).is_file() {
        return Ok(());
    }
    let failed = |source| BatchError::Read {
        path: folder.into(),
        source,
    };
    let entries = match folder.read_dir() {
        Err(_) if folder.is_dir() => {
            files.push(folder.into());
            return Ok(());
        }
        entries => entries.map_err(failed)?,
    };
    for entry in entries {
        let path = entry.map_err(failed)?.path();
        let is_hidden = path
            .file_name()
            .is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        match (path.is_dir(), path.is_symlink()) {
            _ if is_hidden => {}
            (true, true) => {}
            (true, false) => walk(&path, files)?,
            (false, _) => files.push(path),
        }
    }
    Ok(())
}

/// Whether a file is named as an image of labels.
pub(super) fn is_image(path: &Path) -> bool {
    ends_with(path, &IMAGES)
}

fn is_scan(path: &Path) -> bool {
    is_image(path) || ends_with(path, &SURFACES)
}

fn ends_with(path: &Path, extensions: &[&str]) -> bool {
    let is = |path: &Path, extension: &str| {
        path.extension()
            .and_then(OsStr::to_str)
            .is_some_and(|own| own.eq_ignore_ascii_case(extension))
    };
    let unpacked = match is(path, "gz") {
        true => Path::new(path.file_stem().unwrap_or_default()),
        false => path,
    };
    extensions.iter().any(|extension| is(unpacked, extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(folder: &Path, names: &[&str]) {
        for name in names {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "").unwrap();
        }
    }

    /// The scans that paths name, without the folder.
    fn of(folder: &Path, paths: &[PathBuf]) -> Vec<String> {
        let own = |path: PathBuf| path.strip_prefix(folder).unwrap().display().to_string();
        inputs(paths).unwrap().scans.into_iter().map(own).collect()
    }

    #[test]
    fn folders_patterns_and_lists_name_scans_each_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        write(
            folder.path(),
            &["b.ply", "a.STL", "c.xyz.gz", "notes.txt", ".d.ply"],
        );
        let list = format!(
            "# those of May\n{}\n\n{}\n",
            path("notes.txt").display(),
            path("b.ply").display()
        );
        std::fs::write(path("list.txt"), list).unwrap();
        let of = |paths: &[PathBuf]| of(folder.path(), paths);
        assert_eq!(of(&[folder.path().into()]), ["a.STL", "b.ply", "c.xyz.gz"]);
        let found = inputs(&[folder.path().into()]).unwrap();
        assert_eq!(found.left_out, [path("list.txt"), path("notes.txt")]);
        let found = inputs(&[path("notes.txt"), folder.path().into()]).unwrap();
        assert_eq!(
            (found.scans.len(), found.left_out),
            (4, vec![path("list.txt")])
        );
        assert_eq!(of(&[path("[bn]*")]), ["b.ply", "notes.txt"]);
        let list = PathBuf::from(format!("@{}", path("list.txt").display()));
        assert_eq!(of(&[path("b.ply"), list.clone()]), ["b.ply", "notes.txt"]);
        let marked = format!("\u{feff}{}\n", path("b.ply").display());
        std::fs::write(path("list.txt"), marked).unwrap();
        assert_eq!(of(std::slice::from_ref(&list)), ["b.ply"]);
        std::fs::write(path("list.txt"), "\n\n").unwrap();
        let empty = inputs(&[list]);
        assert!(matches!(empty, Err(BatchError::EmptyList { .. })));
        assert_eq!(of(&[path("./b.ply"), path("b.ply")]), ["b.ply"]);
        assert_eq!(of(&[path("gone.ply")]), ["gone.ply"]);
        let nameless = inputs(&["@".into()]);
        assert!(matches!(nameless, Err(BatchError::NamelessList)));
        let nothing = inputs(&[path("*.obj")]);
        assert!(matches!(nothing, Err(BatchError::Empty { .. })));
    }

    #[test]
    fn folders_in_folders_are_looked_into_but_for_results() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        write(
            folder.path(),
            &[
                "z.ply",
                "a/b/y.ply",
                "a/x.nrrd",
                ".git/w.ply",
                "a/notes.txt",
            ],
        );
        write(folder.path(), &["r/journal.jsonl", "r/meshes/z.ply"]);
        let all = ["a/b/y.ply", "a/x.nrrd", "z.ply"];
        assert_eq!(of(folder.path(), &[folder.path().into()]), all);
        let results = inputs(&[path("r")]);
        assert!(matches!(results, Err(BatchError::Results { .. })));
        let of = |pattern: &str| of(folder.path(), &[path(pattern)]);
        assert_eq!(of("**/*.ply"), ["a/b/y.ply", "z.ply"]);
        assert_eq!(of("a*/**/y.ply"), ["a/b/y.ply"]);
    }

    #[test]
    fn results_go_where_no_scans_are_looked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        write(folder.path(), &["lot/a.ply", "lot/in/b.ply"]);
        let is_refused = |output: &str, named: &str| {
            let found = check_folder(&path(output), &[path("lot/a.ply"), path(named)]);
            matches!(found, Err(BatchError::AmongScans { .. }))
        };
        for named in ["lot", "lot/", "lot/../lot", "lot/**/*.ply"] {
            assert!(is_refused("lot", named), "{named}");
            assert!(!is_refused("lot/r", named) && !is_refused("r", named));
        }
        for named in ["lot/in", "lot/*.ply", "lot/a.ply"] {
            assert!(!is_refused("lot", named), "{named}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_lead_to_each_file_once_and_a_dangling_one_is_named() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        write(folder.path(), &["a.ply", "in/b.ply"]);
        symlink("..", path("in/loop")).unwrap();
        symlink("a.ply", path("c.ply")).unwrap();
        symlink("nowhere", path("d.ply")).unwrap();
        let all = ["a.ply", "d.ply", "in/b.ply"];
        assert_eq!(of(folder.path(), &[folder.path().into()]), all);
        assert_eq!(of(folder.path(), &[path("**/*.ply")]), all);
        assert_eq!(of(folder.path(), &[path("*.ply")]), all[..2]);
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        write(folder.path(), &["a.ply"]);
        let _socket = std::os::unix::net::UnixListener::bind(path("b.ply")).unwrap();
        std::os::unix::fs::symlink("b.ply", path("c.ply")).unwrap();
        for named in ["", "*.ply", "**/*.ply"] {
            let found = inputs(&[path(named)]).unwrap();
            assert_eq!(found.scans, [path("a.ply")], "{named}");
            assert_eq!(found.left_out, [path("b.ply")], "{named}");
        }
        std::fs::write(
            path("list.txt"),
            path("c.ply").as_os_str().as_encoded_bytes(),
        )
        .unwrap();
        let list = PathBuf::from(format!("@{}", path("list.txt").display()));
        for named in [path("b.ply"), list] {
            let refused = inputs(&[path("a.ply"), named]);
            assert!(matches!(refused, Err(BatchError::NoFile { .. })));
        }
    }
}
