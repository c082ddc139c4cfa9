//! All rows as one table.

use super::{BenchReport, BenchScan};
use std::fmt::Display;
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
    writeln!(writer, "{COLUMNS}")?;
    report
        .scans
        .iter()
        .try_for_each(|scan| write_rows(scan, writer))
}

fn write_rows(scan: &BenchScan, writer: &mut impl Write) -> io::Result<()> {
    for row in &scan.rows {
        let cells = [
            quoted(&scan.scan),
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
            row.rejected.as_deref().map_or(String::new(), quoted),
        ];
        writeln!(writer, "{}", cells.join(","))?;
    }
    Ok(())
}

fn known(value: Option<impl Display>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
