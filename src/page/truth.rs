//! What is known of the grains of a folder of results.

use super::error::LotError;
use crate::batch::{csv_table, texts};
use crate::digits::plural;
use csv::StringRecord;
use serde::Serialize;
use std::collections::{HashMap, HashSet};
use std::ffi::OsStr;
use std::path::Path;

/// Measures that an error names.
const MOST_NAMED: usize = 12;

/// What is known of the grains of a folder.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Truth {
    columns: Vec<String>,
    /// A row for each of the table of results, where the grain is known.
    rows: Vec<Option<Vec<String>>>,
    /// How many rows of the table of truths name none of the scans.
    #[serde(skip)]
    strays: usize,
}

impl Truth {
    /// Reads what is known of the scans of a folder of results, of these paths and with these columns.
    ///
    /// # Errors
    /// [`LotError`] where the table tells nothing of them, or not clearly.
    pub(super) fn read(
        path: &Path,
        folder: &Path,
        paths: &[String],
        columns: &[String],
    ) -> Result<Self, LotError> {
        let (own, rows) = csv_table(path)?;
        let found = found(path, &rows, paths)?;
        let named: HashSet<usize> = found.iter().flatten().copied().collect();
        let row = |at: &Option<usize>| at.map(|at| texts(&rows[at]));
        let truth = Self {
            rows: found.iter().map(row).collect(),
            columns: texts(&own),
            strays: rows.len() - named.len(),
        };
        truth.check(path, folder, paths, columns)?;
        Ok(truth)
    }

    /// How many of its rows are of no scan of a folder of results, as a sentence.
    pub(super) fn doubt(&self, truth: &Path, folder: &Path) -> Option<String> {
        let (rows, name) = (
            plural(self.strays, "row"),
            if self.strays == 1 { "names" } else { "name" },
        );
        (self.strays > 0).then(|| {
            format!(
                "{rows} of {} {name} no scan of {}.",
                truth.display(),
                folder.display()
            )
        })
    }

    /// Whether it tells anything of grains and of measures of them.
    fn check(
        &self,
        truth: &Path,
        folder: &Path,
        paths: &[String],
        columns: &[String],
    ) -> Result<(), LotError> {
        let (truth, folder) = (truth.to_path_buf(), folder.to_path_buf());
        let measures = crate::batch::measures(columns);
        if !self.columns.iter().any(|own| measures.contains(own)) {
            let measures = measures.into_iter().take(MOST_NAMED).collect();
            return Err(LotError::NoMeasure {
                folder,
                truth,
                measures,
            });
        }
        let is_of_measure = |(_, own): &(usize, &String)| measures.contains(own);
        for (at, own) in self.columns.iter().enumerate().filter(is_of_measure) {
            if self.columns[..at].contains(own) {
                let column = own.clone();
                return Err(LotError::RepeatedColumn { truth, column });
            }
            let cells = self.rows.iter().flatten().filter_map(|row| row.get(at));
            let is_known = |cell: &&String| !cell.is_empty();
            let is_number = |cell: &String| cell.parse().is_ok_and(f64::is_finite);
            if let Some(cell) = cells.filter(is_known).find(|cell| !is_number(cell)) {
                let (column, cell) = (own.clone(), cell.clone());
                return Err(LotError::NoNumber {
                    truth,
                    column,
                    cell,
                });
            }
        }
        if self.rows.iter().all(Option::is_none) {
            let name = paths.first().map(Path::new).and_then(Path::file_name);
            let example = name.unwrap_or_default().to_string_lossy().into_owned();
            return Err(LotError::NoGrain {
                folder,
                truth,
                example,
            });
        }
        Ok(())
    }
}

/// The row of a table of truths that is of each scan, by its path, or by the name of its file: where no other file is called so, and
/// of rows with the path of no scan.
fn found(
    truth: &Path,
    rows: &[StringRecord],
    paths: &[String],
) -> Result<Vec<Option<usize>>, LotError> {
    let all: HashSet<&str> = paths.iter().map(String::as_str).collect();
    let mut by_path: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut by_name: HashMap<&OsStr, Vec<usize>> = HashMap::new();
    for (at, row) in rows.iter().enumerate() {
        let text = row.get(0).unwrap_or_default();
        match all.contains(text) {
            true => by_path.entry(text).or_default().push(at),
            false => by_name.entry(file_name(text)).or_default().push(at),
        }
    }
    let mut scans: HashMap<&OsStr, usize> = HashMap::new();
    for input in paths {
        *scans.entry(file_name(input)).or_default() += 1;
    }
    let line = |at: usize| rows[at].position().map_or(0, csv::Position::line);
    let of = |input: &String| {
        let name = file_name(input);
        let of_path = by_path.get(input.as_str()).map(Vec::as_slice);
        let of_name = by_name.get(name).map(Vec::as_slice);
        match (of_path, of_name) {
            (Some([row]), _) => Ok(Some(*row)),
            (Some([first, second, ..]), _) => Err(LotError::Repeated {
                truth: truth.into(),
                scan: input.clone(),
                lines: [line(*first), line(*second)],
            }),
            (_, Some([row])) if scans[name] == 1 => Ok(Some(*row)),
            (_, Some([_, ..])) => Err(LotError::Ambiguous {
                truth: truth.into(),
                name: name.to_string_lossy().into_owned(),
                example: input.clone(),
            }),
            _ => Ok(None),
        }
    };
    paths.iter().map(of).collect()
}

fn file_name(path: &str) -> &OsStr {
    Path::new(path).file_name().unwrap_or_default()
}
