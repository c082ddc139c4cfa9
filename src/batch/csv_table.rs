//! Tables in CSV, as `batch` writes them and programs for tables save them again.

use csv::{ErrorKind, StringRecord};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What parts columns where a program saves them in another way, and what it is called.
const OTHERS: [(char, &str); 2] = [(';', "semicolons"), ('\t', "tabs")];

/// Why a table cannot be read. Lines are counted from one, the header's.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum CsvError {
    /// Columns are parted by something else.
    #[error(
        "cannot read {} as CSV: {by} part its columns; save it with commas there, and with points in numbers",
        path.display()
    )]
    Parted {
        /// The file.
        path: PathBuf,
        /// By what.
        by: &'static str,
    },
    /// A row has another number of cells than the header.
    #[error("cannot read {} as CSV: line {line} has {found} cells, and its header has {expected}", path.display())]
    Cells {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// Cells of the row.
        found: u64,
        /// Those of the header.
        expected: u64,
    },
    /// A row is no text.
    #[error("cannot read {} as CSV: line {line} is no text in UTF-8", path.display())]
    NoText {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
    },
    /// The file cannot be read.
    #[error("cannot read {} as CSV: {source}", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
}

impl CsvError {
    fn new(path: &Path, source: csv::Error) -> Self {
        let path = path.to_path_buf();
        let line = source.position().map_or(1, csv::Position::line);
        match source.kind() {
            &ErrorKind::UnequalLengths {
                expected_len,
                len: found,
                ..
            } => Self::Cells {
                path,
                line,
                found,
                expected: expected_len,
            },
            ErrorKind::Utf8 { .. } => Self::NoText { path, line },
            _ => Self::Other { path, source },
        }
    }
}

/// The names of the columns of a table, and its rows.
///
/// # Errors
/// [`CsvError`] where it is none.
pub(crate) fn csv_table(path: &Path) -> Result<(StringRecord, Vec<StringRecord>), CsvError> {
    let failed = |source| CsvError::new(path, source);
    let mut reader = csv::Reader::from_path(path).map_err(failed)?;
    let names = reader.headers().map_err(failed)?.clone();
    if let (1, Some(only)) = (names.len(), names.get(0)) {
        let parted = OTHERS.iter().find(|(by, _)| only.contains(*by));
        if let Some((_, by)) = parted {
            let path = path.into();
            return Err(CsvError::Parted { path, by });
        }
    }
    let rows: Result<_, _> = reader.records().collect();
    Ok((names, rows.map_err(failed)?))
}

/// The texts of a row.
pub(crate) fn texts(row: &StringRecord) -> Vec<String> {
    row.iter().map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Result<(StringRecord, Vec<StringRecord>), CsvError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        csv_table(file.path())
    }

    #[test]
    fn columns_and_rows_are_read_and_what_is_no_table_is_told_with_its_line() {
        let (names, rows) = read(b"path,volume\n\"a, b\",1\n").unwrap();
        assert_eq!(names, vec!["path", "volume"]);
        assert_eq!(rows, [StringRecord::from(vec!["a, b", "1"])]);
        for (bytes, told) in [
            (&b"path;volume\na;1,5\n"[..], "semicolons part its columns"),
            (b"path\tvolume\na\t1\n", "tabs part its columns"),
            (
                b"path,volume\na,1\nb,2,3\n",
                "line 3 has 3 cells, and its header has 2",
            ),
            (b"path,volume\na,\xff\n", "line 2 is no text in UTF-8"),
        ] {
            let error = read(bytes).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
        let error = csv_table(Path::new("no")).unwrap_err().to_string();
        assert!(error.starts_with("cannot read no as CSV: "), "{error}");
    }
}
