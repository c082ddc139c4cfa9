//! Paths as text.

use std::path::Path;

/// A path as text that tells it from others: a byte that is not of UTF-8 is told as `\xff`.
pub(super) fn shown(path: &Path) -> String {
    let chunks = path.as_os_str().as_encoded_bytes().utf8_chunks();
    let chunks = chunks.map(|chunk| format!("{}{}", chunk.valid(), chunk.invalid().escape_ascii()));
    chunks.collect()
}
