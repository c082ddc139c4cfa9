//! The rows of a text PLY.
//!
//! Not read by ply-rs, which parses a `float` column into 32 bits (a scan at an offset of
//! 5 000 000 loses its millimetres), refuses numbers such as `.5` and `1.`, and silently ignores
//! what a row has too much, so that a file with two vertices per line gives wrong points.

use nalgebra::Point3;
use ply_rs::ply::{ElementDef, PropertyType};

use super::header::Header;
use super::{spare, strips};
use crate::digits::plural;
use crate::scan::Scan;
use crate::scan::error::{ParseError, Place};
use crate::scan::polygon::Faces;
use crate::scan::text::{Lines, integer, number, unexpected, words};

/// What to do with the values of a property.
enum Column {
    Axis(usize),
    Corners,
    Skip,
    SkipList,
}

pub(super) fn read(bytes: &[u8], header: &Header) -> Result<Scan, ParseError> {
    let (mut scan, mut faces) = (Scan::default(), Faces::default());
    let mut lines = Lines::after(header.lines, &bytes[header.body..]);
    for element in &header.elements {
        let columns = columns(element);
        for row_number in 0..element.count {
            let Some((line, row)) = lines.find(|(_, line)| !line.trim_ascii().is_empty()) else {
                return Err(ParseError::TooFewRows {
                    line: lines.number,
                    element: element.name.clone(),
                    rows: element.count,
                    found: row_number,
                });
            };
            let place = Place::Line(line);
            let (point, indices) = read_row(line, row, &columns)?;
            match element.name.as_str() {
                "vertex" => scan.points.push(point),
                "face" => faces.add_checked(&indices, header.points, place)?,
                "tristrips" => strips::add(&indices, header.points, place, &mut faces)?,
                _ => {}
            }
        }
    }
    let mut lines = lines.filter(|(_, line)| !line.trim_ascii().is_empty());
    if let Some((_, start)) = lines.next() {
        let left = spare::left(&plural(1 + lines.count(), "line"), start);
        scan.warnings.push(left);
    }
    faces.give(&mut scan);
    Ok(scan)
}

fn columns(element: &ElementDef) -> Vec<Column> {
    let column = |(name, property): (&String, &ply_rs::ply::PropertyDef)| {
        let list = matches!(property.data_type, PropertyType::List(..));
        match (element.name.as_str(), name.as_str(), list) {
            ("vertex", "x", false) => Column::Axis(0),
            ("vertex", "y", false) => Column::Axis(1),
            ("vertex", "z", false) => Column::Axis(2),
            ("face" | "tristrips", "vertex_indices", true) => Column::Corners,
            (_, _, false) => Column::Skip,
            (_, _, true) => Column::SkipList,
        }
    };
    element.properties.iter().map(column).collect()
}

/// The point and the indices of corners that a row gives; either is empty where the element has none.
fn read_row(
    line: usize,
    row: &[u8],
    columns: &[Column],
) -> Result<(Point3<f64>, Vec<i64>), ParseError> {
    let mut point = Point3::origin();
    let mut indices = Vec::new();
    let mut values = words(row);
    let mut next = || {
        values
            .next()
            .ok_or_else(|| unexpected(line, "one more value in the row", row))
    };
    for column in columns {
        let first = next()?;
        match column {
            Column::Axis(axis) => point[*axis] = number(line, first)?,
            Column::Skip => {}
            Column::Corners => {
                for _ in 0..length(line, first)? {
                    indices.push(integer(line, next()?)?);
                }
            }
            Column::SkipList => {
                for _ in 0..length(line, first)? {
                    next()?;
                }
            }
        }
    }
    match values.next() {
        None => Ok((point, indices)),
        Some(_) => Err(unexpected(line, "as many values as properties", row)),
    }
}

fn length(line: usize, word: &[u8]) -> Result<u32, ParseError> {
    u32::try_from(integer(line, word)?)
        .map_err(|_| unexpected(line, "a list length of zero or more", word))
}

#[cfg(test)]
mod tests {
    use crate::scan::ply::parse;

    const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n\
        property float y\nproperty float z\nend_header\n";

    #[test]
    fn float_columns_keep_all_digits_of_the_text() {
        let scan = parse(format!("{HEADER}5000000.001 .5 1.\n1 2 3").as_bytes()).unwrap();
        assert_eq!(scan.points[0].coords.as_slice(), [5_000_000.001, 0.5, 1.0]);
    }

    #[test]
    fn rows_of_the_wrong_length_are_refused_with_their_line() {
        for row in ["1 2", "1 2 3 4"] {
            let error = parse(format!("{HEADER}1 2 3\n{row}\n").as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with("line 9:"), "{error}");
        }
    }

    #[test]
    fn spare_lines_leave_a_warning() {
        let scan = parse(format!("{HEADER}1 2 3\n4 5 6\n\n7 8 9\n").as_bytes()).unwrap();
        assert_eq!(scan.points.len(), 2);
        assert!(
            scan.warnings[0].starts_with("Left 1 line "),
            "{:?}",
            scan.warnings
        );
    }
}
