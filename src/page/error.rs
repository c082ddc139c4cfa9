//! Why a folder of results is not shown.

use crate::batch::{CsvError, TableError};
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a folder of results is not shown.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum LotError {
    /// There is no table.
    #[error("{} holds no results.csv; make one with grainform batch", folder.display())]
    NoTable {
        /// The folder.
        folder: PathBuf,
    },
    /// A table of truths tells nothing of the grains.
    #[error(
        "no scan of {} is named in the first column of {}: name there the files of the scans, such as {example}",
        folder.display(), truth.display()
    )]
    NoGrain {
        /// The folder of results.
        folder: PathBuf,
        /// The table.
        truth: PathBuf,
        /// The name of one of the scans.
        example: String,
    },
    /// A name in a table of truths is that of several grains.
    #[error(
        "which {name} of {} is meant is not clear: write the scans' paths into its first column, such as {example}",
        truth.display()
    )]
    Ambiguous {
        /// The table.
        truth: PathBuf,
        /// The name of the files.
        name: String,
        /// The path of one of the scans.
        example: String,
    },
    /// A table of truths tells of a scan twice.
    #[error(
        "{} tells of {scan} twice, in lines {} and {}: leave one of them",
        truth.display(), lines[0], lines[1]
    )]
    Repeated {
        /// The table.
        truth: PathBuf,
        /// The path of the scan.
        scan: String,
        /// The lines.
        lines: [u64; 2],
    },
    /// A table of truths has two columns of one measure.
    #[error("{} has two columns that are called {column}: leave one of them", truth.display())]
    RepeatedColumn {
        /// The table.
        truth: PathBuf,
        /// The name of the columns.
        column: String,
    },
    /// A cell of a table of truths is no number.
    #[error(
        "{} tells {cell:?} as {column}, which is no number: write it with a point and without other marks, and leave the cell \
         empty where nothing is known",
        truth.display()
    )]
    NoNumber {
        /// The table.
        truth: PathBuf,
        /// The name of the column.
        column: String,
        /// The cell.
        cell: String,
    },
    /// A table of truths tells nothing that was measured.
    #[error(
        "no column of {} is called as a measure in {}; call them as these are: {}",
        truth.display(), folder.display(), measures.join(", ")
    )]
    NoMeasure {
        /// The folder of results.
        folder: PathBuf,
        /// The table.
        truth: PathBuf,
        /// Names of measures.
        measures: Vec<String>,
    },
    /// The table of results is none.
    #[error(transparent)]
    Results(#[from] TableError),
    /// That of truths is none.
    #[error(transparent)]
    Truth(#[from] CsvError),
    /// The journal of the results cannot be read.
    #[error("cannot read the journal of {}: {source}", folder.display())]
    Journal {
        /// The folder of results.
        folder: PathBuf,
        /// Why.
        source: io::Error,
    },
}
