//! Models and meshes that earlier runs left.

use super::grain::hash;
use super::names::names;
use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

/// The folder of models, and ...
pub(super) const MODELS: &str = "models";

/// ... that of meshes.
pub(super) const MESHES: &str = "meshes";

/// The file of the model that is called so, in the folder of results.
pub(crate) fn model(folder: &Path, name: &str) -> PathBuf {
    folder.join(MODELS).join(format!("{name}.json"))
}

/// The file of the mesh that is called so, in the folder of results.
pub(super) fn mesh(folder: &Path, name: &str) -> PathBuf {
    folder.join(MESHES).join(format!("{name}.ply"))
}

/// The files of models and meshes in the folder of results that were not saved with a row: of other scans, or of other
/// settings. Of all rows, `paths` are the names, and `hashes` those of their model and their mesh, where they have one;
/// `is_known` tells of either whether this run has saved or read those of all rows.
///
/// # Errors
/// Where a folder that is there cannot be read.
pub(super) fn left_over(
    folder: &Path,
    paths: &[String],
    hashes: Vec<[Option<String>; 2]>,
    is_known: [bool; 2],
) -> io::Result<Vec<PathBuf>> {
    let mut saved = HashMap::new();
    for (name, [of_model, of_mesh]) in names(paths).iter().zip(hashes) {
        saved.extend(of_model.map(|hash| (model(folder, name), hash)));
        saved.extend(of_mesh.map(|hash| (mesh(folder, name), hash)));
    }
    let mut left = Vec::new();
    for (files, is_known) in [MODELS, MESHES]
        .map(|name| folder.join(name))
        .iter()
        .zip(is_known)
    {
        if !files.is_dir() {
            continue;
        }
        for entry in files.read_dir()? {
            let path = entry?.path();
            let is_saved = |of_row: &String| is_known || hash(&path).as_ref() == Some(of_row);
            if !saved.get(&path).is_some_and(is_saved) {
                left.push(path);
            }
        }
    }
    left.sort();
    Ok(left)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_saved_with_a_row_is_left_over() {
        let folder = tempfile::tempdir().unwrap();
        let [own, other] = ["a", "b"].map(|name| model(folder.path(), name));
        let own_mesh = mesh(folder.path(), "a");
        for path in [&own, &other, &own_mesh] {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, path.as_os_str().as_encoded_bytes()).unwrap();
        }
        let left = |of_model: Option<String>, is_known: bool| {
            let hashes = vec![[of_model, hash(&own_mesh)]];
            left_over(folder.path(), &["a.ply".into()], hashes, [is_known, false]).unwrap()
        };
        let own_hash = hash(&own);
        let both = [own, other];
        assert_eq!(left(own_hash, false), both[1..]);
        let of_other_settings = Some("of other settings".to_owned());
        assert_eq!(left(of_other_settings.clone(), false), both);
        assert_eq!(left(None, true), both);
        // What this run has saved is not read again.
        assert_eq!(left(of_other_settings, true), both[1..]);
    }
}
