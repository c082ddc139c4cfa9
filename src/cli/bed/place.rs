//! The folder of a bed, which is made when the bed begins.

use crate::cli::outputs;
use anyhow::Result;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders that were made for a bed, the innermost first.
pub(super) struct Place(Vec<PathBuf>);

impl Place {
    /// Makes a folder, and those around it that are missing.
    pub(super) fn make(path: &Path) -> Result<Self> {
        let missing = path.ancestors().take_while(|folder| !folder.exists());
        let missing = missing.map(Path::to_path_buf).collect();
        outputs::make_folder(path)?;
        Ok(Self(missing))
    }

    /// Takes away what was made and has stayed empty, for a bed that came to nothing.
    pub(super) fn leave(self) {
        for folder in self.0 {
            // A folder that holds something stays.
            let _ = fs::remove_dir(folder);
        }
    }
}
