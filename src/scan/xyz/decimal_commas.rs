//! Decimal commas and separators of thousands, told from commas between columns.

use super::head::remark;
use super::separator::Separator;
use crate::scan::text::{integer, number};

/// What should stand there instead, as an error says it.
pub(super) const EXPECTED: &str = "numbers with decimal points, but commas stand before their decimals: write points, as in \
                                   `1.5,2.5,3.5`";

/// The same where groups of three digits are set apart.
const WITHOUT_THOUSANDS: &str =
    "numbers without separators of thousands and with decimal points, as in `5453.05`";

/// Columns of three numbers that decimal commas have cut in two.
const CUT: usize = 6;

/// Columns of a point.
const LEAST: usize = 3;

/// Whether commas separate columns and decimals alike: all columns are whole numbers, every other one has no sign, and
/// some of these begin with zeros, as decimals do, or a heading has half as many `names`.
pub(super) fn cut_columns<'a>(
    rows: impl Iterator<Item = (usize, &'a [u8])>,
    separator: Separator,
    columns: usize,
    names: usize,
) -> bool {
    if separator != Separator::Byte(b',') || columns < CUT || columns % 2 == 1 {
        return false;
    }
    let mut begin_with_zeros = false;
    for (line, row) in rows.filter(|(_, row)| remark(row).is_none()) {
        for (column, word) in separator.split(row).enumerate() {
            let is_decimals = column % 2 == 1;
            let is_whole = match is_decimals {
                true => !word.is_empty() && word.iter().all(u8::is_ascii_digit),
                false => integer(line, word).is_ok(),
            };
            if !is_whole {
                return false;
            }
            begin_with_zeros |= is_decimals && word.len() > 1 && word.starts_with(b"0");
        }
    }
    begin_with_zeros || columns == 2 * names
}

/// What should stand in a row that cannot be read, where that is for commas before decimals or separators of thousands: between
/// blanks or semicolons all columns are numbers but for these, or one in quotes is.
pub(super) fn expected(row: &[u8]) -> Option<&'static str> {
    let columns: Vec<&[u8]> = match row.contains(&b'"') {
        true => {
            let in_quotes = row.split(|&byte| byte == b'"').skip(1).step_by(2);
            in_quotes.map(<[u8]>::trim_ascii).collect()
        }
        false => {
            let is_between = |byte: &u8| *byte == b';' || byte.is_ascii_whitespace();
            let columns = row.split(is_between).filter(|column| !column.is_empty());
            let columns: Vec<_> = columns.collect();
            let is_known = |column: &&[u8]| {
                has_comma(column) || has_thousands(column) || number(0, column).is_ok()
            };
            if columns.len() < LEAST || !columns.iter().all(is_known) {
                return None;
            }
            columns
        }
    };
    if columns.iter().any(|column| has_thousands(column)) {
        return Some(WITHOUT_THOUSANDS);
    }
    columns
        .iter()
        .any(|column| has_comma(column))
        .then_some(EXPECTED)
}

/// Whether a column is a number but for the comma before its decimals.
fn has_comma(column: &[u8]) -> bool {
    let Some(comma) = column.iter().position(|&byte| byte == b',') else {
        return false;
    };
    let mut pointed = column.to_vec();
    pointed[comma] = b'.';
    column.get(comma + 1).is_some_and(u8::is_ascii_digit) && number(0, &pointed).is_ok()
}

/// Whether a column is a number in groups of three digits, such as `5.453,05`, `5,453.05` or `1,234,567`.
fn has_thousands(column: &[u8]) -> bool {
    let digits = column.strip_prefix(b"-").unwrap_or(column);
    let are_digits = |part: &[u8]| part.iter().all(u8::is_ascii_digit);
    [(b',', b'.'), (b'.', b',')]
        .into_iter()
        .any(|(between, point)| {
            let mut parts = digits.split(|&byte| byte == point);
            let (whole, decimals) = (parts.next().unwrap_or_default(), parts.next());
            let groups: Vec<&[u8]> = whole.split(|&byte| byte == between).collect();
            let [first, others @ ..] = groups.as_slice() else {
                return false;
            };
            // A comma and three digits alone may be decimals.
            let are_told = others.len() > usize::from(decimals.is_none());
            are_told
                && (1..=3).contains(&first.len())
                && others.iter().all(|group| group.len() == 3)
                && groups.iter().copied().chain(decimals).all(are_digits)
                && parts.next().is_none()
        })
}
