//! Reading a grain from a file.

use super::{Grain, ModelError, grain_from_json};
use crate::scan::{MAX_BYTES, ReadError, read_bytes};
use std::path::{Path, PathBuf};

/// Why [`load_grain`] failed; names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file was read, but its content is not a grain.
    #[error("cannot read a model from {}", path.display())]
    Model {
        /// The file asked for.
        path: PathBuf,
        /// What is wrong with its content.
        source: ModelError,
    },
}

/// Reads a grain from a file of at most [`MAX_BYTES`], packed with gzip or not: what
/// [`save_grain`](crate::export::save_grain) or `grainform fit -o` wrote.
///
/// # Errors
///
/// [`LoadError`].
pub fn load_grain(path: &Path) -> Result<Grain, LoadError> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    grain_from_json(&String::from_utf8_lossy(&bytes)).map_err(|source| LoadError::Model {
        path: path.into(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_there_or_holds_no_grain_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.json");
        let absent = load_grain(&path).unwrap_err();
        assert!(matches!(absent, LoadError::Read(ReadError::Io { .. })));
        std::fs::write(&path, "{}").unwrap();
        let empty = load_grain(&path).unwrap_err();
        assert!(empty.to_string().ends_with("m.json"), "{empty}");
        assert!(matches!(
            empty,
            LoadError::Model {
                source: ModelError::Foreign,
                ..
            }
        ));
    }
}
