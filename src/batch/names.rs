//! What models and meshes of a batch are called.

use super::queue::{with_label, without_label};
use super::shown::shown;
use std::collections::{HashMap, HashSet};
use std::iter::once;
use std::path::{Path, PathBuf};

/// Bytes of a name at most: a label, a number and the ending of a file are beside it in the 255 that file systems take.
const LONGEST: usize = 200;

/// Letters of a hash, by which long names are told apart.
const HASH: usize = 16;

/// A name for every scan, by which its model and its mesh are saved: that of its file, or where several have it or it has
/// a `#`, that of its path. Where that is taken too, as of `lot/x/1.ply` by `lot_x/1.ply`, a number follows.
/// One that is too long for a file is cut.
pub(super) fn of_scans(scans: &[PathBuf]) -> Vec<String> {
    let mut counts = HashMap::new();
    for path in scans {
        *counts.entry(stem(path)).or_insert(0_usize) += 1;
    }
    // A file may be called as the label of an image is.
    let is_plain = |stem: &String| !stem.contains('#') && counts.get(stem) == Some(&1);
    let name = |path: &PathBuf| {
        Some(stem(path))
            .filter(is_plain)
            .unwrap_or_else(|| plain(path))
    };
    let mut taken = HashSet::new();
    let mut free = |name: String| {
        let numbered = (2..).map(|number| format!("{name}_{number}"));
        let mut names = once(name.clone()).chain(numbered);
        names
            .find(|name| taken.insert(name.clone()))
            .unwrap_or(name)
    };
    scans.iter().map(|path| free(cut(name(path)))).collect()
}

/// The names of models by the rows of results.
pub(crate) fn names(rows: &[String]) -> Vec<String> {
    let rows = rows.iter().map(|row| without_label(row));
    let mut scans: Vec<PathBuf> = rows.clone().map(|(scan, _)| scan.into()).collect();
    // The labels of an image are in a row.
    scans.dedup();
    let names = of_scans(&scans);
    let mut at = 0;
    rows.map(|(scan, label)| {
        while scans[at] != Path::new(scan) {
            at += 1;
        }
        with_label(&names[at], label)
    })
    .collect()
}

/// A name as it is or, where it is too long, its beginning and a hash of all of it.
fn cut(name: String) -> String {
    if name.len() <= LONGEST {
        return name;
    }
    let ends = name.char_indices().map(|(end, _)| end);
    let end = ends.take_while(|end| end + 1 + HASH <= LONGEST).last();
    let hash = blake3::hash(name.as_bytes()).to_hex();
    format!("{}_{}", &name[..end.unwrap_or(0)], &hash[..HASH])
}

/// A path in one word; `./` at its beginning would hide the file.
fn plain(path: &Path) -> String {
    let path = path.strip_prefix(".").unwrap_or(path);
    shown(path).replace(['/', '\\', ':'], "_")
}

fn stem(path: &Path) -> String {
    shown(Path::new(path.file_stem().unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_called_as_their_scans_or_their_paths_and_by_their_labels() {
        let rows = ["a/ct.nrrd#1", "a/ct.nrrd#-2", "a/b.ply", "c/b.ply", "d#3"].map(String::from);
        let expected = ["ct#1", "ct#-2", "a_b.ply", "c_b.ply", "d#3"];
        assert_eq!(names(&rows), expected);
    }

    #[test]
    fn no_two_are_called_alike() {
        let rows = ["./lot/x/1.ply", "lot_x/1.ply", "lot_x_1.ply.ply"].map(String::from);
        let expected = ["lot_x_1.ply", "lot_x_1.ply_2", "lot_x_1.ply_3"];
        assert_eq!(names(&rows), expected);
        let rows = ["a/im#5.ply", "a/im.nrrd#5"].map(String::from);
        assert_eq!(names(&rows), ["a_im#5.ply", "im#5"]);
    }

    #[test]
    fn long_names_are_cut_and_told_apart() {
        let long = "\u{e4}".repeat(125);
        let rows = [
            format!("{long}.ply"),
            format!("{long}b.ply"),
            "b.ply".into(),
        ];
        let found = names(&rows);
        assert!(found[..2].iter().all(|name| name.len() <= LONGEST));
        let start = &long[..LONGEST - HASH - 2];
        assert!(found[..2].iter().all(|name| name.starts_with(start)));
        assert_ne!(found[0], found[1]);
        assert_eq!(found[2], "b");
        assert_eq!(names(&rows[1..])[0], found[1]);
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf_8_are_told_apart() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let path = |bytes: &[u8]| PathBuf::from(OsStr::from_bytes(bytes));
        let scans = [path(b"lot/\xff\xc3\xa4.ply"), path(b"lot/\xfe\xc3\xa4.ply")];
        assert_eq!(
            scans.each_ref().map(|scan| shown(scan)),
            [r"lot/\xffä.ply", r"lot/\xfeä.ply"]
        );
        let rows = scans.each_ref().map(|scan| shown(scan));
        assert_eq!(of_scans(&scans), [r"\xffä", r"\xfeä"]);
        assert_eq!(names(&rows), of_scans(&scans));
    }
}
