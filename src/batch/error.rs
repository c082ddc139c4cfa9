//! Why a batch, or a comparison of two, cannot go on.

use super::csv_table::CsvError;
use crate::export::SaveError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// Why a batch cannot go on. What is wrong with one scan is told in its row.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum BatchError {
    /// A pattern of paths is none.
    #[error("{pattern} is no pattern of paths: {source}")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// Why.
        source: glob::PatternError,
    },
    /// Nothing matches a pattern, or a folder holds no scans.
    #[error("{} names no scans: no file that ends in .{}, packed (.gz) or not", path.display(), endings.join(", ."))]
    Empty {
        /// The pattern or folder.
        path: PathBuf,
        /// How the names of scans end.
        endings: Vec<&'static str>,
    },
    /// A folder to look for scans in is one of results.
    #[error(
        "{} holds the results of a batch, and scans are not looked for in it: name them, or move the results elsewhere",
        folder.display()
    )]
    Results {
        /// The folder.
        folder: PathBuf,
    },
    /// What is named as a scan is no file.
    #[error("{} is no file but a pipe or a device, which a batch cannot read again: save it as a file first", path.display())]
    NoFile {
        /// The pipe or device.
        path: PathBuf,
    },
    /// The results would go into a folder in which scans are looked for.
    #[error(
        "the results cannot go into {}, for scans are looked for in it, and not in a folder of results: give another one \
         with -o, such as {}",
        folder.display(),
        folder.join("results").display()
    )]
    AmongScans {
        /// The folder.
        folder: PathBuf,
    },
    /// A file that would be replaced is not of a batch.
    #[error(
        "{} would be replaced, and no journal.jsonl beside it tells that a batch has written it: give another folder with -o, \
         or remove it",
        path.display()
    )]
    NotOwn {
        /// The file.
        path: PathBuf,
    },
    /// A file is named as the journal of a batch, and is none.
    #[error(
        "{} is not the journal of a batch, which would go there: give another folder with -o, or remove it",
        path.display()
    )]
    NoJournal {
        /// The file.
        path: PathBuf,
    },
    /// No scan is there.
    #[error(
        "there is no {}{}; correct the paths, nothing was written",
        path.display(),
        if *scans == 1 { String::new() } else { format!(", nor any other of the {scans} scans") }
    )]
    Missing {
        /// The first of them.
        path: PathBuf,
        /// How many there should be.
        scans: usize,
    },
    /// A list of paths is not named.
    #[error("@ names no list of paths: write the name of its file behind it, as in @list.txt")]
    NamelessList,
    /// A list of paths is empty.
    #[error("{} names no scans: write a path into each line", path.display())]
    EmptyList {
        /// The list.
        path: PathBuf,
    },
    /// A folder, list or journal cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The folder, list or journal.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Another batch works on the folder.
    #[error(
        "another batch writes into {}: wait until it has ended, or give another folder",
        folder.display()
    )]
    Locked {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder for results cannot be made.
    #[error("cannot make the folder {}: {source}; give another one with -o", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The folder for results cannot be written to.
    #[error(
        "cannot write into {}: {source}; what was done is kept, and the same command goes on from there once the folder can be written to",
        folder.display()
    )]
    Write {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The folder for results is not there any more.
    #[error(
        "the folder {} was removed while the batch wrote into it; the same command begins anew",
        folder.display()
    )]
    Removed {
        /// The folder.
        folder: PathBuf,
    },
    /// A result cannot be saved.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// The threads cannot be started.
    #[error("cannot start the threads: {source}; ask for fewer with --jobs")]
    Threads {
        /// Why.
        source: rayon::ThreadPoolBuildError,
    },
}

/// Why results cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum TableError {
    /// The folder holds no results.
    #[error("{} holds neither results.parquet nor results.csv; make them with grainform batch", folder.display())]
    NoResults {
        /// The folder.
        folder: PathBuf,
    },
    /// The file is a table of something else.
    #[error(
        "{} is no table of grains: it lacks the columns path and status, which those of grainform batch have",
        path.display()
    )]
    NotOurs {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be opened.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file is no CSV.
    #[error(transparent)]
    Csv(#[from] CsvError),
    /// A column of numbers has commas where its decimals begin.
    #[error(
        "the numbers in column {column} of {} have commas before their decimals, such as {cell}: save it with points",
        path.display()
    )]
    DecimalCommas {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// One of its cells.
        cell: String,
    },
    /// The file is packed in a way that is not read.
    #[error(
        "{} is packed by {codec}, which is not read: save it with Snappy, uncompressed, or as CSV",
        path.display()
    )]
    Packed {
        /// The file.
        path: PathBuf,
        /// By what.
        codec: String,
    },
    /// The file is no Parquet.
    #[error("cannot read {} as Parquet: {source}", path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// Why.
        source: parquet::errors::ParquetError,
    },
}
