//! The final files of a batch.

use super::columns::{Column, FIRST, Kind};
use super::error::BatchError;
use super::journal::Row;
use super::population::Population;
use crate::export::{WriteError, write_atomically};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Rows that are held at a time.
const GROUP: usize = 1024;

/// The files, in the order in which they are written.
pub(super) const FILES: [&str; 4] = [
    "results.csv",
    "results.parquet",
    "seconds.csv",
    "summary.json",
];

/// A cell.
enum Cell {
    Text(Option<String>),
    Count(Option<i64>),
    Real(Option<f64>),
}

/// Writes the [`FILES`]; gives their paths.
pub(super) fn write_results<I: Iterator<Item = io::Result<Row>>>(
    folder: &Path,
    columns: &[Column],
    rows: &dyn Fn() -> I,
    population: &Population,
) -> Result<Vec<PathBuf>, BatchError> {
    let [csv, parquet, seconds, summary] = FILES.map(|name| folder.join(name));
    write_atomically(&csv, |file| Ok(write_csv(columns, rows(), file)?))?;
    write_atomically(&parquet, |file| Ok(write_parquet(columns, rows(), file)?))?;
    write_atomically(&seconds, |file| Ok(write_seconds(rows(), file)?))?;
    write_atomically(&summary, |file| {
        serde_json::to_writer_pretty(&mut *file, population).map_err(io::Error::from)?;
        Ok::<(), WriteError>(writeln!(file)?)
    })?;
    Ok(vec![csv, parquet, seconds, summary])
}

fn write_csv(
    columns: &[Column],
    rows: impl Iterator<Item = io::Result<Row>>,
    file: &mut dyn Write,
) -> io::Result<()> {
    let mut csv = writer(file);
    csv.write_record(columns.iter().map(|column| &column.name))?;
    for row in rows {
        csv.write_record(cells(&row?, columns).into_iter().map(|cell| cell.text()))?;
    }
    csv.flush()
}

/// What differs from run to run: not part of the results.
fn write_seconds(
    rows: impl Iterator<Item = io::Result<Row>>,
    file: &mut dyn Write,
) -> io::Result<()> {
    let mut csv = writer(file);
    csv.write_record(["path", "seconds"])?;
    for row in rows {
        let row = row?;
        csv.write_record([row.path, row.seconds.to_string()])?;
    }
    csv.flush()
}

/// With the line ends of RFC 4180.
fn writer(file: &mut dyn Write) -> csv::Writer<&mut dyn Write> {
    csv::WriterBuilder::new()
        .terminator(csv::Terminator::CRLF)
        .from_writer(file)
}

fn write_parquet(
    columns: &[Column],
    mut rows: impl Iterator<Item = io::Result<Row>>,
    file: &mut (dyn Write + Send),
) -> io::Result<()> {
    let properties = WriterProperties::builder()
        .set_compression(Compression::UNCOMPRESSED)
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::PLAIN);
    let schema = schema(columns)?;
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties.build()))?;
    loop {
        let group: Vec<Vec<Cell>> = rows
            .by_ref()
            .take(GROUP)
            .map(|row| Ok(cells(&row?, columns)))
            .collect::<io::Result<_>>()?;
        if group.is_empty() {
            break;
        }
        let mut out = writer.next_row_group()?;
        for (at, column) in columns.iter().enumerate() {
            let cells = group.iter().map(|row| &row[at]);
            match column.kind {
                Kind::Text => write_column::<ByteArrayType, _>(&mut out, cells.map(Cell::bytes))?,
                Kind::Count => write_column::<Int64Type, _>(&mut out, cells.map(Cell::count))?,
                Kind::Real => write_column::<DoubleType, _>(&mut out, cells.map(Cell::real))?,
            }
        }
        out.close()?;
    }
    writer.close()?;
    Ok(())
}

fn schema(columns: &[Column]) -> io::Result<Arc<Type>> {
    let fields = columns.iter().map(|column| {
        let (physical, logical) = match column.kind {
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            Kind::Count => (Physical::INT64, None),
            Kind::Real => (Physical::DOUBLE, None),
        };
        let field = Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical);
        Ok(Arc::new(field.build()?))
    });
    let fields = fields.collect::<Result<_, parquet::errors::ParquetError>>()?;
    let schema = Type::group_type_builder("results").with_fields(fields);
    Ok(Arc::new(schema.build()?))
}

/// Writes the cells of one column: what is known, and for each whether it is.
fn write_column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> io::Result<()> {
    let mut values = Vec::new();
    let known: Vec<i16> = cells
        .map(|cell| {
            let is_known = i16::from(cell.is_some());
            values.extend(cell);
            is_known
        })
        .collect();
    if let Some(mut column) = group.next_column()? {
        column
            .typed::<T>()
            .write_batch(&values, Some(&known), None)?;
        column.close()?;
    }
    Ok(())
}

/// The cells of a row, in the order of the columns.
fn cells(row: &Row, columns: &[Column]) -> Vec<Cell> {
    let text = |text: &str| Cell::Text(Some(text.to_owned()));
    let perhaps = |text: &Option<String>| Cell::Text(text.clone());
    let list = |texts: &[String]| Cell::Text((!texts.is_empty()).then(|| texts.join(" | ")));
    let count = |count: Option<u64>| Cell::Count(count.map(|count| count as i64));
    let status = if row.reason.is_some() { "failed" } else { "ok" };
    let first: [Cell; FIRST.len()] = [
        text(&row.path),
        text(status),
        perhaps(&row.reason),
        perhaps(&row.hash),
        text(&row.version),
        text(&row.settings),
        perhaps(&row.unit),
        count(row.points),
        count(row.degree),
        count(row.segments),
        count(row.coefficients),
        Cell::Real(row.mean_radius),
        Cell::Real(row.noise),
        count(row.noise_is_bound.map(u64::from)),
        Cell::Real(row.rms),
        Cell::Real(row.heldout_rms),
        Cell::Real(row.area_error),
        Cell::Real(row.volume_error),
        perhaps(&row.no_standard_errors),
        list(&row.not_measured),
        list(&row.warnings),
    ];
    let figures = (FIRST.len()..columns.len())
        .map(|at| Cell::Real(row.figures.get(at - FIRST.len()).copied().flatten()));
    first.into_iter().chain(figures).collect()
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone().unwrap_or_default(),
            Self::Count(count) => count.map_or(String::new(), |count| count.to_string()),
            Self::Real(real) => real.map_or(String::new(), |real| real.to_string()),
        }
    }

    fn bytes(&self) -> Option<ByteArray> {
        match self {
            Self::Text(text) => text.as_deref().map(ByteArray::from),
            _ => None,
        }
    }

    fn count(&self) -> Option<i64> {
        match self {
            Self::Count(count) => *count,
            _ => None,
        }
    }

    fn real(&self) -> Option<f64> {
        match self {
            Self::Real(real) => *real,
            _ => None,
        }
    }
}
