//! What a former bed has left in a folder.

use super::names::{FRAMES, PICTURE, STATE, VTK};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

/// Removes all files of the names that a bed writes, and the folder of frames if nothing else is in it.
pub(super) fn clear(folder: &Path) -> io::Result<()> {
    for name in [STATE, VTK, PICTURE] {
        there(fs::remove_file(folder.join(name)))?;
    }
    let frames = folder.join(FRAMES);
    let Some(entries) = there(frames.read_dir())? else {
        return Ok(());
    };
    let mut is_empty = true;
    for entry in entries {
        let entry = entry?;
        match entry.file_name().to_str().is_some_and(is_frame) {
            true => fs::remove_file(entry.path())?,
            false => is_empty = false,
        }
    }
    match is_empty {
        true => fs::remove_dir(frames),
        false => Ok(()),
    }
}

/// Nothing where there is no such file.
fn there<T>(found: io::Result<T>) -> io::Result<Option<T>> {
    match found {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        found => found.map(Some),
    }
}

/// Whether a file is named as a frame of ours or of another engine is.
fn is_frame(name: &str) -> bool {
    let number = name
        .strip_prefix("bed.")
        .and_then(|rest| rest.strip_suffix(".dump"));
    number.is_some_and(|number| {
        !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_beds_are_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let left = |name: &str| {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, "").unwrap();
            path
        };
        let own = [STATE, "bed.vtk", "frames/bed.00002.dump"].map(left);
        let others = ["notes.txt", "frames/bed.notes.dump", "frames/a.dump"].map(left);
        clear(folder.path()).unwrap();
        assert!(own.iter().all(|path| !path.exists()));
        assert!(others.iter().all(|path| path.exists()));
        for path in &others[1..] {
            fs::remove_file(path).unwrap();
        }
        clear(folder.path()).unwrap();
        assert!(!folder.path().join(FRAMES).exists());
    }
}
