//! Tables of numbers: XYZ, TXT, CSV, PTS and their like, three columns or more.
//!
//! Blanks, commas or semicolons separate the columns; which one, the first row decides, so that
//! a decimal comma is an error and never a column more. Lines that start with `#`, `//` or `%`
//! are remarks. A line of words before the rows names the columns, also behind the mark of a
//! remark; a first line of one whole number counts the rows (PTS).

mod columns;
mod decimal_commas;
mod head;
mod name;
mod separator;
mod unnamed;

use nalgebra::Point3;

use super::Scan;
use super::error::ParseError;
use super::text::{Lines, number, unexpected};
use crate::digits::plural;
use columns::Axes;
use head::{Head, remark};
use separator::Separator;

pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let mut warnings = Vec::new();
    match read(bytes, &mut warnings) {
        Ok((points, unit)) => Ok(Scan {
            points,
            unit,
            warnings,
            ..Scan::default()
        }),
        Err(error) => Err(error.beside(&warnings)),
    }
}

/// The points, and the unit that their heading tells; what is odd goes to the warnings, also where an error follows.
fn read(
    bytes: &[u8],
    warnings: &mut Vec<String>,
) -> Result<(Vec<Point3<f64>>, Option<String>), ParseError> {
    let mut lines = Lines::after(0, bytes).peekable();
    let head = Head::take(&mut lines);
    let Some(&(first_line, first)) = lines.peek() else {
        return Ok((Vec::new(), None));
    };
    let separator = Separator::of(first);
    let columns = separator.split(first).count();
    let named = head.axes(first, separator, columns)?;
    let names = head.named_columns().unwrap_or(0);
    if decimal_commas::cut_columns(lines.clone(), separator, columns, names) {
        return Err(unexpected(first_line, decimal_commas::EXPECTED, first));
    }
    if named.is_none() {
        warnings.extend(head.unread(columns));
    }
    let is_named = named.is_some();
    let axes = named.unwrap_or(Axes::FIRST);
    let rows = lines.filter(|(_, row)| remark(row).is_none());
    let mut points = Vec::new();
    let mut skipped = 0;
    for (line, row) in rows.clone() {
        let point = match read_row(line, row, separator, columns, axes.columns) {
            Ok(point) => point,
            Err(error) => {
                let Some(expected) = decimal_commas::expected(row) else {
                    return Err(error);
                };
                // They explain what is odd about the heading.
                warnings.clear();
                return Err(unexpected(line, expected, row));
            }
        };
        if point.iter().all(|c| c.is_finite()) {
            points.push(point);
        } else {
            skipped += 1;
        }
    }
    if skipped > 0 {
        let rows = plural(skipped, "row");
        warnings.push(format!(
            "Dropped {rows} with a coordinate that is not finite."
        ));
    }
    let others = || {
        let others = rows.map(|(line, row)| read_row(line, row, separator, columns, [3, 4, 5]));
        others.filter_map(Result::ok).collect()
    };
    if !is_named && let Some(expected) = unnamed::expected(&points, columns, others) {
        return Err(unexpected(first_line, expected, first));
    }
    let read = points.len() + skipped;
    if let Some(count) = head.count
        && count != read as i64
    {
        let rows = plural(read, "row");
        warnings.push(format!(
            "The first line counts {count}, but the file has {rows}."
        ));
    }
    Ok((points, axes.unit))
}

fn read_row(
    line: usize,
    row: &[u8],
    separator: Separator,
    columns: usize,
    axes: [usize; 3],
) -> Result<Point3<f64>, ParseError> {
    let mut point = [None; 3];
    let mut found = 0;
    for (index, word) in separator.split(row).enumerate() {
        if let Some(axis) = axes.iter().position(|&axis| axis == index) {
            point[axis] = Some(match word {
                b"NA" => f64::NAN,
                _ => number(line, word)?,
            });
        }
        found += 1;
    }
    match point {
        [Some(x), Some(y), Some(z)] if found == columns => Ok(Point3::new(x, y, z)),
        [Some(_), Some(_), Some(_)] => {
            let expected = "as many columns as in the first row";
            Err(unexpected(line, expected, row))
        }
        _ => {
            let expected = "at least three numbers, x y z, with decimal points";
            Err(unexpected(line, expected, row))
        }
    }
}

#[cfg(test)]
mod tests;
