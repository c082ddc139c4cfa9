//! The part of a page about a folder of results.

use super::error::LotError;
use super::surfaces::Surfaces;
use super::truth::Truth;
use crate::batch::{Gaps, RowKey, SavedModels, results_table, texts};
use csv::StringRecord;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::Path;

/// What a page shows of a folder of results.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LotPart {
    name: String,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
    truth: Option<Truth>,
    /// The unit of lengths, as a sentence; `None` where they are in several.
    lengths: Option<String>,
    /// What is odd about the results and what lies beside them: whole sentences.
    warnings: Vec<String>,
    #[serde(flatten)]
    surfaces: Surfaces,
}

impl LotPart {
    /// Cells along an edge of the cube of directions of the surfaces.
    pub(super) fn resolution(&self) -> usize {
        self.surfaces.resolution
    }

    /// What is odd about the results and what lies beside them: whole sentences.
    pub(crate) fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Reads the table in a folder of results, and surfaces from the models that were saved with its rows, of a thousand
    /// grains at most. `truth` is a table whose first column names scans by their paths, or by their files where each name
    /// is there once, and whose others are called as those of results.
    ///
    /// # Errors
    /// [`LotError`] where there is no table, where its journal cannot be read, or where `truth` tells nothing of what it
    /// holds, or not clearly.
    pub(crate) fn read(folder: &Path, truth: Option<&Path>) -> Result<Self, LotError> {
        let path = folder.join("results.csv");
        if !path.is_file() {
            return Err(LotError::NoTable {
                folder: folder.into(),
            });
        }
        let (names, rows) = results_table(&path)?;
        let columns = texts(&names);
        let keys: Vec<RowKey> = rows.iter().map(|row| key(&columns, row)).collect();
        let paths: Vec<String> = keys.iter().map(|key| key.path.into()).collect();
        let known = truth.map(|path| Truth::read(path, folder, &paths, &columns));
        let known = known.transpose()?;
        let saved = SavedModels::read(folder).map_err(|source| LotError::Journal {
            folder: folder.into(),
            source,
        })?;
        let surfaces = Surfaces::read(folder, &keys, &saved);
        let of_truth = truth.zip(known.as_ref());
        let of_truth = of_truth.and_then(|(path, known)| known.doubt(path, folder));
        let fitted = rows
            .iter()
            .filter(|row| cell(&columns, row, "status") != "failed");
        let units = fitted.map(|row| cell(&columns, row, "unit")).collect();
        let doubts = [
            several_units(folder, &units),
            gaps(folder, &columns, &rows),
            of_truth,
        ];
        let doubts = doubts.into_iter().flatten();
        Ok(Self {
            name: folder.display().to_string(),
            truth: known,
            warnings: doubts.chain(surfaces.doubts(folder)).collect(),
            surfaces,
            lengths: unit_of_lengths(&units),
            rows: rows.iter().map(texts).collect(),
            columns,
        })
    }
}

/// The cell of a row in the column of this name; empty where there is none.
fn cell<'a>(columns: &[String], row: &'a StringRecord, name: &str) -> &'a str {
    let at = columns.iter().position(|column| column == name);
    at.and_then(|at| row.get(at)).unwrap_or_default()
}

fn key<'a>(columns: &[String], row: &'a StringRecord) -> RowKey<'a> {
    let cell = |name| cell(columns, row, name);
    RowKey {
        path: cell("path"),
        hash: cell("hash"),
        settings: cell("settings"),
        version: cell("version"),
    }
}

/// What is known of fewer grains than were fitted, if so.
fn gaps(folder: &Path, columns: &[String], rows: &[StringRecord]) -> Option<String> {
    let mut gaps = Gaps::new(columns.iter().map(String::as_str));
    let cell = |row, name| cell(columns, row, name);
    for row in rows.iter().filter(|row| cell(row, "status") != "failed") {
        let is_known = |at: usize| row.get(at).is_some_and(|cell| !cell.is_empty());
        gaps.hear(is_known, cell(row, "not_measured").split(" | "));
    }
    gaps.sentence(&format!(" of {}", folder.display()))
}

/// That the lengths of the scans are in several units, if so. Of a scan that tells none the unit is empty.
fn several_units(folder: &Path, units: &BTreeSet<&str>) -> Option<String> {
    let told: Vec<&str> = units
        .iter()
        .copied()
        .filter(|unit| !unit.is_empty())
        .collect();
    (told.len() > 1).then(|| {
        format!(
            "Lengths in {} are in {}, as the column unit tells of each scan: compare no lengths, areas or volumes across \
             units.",
            folder.display(),
            told.join(" and ")
        )
    })
}

/// The one unit of all lengths, as a sentence.
fn unit_of_lengths(units: &BTreeSet<&str>) -> Option<String> {
    match Vec::from_iter(units.iter().copied())[..] {
        [] | [""] => Some("Lengths are in the unit of the scans, which these do not tell.".into()),
        ["", unit] => Some(format!(
            "Lengths are in {unit}, but for scans that tell no unit."
        )),
        [unit] => Some(format!(
            "Lengths are in {unit}, areas and volumes in its powers."
        )),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_of_lengths_is_told_where_there_is_one() {
        let told = |units: &[&str]| unit_of_lengths(&units.iter().copied().collect());
        assert!(told(&[""]).unwrap().contains("do not tell"));
        assert!(
            told(&["mm", "mm"])
                .unwrap()
                .starts_with("Lengths are in mm, areas")
        );
        assert!(
            told(&["um", ""])
                .unwrap()
                .starts_with("Lengths are in um, but")
        );
        assert_eq!(told(&["mm", "um"]), None);
        assert_eq!(told(&["", "mm", "um"]), None);
    }
}
