//! Tables in CSV.

use super::error::LotError;
use csv::StringRecord;
use std::path::Path;

/// The names of the columns of a table, and its rows.
pub(super) fn table(path: &Path) -> Result<(Vec<String>, Vec<StringRecord>), LotError> {
    let failed = |source| LotError::Csv {
        path: path.into(),
        source,
    };
    let mut reader = csv::Reader::from_path(path).map_err(failed)?;
    let columns = texts(reader.headers().map_err(failed)?);
    let rows: Result<_, _> = reader.records().collect();
    Ok((columns, rows.map_err(failed)?))
}

/// The texts of a row.
pub(super) fn texts(row: &StringRecord) -> Vec<String> {
    row.iter().map(str::to_owned).collect()
}
