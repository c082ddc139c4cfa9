//! What stands before the rows of a table: remarks, a count, names of columns.

use std::iter::Peekable;

use super::columns::{Axes, angle, are_elsewhere, named_axes, named_columns, units_below};
use super::separator::Separator;
use crate::scan::error::{HeadingDoubt, ParseError, Place};
use crate::scan::text::{Lines, integer, number, quote};

/// Names, and their units below.
const MOST_HEADINGS: usize = 2;

/// The separator that Excel is told in the first line, as in `sep=;`: the rows show it.
const SEPARATOR_LINE: &[u8] = b"sep=";

#[derive(Default)]
pub(super) struct Head<'a> {
    /// How many rows there are, where a line of one whole number tells (PTS).
    pub(super) count: Option<i64>,
    /// Lines of words, and their numbers.
    headings: Vec<(usize, &'a [u8])>,
    /// Remarks without their marks, likewise.
    remarks: Vec<(usize, &'a [u8])>,
}

impl<'a> Head<'a> {
    /// Takes all lines before the first row.
    pub(super) fn take(lines: &mut Peekable<Lines<'a>>) -> Self {
        let mut head = Self::default();
        while let Some(&(line, row)) = lines.peek() {
            if let Some(text) = remark(row) {
                head.remarks.push((line, text));
            } else if is_count(row) && head.count.is_none() && head.headings.is_empty() {
                head.count = integer(line, row.trim_ascii()).ok();
            } else if is_heading(row) && head.headings.len() < MOST_HEADINGS {
                head.headings.push((line, row));
            } else {
                break;
            }
            lines.next();
        }
        head
    }

    /// The columns of x, y and z that a heading names or, where there is none, the last remark that does, in the unit that it tells, or
    /// a line of units beside it. `first` is the first row.
    ///
    /// # Errors
    /// [`ParseError::Heading`] where it cannot be told which ones are meant, or how.
    pub(super) fn axes(
        &self,
        first: &[u8],
        separator: Separator,
        columns: usize,
    ) -> Result<Option<Axes>, ParseError> {
        // R names rows, too, and has no name for that column.
        let are_rows_named = self
            .named_columns()
            .is_some_and(|names| names + 1 == columns)
            && first.trim_ascii_start().starts_with(b"\"");
        let shift = usize::from(are_rows_named);
        let named = self.axes_of(separator, columns - shift)?;
        Ok(named.map(|axes| Axes {
            columns: axes.columns.map(|column| column + shift),
            ..axes
        }))
    }

    fn axes_of(&self, separator: Separator, columns: usize) -> Result<Option<Axes>, ParseError> {
        let headings = self.headings.iter();
        let remarks = self.remarks.iter().rev();
        let remarks = remarks.filter(|_| self.headings.is_empty());
        for &(line, text) in headings.chain(remarks) {
            let found = named_axes(text, separator, columns);
            if let Some(axes) = found.map_err(|doubt| doubtful(line, text, doubt))? {
                return self.with_unit(axes, separator).map(Some);
            }
        }
        let angle =
            (self.headings.iter()).find_map(|(line, text)| Some((line, text, angle(text)?)));
        match angle {
            Some((line, text, angle)) => Err(doubtful(*line, text, HeadingDoubt::Angle(angle))),
            None => Ok(None),
        }
    }

    /// Columns with the unit that a line of units tells.
    fn with_unit(&self, axes: Axes, separator: Separator) -> Result<Axes, ParseError> {
        if axes.unit.is_some() {
            return Ok(axes);
        }
        for &(line, text) in &self.headings {
            let unit = units_below(text, separator, axes.columns);
            if let Some(unit) = unit.map_err(|doubt| doubtful(line, text, doubt))? {
                return Ok(Axes {
                    unit: Some(unit),
                    ..axes
                });
            }
        }
        Ok(axes)
    }

    /// How many columns the first line of words names that is no remark, if it names those of x, y and z among them.
    pub(super) fn named_columns(&self) -> Option<usize> {
        named_columns(self.headings.first()?.1)
    }

    /// What is odd about the names of columns, where none of these is taken.
    pub(super) fn unread(&self, columns: usize) -> Option<String> {
        let Some((_, heading)) = self.headings.first() else {
            let mut remarks = self.remarks.iter();
            let (_, remark) = remarks.find(|(_, text)| are_elsewhere(text))?;
            return Some(format!(
                "The remark {} names x, y and z, but not each of the {columns} columns; the first three were read.",
                quote(remark)
            ));
        };
        let odd = match self.named_columns() {
            Some(names) => format!("names {names} columns, but the first row has {columns}"),
            None => "does not name the columns x, y and z".into(),
        };
        let heading = quote(heading);
        Some(format!(
            "The heading {heading} {odd}; the first three were read."
        ))
    }
}

fn doubtful(line: usize, heading: &[u8], doubt: HeadingDoubt) -> ParseError {
    ParseError::Heading {
        place: Place::Line(line),
        heading: quote(heading),
        doubt,
    }
}

/// The text of a remark or of an empty line; none of a row.
pub(super) fn remark(line: &[u8]) -> Option<&[u8]> {
    let line = line.trim_ascii();
    let start = &line[..line.len().min(SEPARATOR_LINE.len())];
    // Below their tables spreadsheets write rows without a cell.
    let is_empty = line.iter().all(|byte| matches!(byte, b',' | b';'));
    if is_empty || start.eq_ignore_ascii_case(SEPARATOR_LINE) {
        return Some(&[]);
    }
    let marks: [&[u8]; 3] = [b"#", b"//", b"%"];
    let text = marks.iter().find_map(|mark| line.strip_prefix(*mark))?;
    let text = text.trim_ascii_start();
    Some(text.strip_prefix(b"#").unwrap_or(text).trim_ascii_start())
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
