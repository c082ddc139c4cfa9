//! The printed rows, where they are at hand.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// What is said where they are not.
pub(crate) const ABSENT: &str =
    "(The printed rows are not at hand: `../shared/reference` is not there. They are left out.)";

/// A printed table.
pub(crate) struct Printed {
    /// What is said above it.
    pub(crate) head: String,
    pub(crate) rows: Vec<Row>,
}

/// A printed row: its cells by the names of the columns.
pub(crate) struct Row {
    cells: BTreeMap<String, String>,
}

impl Printed {
    /// The table of a file of `../shared/reference`, if it is there.
    pub(crate) fn read(file: &str) -> Option<Self> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference");
        let text = fs::read_to_string(folder.join(file)).ok()?;
        let (head, lines): (Vec<&str>, Vec<&str>) =
            text.lines().partition(|line| line.starts_with('#'));
        let mut lines = lines.into_iter().map(|line| line.split(','));
        let columns: Vec<&str> = lines.next()?.collect();
        let cells = lines.map(|cells| columns.iter().zip(cells));
        let row = cells.map(|row| Row {
            cells: row
                .map(|(&column, cell)| (column.into(), cell.into()))
                .collect(),
        });
        Some(Self {
            head: head.join(" "),
            rows: row.collect(),
        })
    }
}

impl Row {
    /// A cell, empty where there is no such column.
    pub(crate) fn text(&self, column: &str) -> &str {
        self.cells.get(column).map_or("", String::as_str)
    }

    /// The number in a cell, if it is one.
    pub(crate) fn get(&self, column: &str) -> Option<f64> {
        self.text(column).parse().ok()
    }
}
