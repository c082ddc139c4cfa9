//! Decimal commas, told from commas between columns.

use super::head::remark;
use super::separator::Separator;
use crate::scan::text::{integer, number};

/// What should stand there instead, as an error says it.
pub(super) const EXPECTED: &str = "numbers with decimal points, but commas stand before their decimals: write points, as in \
                                   `1.5,2.5,3.5`";

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

/// Whether the numbers of a row that cannot be read have decimal commas: between blanks or semicolons all of them are
/// numbers but for that, or one in quotes is.
pub(super) fn are_in(row: &[u8]) -> bool {
    if row.contains(&b'"') {
        let in_quotes = row.split(|&byte| byte == b'"').skip(1).step_by(2);
        return in_quotes.map(<[u8]>::trim_ascii).any(has_comma);
    }
    let is_between = |byte: &u8| *byte == b';' || byte.is_ascii_whitespace();
    let columns = row.split(is_between).filter(|column| !column.is_empty());
    let columns: Vec<&[u8]> = columns.collect();
    let is_known = |column: &&[u8]| has_comma(column) || number(0, column).is_ok();
    columns.len() >= LEAST
        && columns.iter().all(is_known)
        && columns.iter().any(|column| has_comma(column))
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
