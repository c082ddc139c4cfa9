//! Reading results again.

use super::columns::{FIRST, are_results, is_figure};
use super::csv_table::csv_table;
use super::error::TableError;
use super::queue::without_label;
use crate::digits::plural;
use csv::StringRecord;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Display;
use std::fs::File;
use std::path::{Path, PathBuf};

/// The figures of a lot of grains: names of columns of numbers, and what is known in each.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub(crate) struct Lot {
    /// Names of the columns, in their order.
    pub names: Vec<String>,
    /// What is known of the grains, a list for each column.
    pub values: Vec<Vec<f64>>,
    /// The units of length that are told of them; none where none is.
    pub units: BTreeSet<String>,
    /// How many of the grains tell none.
    pub unitless: usize,
    /// How its grains were fitted: the values of each setting, and the versions that fitted them.
    pub settings: BTreeMap<String, BTreeSet<String>>,
    /// Its scans: the hash of each, and the label of a grain in an image.
    pub scans: BTreeSet<(String, Option<i64>)>,
    /// How many more grains it has than scans.
    pub copies: usize,
    /// Of a column of figures, how many cells hold something that is no finite number.
    pub unread: BTreeMap<String, usize>,
}

/// Reads the figures in a folder of results, or in any table, as Parquet if it is so named, else as CSV.
///
/// # Errors
/// [`TableError`] where there are none.
pub(crate) fn read_lot(path: &Path) -> Result<Lot, TableError> {
    Ok(read_table(path)?.figures())
}

/// Reads the figures in results of a batch, and refuses any other table.
///
/// # Errors
/// [`TableError`] where there are none.
pub(crate) fn read_results(path: &Path) -> Result<Lot, TableError> {
    let table = read_table(path)?;
    check_ours(path, table.names.iter().map(String::as_str))?;
    Ok(table.figures())
}

/// The names of the columns of results of a batch in CSV, and the rows.
///
/// # Errors
/// [`TableError`] where it is none, or another table.
pub(crate) fn results_table(path: &Path) -> Result<(StringRecord, Vec<StringRecord>), TableError> {
    let (names, rows) = csv_table(path)?;
    check_ours(path, names.iter())?;
    check_decimals(path, &names, &rows)?;
    Ok((names, rows))
}

/// Refuses figures with decimal commas.
fn check_decimals(
    path: &Path,
    names: &StringRecord,
    rows: &[StringRecord],
) -> Result<(), TableError> {
    for (column, cell) in rows.iter().flat_map(|row| names.iter().zip(row)) {
        if is_decimal_comma(cell) && is_figure(column) {
            return Err(TableError::DecimalCommas {
                path: path.into(),
                column: column.into(),
                cell: cell.into(),
            });
        }
    }
    Ok(())
}

fn check_ours<'a>(
    path: &Path,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<(), TableError> {
    let error = || TableError::NotOurs { path: path.into() };
    are_results(names).then_some(()).ok_or_else(error)
}

fn read_table(path: &Path) -> Result<Lot, TableError> {
    let path = match path.is_dir() {
        true => table_in(path)?,
        false => path.to_path_buf(),
    };
    match path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"))
    {
        true => of_parquet(&path),
        false => of_csv(&path),
    }
}

/// The table that is edited and shown, if it is there.
fn table_in(folder: &Path) -> Result<PathBuf, TableError> {
    let paths = ["results.csv", "results.parquet"].map(|name| folder.join(name));
    let found = paths.into_iter().find(|path| path.is_file());
    found.ok_or_else(|| TableError::NoResults {
        folder: folder.into(),
    })
}

impl Lot {
    fn of_columns<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let names: Vec<String> = names.map(str::to_owned).collect();
        let values = vec![Vec::new(); names.len()];
        Self {
            names,
            values,
            ..Self::default()
        }
    }

    /// Hears the texts of a row, by the names of their columns. Whether it is that of a grain.
    fn hear(&mut self, row: &HashMap<&str, &str>) -> bool {
        let cell = |name: &str| row.get(name).copied().filter(|cell| !cell.is_empty());
        if cell("status") == Some("failed") {
            return false;
        }
        match cell("unit") {
            Some(unit) => drop(self.units.insert(unit.into())),
            None => self.unitless += 1,
        }
        let settings = cell("settings").unwrap_or_default().split(' ');
        let settings = settings.filter_map(|setting| setting.split_once('='));
        let version = cell("version").map(|version| ("version", version));
        for (name, value) in settings.chain(version) {
            let values = self.settings.entry(name.into()).or_default();
            values.insert(value.into());
        }
        if let Some(hash) = cell("hash") {
            let (_, label) = without_label(cell("path").unwrap_or_default());
            self.copies += usize::from(!self.scans.insert((hash.into(), label)));
        }
        true
    }

    /// What is taken for granted of grains that tell no unit, where the others of the lot tell one.
    pub(crate) fn taken_unit(&self, shown: impl Display) -> Option<String> {
        let unit = self.units.first().filter(|_| self.unitless > 0)?;
        let grains = plural(self.unitless, "grain");
        Some(format!(
            "{shown} tells no unit of {grains}: lengths are taken to be in {unit} there too."
        ))
    }

    /// Takes the value of a cell: NaN is one that is not known.
    fn take(&mut self, column: usize, value: f64) {
        if value.is_finite() {
            self.values[column].push(value);
        } else if !value.is_nan() {
            *self.unread.entry(self.names[column].clone()).or_default() += 1;
        }
    }

    /// Leaves out what is no figure of a grain.
    fn figures(mut self) -> Self {
        let is_figure = |name: &str| {
            let described = FIRST.iter().any(|(first, _)| *first == name);
            !described && !name.ends_with("_se")
        };
        let columns = self.names.drain(..).zip(self.values.drain(..));
        let (names, values) = columns
            .filter(|(name, values)| is_figure(name) && !values.is_empty())
            .unzip();
        let names: Vec<String> = names;
        self.unread.retain(|name, _| names.contains(name));
        Self {
            names,
            values,
            ..self
        }
    }
}

fn of_csv(path: &Path) -> Result<Lot, TableError> {
    let (names, rows) = csv_table(path)?;
    check_decimals(path, &names, &rows)?;
    let mut lot = Lot::of_columns(names.iter());
    for row in &rows {
        if !lot.hear(&names.iter().zip(row).collect()) {
            continue;
        }
        for (at, cell) in row.iter().enumerate() {
            match cell.trim() {
                "" => {}
                cell => lot.take(at, cell.parse().unwrap_or(f64::INFINITY)),
            }
        }
    }
    Ok(lot)
}

/// Whether it is a number but for the comma before its decimals.
fn is_decimal_comma(cell: &str) -> bool {
    let cell = cell.trim();
    let is_number = |text: &str| text.parse::<f64>().is_ok_and(f64::is_finite);
    !is_number(cell) && is_number(&cell.replacen(',', ".", 1))
}

fn of_parquet(path: &Path) -> Result<Lot, TableError> {
    let failed = |source| TableError::Parquet {
        path: path.into(),
        source,
    };
    let file = File::open(path).map_err(|source| TableError::Io {
        path: path.into(),
        source,
    })?;
    let reader = SerializedFileReader::new(file).map_err(failed)?;
    let fields = reader.metadata().file_metadata().schema().get_fields();
    let mut lot = Lot::of_columns(fields.iter().map(|field| field.name()));
    for row in reader.get_row_iter(None).map_err(failed)? {
        let row = row.map_err(failed)?;
        let texts = row.get_column_iter().filter_map(|(name, cell)| match cell {
            Field::Str(text) => Some((name.as_str(), text.as_str())),
            _ => None,
        });
        if !lot.hear(&texts.collect()) {
            continue;
        }
        for (at, (_, cell)) in row.get_column_iter().enumerate() {
            if let Field::Double(value) = cell {
                lot.take(at, *value);
            }
        }
    }
    Ok(lot)
}

#[cfg(test)]
mod tests {
    use super::is_decimal_comma;

    #[test]
    fn a_comma_before_decimals_is_told_from_other_texts() {
        for cell in ["21,5", " -0,25 ", "1,5e3"] {
            assert!(is_decimal_comma(cell), "{cell}");
        }
        for cell in ["21.5", "1,2,3", "bean, large", "inf", ""] {
            assert!(!is_decimal_comma(cell), "{cell}");
        }
    }
}
