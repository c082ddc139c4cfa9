//! Reading results again.

use super::columns::{are_results, is_figure};
use super::csv_table::csv_table;
use super::error::TableError;
use super::lot::Lot;
use csv::StringRecord;
use parquet::basic::Compression;
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::fs::File;
use std::path::{Path, PathBuf};

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

fn of_csv(path: &Path) -> Result<Lot, TableError> {
    let (names, rows) = csv_table(path)?;
    check_decimals(path, &names, &rows)?;
    let mut lot = Lot::of_columns(names.iter());
    for row in &rows {
        let cells: Vec<_> = row.iter().map(number).collect();
        lot.add(&names.iter().zip(row).collect(), &cells);
    }
    Ok(lot)
}

/// The number in a cell: none where nothing is told, an infinite one where it is no number.
fn number(cell: &str) -> Option<f64> {
    let cell = Some(cell.trim()).filter(|cell| !cell.is_empty())?;
    let number: f64 = cell.parse().unwrap_or(f64::INFINITY);
    (!number.is_nan()).then_some(number)
}

/// The number in a cell of Parquet, likewise.
fn number_of_field(field: &Field) -> Option<f64> {
    match field {
        Field::Null => None,
        Field::Double(number) => Some(*number).filter(|number| !number.is_nan()),
        Field::Float(number) => Some(f64::from(*number)).filter(|number| !number.is_nan()),
        Field::Byte(number) => Some(f64::from(*number)),
        Field::Short(number) => Some(f64::from(*number)),
        Field::Int(number) => Some(f64::from(*number)),
        Field::Long(number) => Some(*number as f64),
        Field::UByte(number) => Some(f64::from(*number)),
        Field::UShort(number) => Some(f64::from(*number)),
        Field::UInt(number) => Some(f64::from(*number)),
        Field::ULong(number) => Some(*number as f64),
        Field::Str(text) => self::number(text),
        _ => Some(f64::INFINITY),
    }
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
    check_unpacked(path, reader.metadata())?;
    let fields = reader.metadata().file_metadata().schema().get_fields();
    let mut lot = Lot::of_columns(fields.iter().map(|field| field.name()));
    for row in reader.get_row_iter(None).map_err(failed)? {
        let row = row.map_err(failed)?;
        let texts = row.get_column_iter().filter_map(|(name, cell)| match cell {
            Field::Str(text) => Some((name.as_str(), text.as_str())),
            _ => None,
        });
        let cells = row.get_column_iter().map(|(_, cell)| number_of_field(cell));
        lot.add(&texts.collect(), &cells.collect::<Vec<_>>());
    }
    Ok(lot)
}

/// Refuses columns that are packed in a way that is not read.
fn check_unpacked(path: &Path, found: &ParquetMetaData) -> Result<(), TableError> {
    let columns = found.row_groups().iter().flat_map(|group| group.columns());
    match columns.map(|column| column.compression()).find_map(unread) {
        Some(codec) => Err(TableError::Packed {
            path: path.into(),
            codec,
        }),
        None => Ok(()),
    }
}

/// What a way of packing that is not read is called, without its level.
fn unread(codec: Compression) -> Option<String> {
    match codec {
        Compression::UNCOMPRESSED | Compression::SNAPPY => None,
        _ => codec.to_string().split('(').next().map(str::to_owned),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::basic::GzipLevel;
    use parquet::data_type::{ByteArray, ByteArrayType, DataType, FloatType, Int32Type, Int64Type};
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
    use parquet::schema::parser::parse_message_type;
    use std::sync::Arc;
    use tempfile::NamedTempFile;

    #[test]
    fn a_comma_before_decimals_is_told_from_other_texts() {
        for cell in ["21,5", " -0,25 ", "1,5e3"] {
            assert!(is_decimal_comma(cell), "{cell}");
        }
        for cell in ["21.5", "1,2,3", "bean, large", "inf", ""] {
            assert!(!is_decimal_comma(cell), "{cell}");
        }
    }

    #[test]
    fn cells_are_numbers_or_none_or_nothing() {
        let cells = [" 1.5 ", "", " ", "nan", "-inf", "42,740.8", "bean"];
        let infinite = Some(f64::INFINITY);
        let found = cells.map(|cell| number(cell).map(f64::abs));
        let expected = [Some(1.5), None, None, None, infinite, infinite, infinite];
        assert_eq!(found, expected);
    }

    fn put<T: DataType>(group: &mut SerializedRowGroupWriter<'_, File>, values: &[T::T]) {
        let mut column = group.next_column().unwrap().unwrap();
        let typed = column.typed::<T>();
        typed.write_batch(values, None, None).unwrap();
        column.close().unwrap();
    }

    /// A table of two grains, packed so, with numbers as other programs save them.
    fn parquet(codec: Compression) -> NamedTempFile {
        let schema = "message table {
            required binary path (UTF8); required binary status (UTF8); required float area; required float area_se;
            required int32 roundness; required int64 volume; required binary angularity (UTF8);
        }";
        let schema = Arc::new(parse_message_type(schema).unwrap());
        let properties = WriterProperties::builder().set_compression(codec).build();
        let file = tempfile::Builder::new()
            .suffix(".parquet")
            .tempfile()
            .unwrap();
        let copy = file.reopen().unwrap();
        let mut writer = SerializedFileWriter::new(copy, schema, Arc::new(properties)).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let texts = |texts: [&str; 2]| texts.map(ByteArray::from);
        put::<ByteArrayType>(&mut group, &texts(["a", "b"]));
        put::<ByteArrayType>(&mut group, &texts(["ok", "ok"]));
        put::<FloatType>(&mut group, &[0.5, f32::NAN]);
        put::<FloatType>(&mut group, &[0.25, 0.75]);
        put::<Int32Type>(&mut group, &[3, -4]);
        put::<Int64Type>(&mut group, &[1 << 40, 5]);
        put::<ByteArrayType>(&mut group, &texts(["0.5", "1,000.5"]));
        group.close().unwrap();
        writer.close().unwrap();
        file
    }

    #[test]
    fn numbers_of_any_width_are_read_from_parquet_packed_or_not() {
        for codec in [Compression::UNCOMPRESSED, Compression::SNAPPY] {
            let lot = read_results(parquet(codec).path()).unwrap();
            assert_eq!(lot.names, ["area", "roundness", "volume", "angularity"]);
            let volumes = vec![(1_u64 << 40) as f64, 5.0];
            let values = [vec![0.5], vec![3.0, -4.0], volumes, vec![0.5]];
            let known = (0..lot.names.len()).map(|column| lot.known(column));
            assert_eq!(known.collect::<Vec<_>>(), values);
            assert_eq!(lot.grains, ["a", "b"]);
            assert_eq!(lot.values[0], [Some(0.5), None]);
            assert_eq!(lot.errors[0], [Some(0.25), Some(0.75)]);
            assert!(lot.errors[1].is_empty());
            assert_eq!(lot.unread.get("angularity"), Some(&1));
            let told = lot.gaps.sentence("").unwrap();
            assert!(told.contains("1 lacks area"), "{told}");
        }
    }

    #[test]
    fn ways_of_packing_that_are_not_read_are_named() {
        assert_eq!(unread(Compression::SNAPPY), None);
        let gzip = Compression::GZIP(GzipLevel::default());
        assert_eq!(unread(gzip).as_deref(), Some("GZIP"));
    }
}
