//! All rows as one table.

use super::{BenchReport, BenchScan};
use csv::Writer;
use std::io::{self, Write};

/// Names of the columns: the fields of [`BenchScan`] and [`BenchRow`](super::BenchRow).
const COLUMNS: &str = "scan,points,hidden,noise,reference,family,degree,segments,tolerance,coefficients,\
                       touched,seconds,seconds_most,seconds_prepare,nanoseconds,nanoseconds_bulk,\
                       heldout_rms,heldout_share,hidden_share,area_error,volume_error,rms_error,\
                       seam_jump,rejected";

/// Writes all rows as CSV: a line of names, then a row per scan and setting; what is unknown or does
/// not apply is empty.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(report: &BenchReport, writer: &mut impl Write) -> io::Result<()> {
    let mut table = Writer::from_writer(writer);
    table.write_record(COLUMNS.split(','))?;
    for scan in &report.scans {
        write_rows(scan, &mut table)?;
    }
    table.flush()
}

fn write_rows(scan: &BenchScan, table: &mut Writer<impl Write>) -> csv::Result<()> {
    for row in &scan.rows {
        let cells = [
            scan.scan.clone(),
            scan.points.to_string(),
            scan.hidden.to_string(),
            known(scan.noise),
            scan.reference.into(),
            row.family.name().into(),
            known(row.degree),
            row.segments.to_string(),
            known(row.tolerance),
            row.coefficients.to_string(),
            row.touched.to_string(),
            row.seconds.to_string(),
            row.seconds_most.to_string(),
            row.seconds_prepare.to_string(),
            row.nanoseconds.to_string(),
            known(row.nanoseconds_bulk),
            known(row.heldout_rms),
            known(row.heldout_share),
            known(row.hidden_share),
            row.area_error.to_string(),
            row.volume_error.to_string(),
            known(row.rms_error),
            row.seam_jump.to_string(),
            row.rejected.clone().unwrap_or_default(),
        ];
        table.write_record(cells)?;
    }
    Ok(())
}

fn known(value: Option<impl ToString>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}
