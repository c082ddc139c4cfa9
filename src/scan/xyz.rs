//! Tables of numbers: XYZ, TXT, CSV, PTS and their like, three columns or more.
//!
//! Blanks, commas or semicolons separate the columns; which one, the first row decides, so that
//! a decimal comma is an error and never a column more. Lines that start with `#`, `//` or `%`
//! are remarks. A first line of words names the columns; a first line of one whole number counts
//! the rows (PTS).

use nalgebra::Point3;

use super::Scan;
use super::error::ParseError;
use super::text::{Lines, integer, number, quote, unexpected, words};
use crate::digits::plural;

/// Fewer rows may be numbered by chance.
const LEAST_COUNTED: usize = 4;

pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let mut scan = Scan::default();
    let mut rows = Lines::after(0, bytes)
        .filter(|(_, line)| !is_remark(line))
        .peekable();
    let (mut count, mut heading) = (None, None);
    if let Some((line, row)) = rows.next_if(|(_, row)| is_heading(row) || is_count(row)) {
        count = integer(line, row.trim_ascii()).ok();
        heading = count.is_none().then_some(row);
    }
    let Some(&(_, first)) = rows.peek() else {
        return Ok(scan);
    };
    let separator = Separator::of(first);
    let columns = separator.split(first).count();
    let mut axes = [0, 1, 2];
    if let Some(heading) = heading {
        match named_axes(heading, separator, columns) {
            Some(named) => axes = named,
            None => scan.warnings.push(format!(
                "The heading {} does not name the columns x, y and z; the first three were read.",
                quote(heading)
            )),
        }
    }
    let mut skipped = 0;
    let is_named = heading.is_some();
    let start = rows.peek().copied();
    for (line, row) in rows {
        let point = read_row(line, row, separator, columns, axes)?;
        if point.iter().all(|c| c.is_finite()) {
            scan.points.push(point);
        } else {
            skipped += 1;
        }
    }
    if skipped > 0 {
        let rows = plural(skipped, "row");
        scan.warnings.push(format!(
            "Dropped {rows} with a coordinate that is not finite."
        ));
    }
    if let Some((line, row)) = start
        && !is_named
        && columns > 3
        && counts_rows(&scan.points)
    {
        let expected = "coordinates in the first three columns, but the first one counts the rows: take it out, or name the columns in \
                        a first line such as `id x y z`";
        return Err(unexpected(line, expected, row));
    }
    let read = scan.points.len() + skipped;
    if let Some(count) = count
        && count != read as i64
    {
        let rows = plural(read, "row");
        scan.warnings.push(format!(
            "The first line counts {count}, but the file has {rows}."
        ));
    }
    Ok(scan)
}

/// Whether the first coordinate is the number of its row, from 0 or 1 on.
fn counts_rows(points: &[Point3<f64>]) -> bool {
    let first = points.first().map_or(f64::NAN, |point| point.x);
    let mut rows = points.iter().enumerate();
    points.len() >= LEAST_COUNTED
        && (first == 0.0 || first == 1.0)
        && rows.all(|(row, point)| point.x == first + row as f64)
}

fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii();
    let marks: [&[u8]; 3] = [b"#", b"//", b"%"];
    line.is_empty() || marks.iter().any(|mark| line.starts_with(mark))
}

fn is_count(row: &[u8]) -> bool {
    let row = row.trim_ascii();
    !row.is_empty() && row.iter().all(u8::is_ascii_digit)
}

/// Whether no column of a line is a number.
fn is_heading(row: &[u8]) -> bool {
    let mut columns = Separator::of(row).split(row);
    columns.all(|column| number(0, column).is_err()) && row.iter().any(u8::is_ascii_alphabetic)
}

/// The columns named `x`, `y` and `z`, perhaps with a unit as in `X (mm)`, where the heading has
/// a name for every column.
fn named_axes(heading: &[u8], separator: Separator, columns: usize) -> Option<[usize; 3]> {
    let is_named = |name: &[u8], axis: u8| {
        let name = name.strip_prefix(b"\"").unwrap_or(name);
        let unit = name.get(1..).unwrap_or_default().trim_ascii_start();
        name.first()
            .is_some_and(|first| first.eq_ignore_ascii_case(&axis))
            && matches!(unit.first(), None | Some(b'(' | b'[' | b'"'))
    };
    let column = |axis| {
        separator
            .split(heading)
            .position(|name| is_named(name, axis))
    };
    let axes = [column(b'x')?, column(b'y')?, column(b'z')?];
    (separator.split(heading).count() == columns).then_some(axes)
}

#[derive(Clone, Copy)]
enum Separator {
    Blank,
    Byte(u8),
}

impl Separator {
    fn of(row: &[u8]) -> Self {
        let used = [b';', b','].into_iter().find(|byte| row.contains(byte));
        used.map_or(Self::Blank, Self::Byte)
    }

    fn split(self, row: &[u8]) -> impl Iterator<Item = &[u8]> {
        let (blank, byte) = match self {
            Self::Blank => (Some(words(row)), None),
            Self::Byte(separator) => {
                let columns = row.split(move |&b| b == separator).map(<[u8]>::trim_ascii);
                (None, Some(columns))
            }
        };
        blank
            .into_iter()
            .flatten()
            .chain(byte.into_iter().flatten())
    }
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
            point[axis] = Some(number(line, word)?);
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
mod tests {
    use super::*;

    fn first(text: &str) -> [f64; 3] {
        parse(text.as_bytes()).unwrap().points[0].into()
    }

    #[test]
    fn any_separator_and_extra_columns_are_read() {
        for text in [
            "1 2 3",
            " 1\t2  3 9",
            "1,2,3",
            "1, 2, 3, 9",
            "1;2;3;",
            "1; 2; 3",
        ] {
            assert_eq!(first(text), [1.0, 2.0, 3.0], "{text}");
        }
    }

    #[test]
    fn headings_name_the_columns() {
        assert_eq!(first("id,x,y,z\n7,1,2,3"), [1.0, 2.0, 3.0]);
        assert_eq!(
            first("\"Z (mm)\";\"Y (mm)\";\"X (mm)\"\n3;2;1"),
            [1.0, 2.0, 3.0]
        );
        assert_eq!(first("x_normal,x,y,z\n7,1,2,3"), [1.0, 2.0, 3.0]);
        for heading in ["east north up", "X [mm] Y [mm] Z [mm]", "x,y,z"] {
            let scan = parse(format!("{heading}\n1 2 3 4").as_bytes()).unwrap();
            assert_eq!(scan.points[0], [1.0, 2.0, 3.0].into());
            assert!(
                scan.warnings[0].contains("first three"),
                "{:?}",
                scan.warnings
            );
        }
    }

    #[test]
    fn a_column_that_counts_the_rows_is_no_coordinate() {
        for first in [0, 1] {
            let rows = (0..9).map(|row| format!("{} 0.5 {row}.25 -1\n", first + row));
            let error = parse(rows.collect::<String>().as_bytes()).unwrap_err();
            let told = error.to_string();
            assert!(
                told.starts_with("line 1:") && told.contains("counts the rows"),
                "{told}"
            );
        }
        let rows = (0..9).map(|row| format!("{row} 0.5 {row}.25 -1\n"));
        let named = format!("id x y z\n{}", rows.collect::<String>());
        assert_eq!(first(&named), [0.5, 0.25, -1.0]);
        let grid = (0..9).map(|row| format!("{row} 0.5 0\n"));
        assert!(parse(grid.collect::<String>().as_bytes()).is_ok());
    }

    #[test]
    fn decimal_commas_are_refused() {
        for text in ["1,5;2,5;3,5", "1,5 2,5 3,5", "1,5\t2\t3"] {
            let error = parse(text.as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with("line 1:"), "{text}: {error}");
        }
    }

    #[test]
    fn a_count_is_no_point() {
        assert_eq!(parse(b"1\n1 2 3 9").unwrap().points.len(), 1);
        let scan = parse(b"5\n1 2 3 9").unwrap();
        assert!(scan.warnings[0].contains("counts 5"), "{:?}", scan.warnings);
    }

    #[test]
    fn rows_that_are_not_finite_are_dropped_with_a_warning() {
        let scan = parse(b"1 2 3\nNaN NaN nan\n4 5 6").unwrap();
        assert_eq!(scan.points.len(), 2);
        assert!(
            scan.warnings[0].starts_with("Dropped 1 row "),
            "{:?}",
            scan.warnings
        );
    }

    #[test]
    fn uneven_rows_are_refused_with_their_line() {
        for text in ["1 2 3\n\n1 2", "1 2 3\n# remark\n1 2 3 4"] {
            let error = parse(text.as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with("line 3:"), "{error}");
        }
    }
}
