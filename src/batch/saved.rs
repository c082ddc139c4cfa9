//! Whether a model is the one that was saved with a row of results.

use super::inputs::JOURNAL;
use super::journal::{Key, key, saved_models};
use std::collections::HashMap;
use std::io;
use std::path::Path;

/// What a row of results depends on, as its cells tell.
#[derive(Debug, Clone)]
pub(crate) struct RowKey<'a> {
    /// The scan, as it was named.
    pub path: &'a str,
    /// Hash of its bytes.
    pub hash: &'a str,
    /// What was asked for.
    pub settings: &'a str,
    /// Version of this library.
    pub version: &'a str,
}

/// The models that were saved with the rows of a folder of results, as its journal tells.
#[derive(Debug)]
pub(crate) struct SavedModels(HashMap<Key, Option<String>>);

impl SavedModels {
    /// Those of a folder of results; none where it has no journal.
    ///
    /// # Errors
    /// Where the journal cannot be read.
    pub(crate) fn read(folder: &Path) -> io::Result<Self> {
        match saved_models(&folder.join(JOURNAL)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Self(HashMap::new())),
            models => models.map(Self),
        }
    }

    /// Whether a model of these bytes was saved with a row.
    pub(crate) fn has(&self, bytes: &[u8], row: &RowKey) -> bool {
        let key = key(row.path, row.hash, row.settings, row.version);
        let is_same = |saved: &String| blake3::hash(bytes).to_hex().as_str() == saved;
        self.0
            .get(&key)
            .and_then(Option::as_ref)
            .is_some_and(is_same)
    }
}
