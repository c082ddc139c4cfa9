//! What a heading says of the columns of rows: which ones are x, y and z, and in which unit.

use super::name::{Name, Way, in_brackets, is_length, is_step, known_unit};
use super::separator::Separator;
use crate::scan::error::HeadingDoubt;
use crate::scan::text;

/// The columns of x, y and z.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axes {
    pub(super) columns: [usize; 3],
    /// The unit that all three are told in.
    pub(super) unit: Option<String>,
}

impl Axes {
    /// Those of columns that nobody has named.
    pub(super) const FIRST: Self = Self {
        columns: [0, 1, 2],
        unit: None,
    };

    fn in_unit(columns: [usize; 3], unit: Option<String>) -> Self {
        Self {
            columns,
            unit: unit.filter(|unit| is_length(unit)),
        }
    }
}

/// Words of sentences.
const OF_SENTENCES: [&str; 13] = [
    "an", "and", "are", "as", "by", "for", "from", "in", "is", "of", "on", "the", "with",
];

/// The columns of x, y and z, where a heading has a name for every column and names these.
///
/// # Errors
/// [`HeadingDoubt`] where it cannot be told which ones are meant, or how.
pub(super) fn named_axes(
    heading: &[u8],
    separator: Separator,
    columns: usize,
) -> Result<Option<Axes>, HeadingDoubt> {
    for separator in [separator, Separator::of(heading), Separator::Byte(b'\t')] {
        for line in [without_title(heading), heading] {
            if separator != Separator::Blank || !is_sentence(line) {
                let names = names(line, separator);
                let axes = (names.len() == columns).then(|| axes(&names));
                if let Some(Some(axes)) = axes.transpose()? {
                    return Ok(Some(axes));
                }
            }
        }
    }
    Ok(None)
}

/// An angle that a heading names among the first three columns.
pub(super) fn angle(heading: &[u8]) -> Option<String> {
    let names = names(heading, Separator::of(heading));
    names.iter().take(3).find_map(Name::angle)
}

/// The unit of columns in a line of units.
///
/// # Errors
/// [`HeadingDoubt::Units`] where they are several.
pub(super) fn units_below(
    line: &[u8],
    separator: Separator,
    columns: [usize; 3],
) -> Result<Option<String>, HeadingDoubt> {
    let words: Vec<String> = separator
        .split(line)
        .map(|word| String::from_utf8_lossy(word).into_owned())
        .collect();
    let unit = |column: usize| {
        let word = words.get(column)?.trim_matches(['(', ')', '[', ']']);
        known_unit(word).filter(|unit| is_length(unit))
    };
    match columns.map(unit) {
        [Some(x), Some(y), Some(z)] if x == y && y == z => Ok(Some(x)),
        [Some(x), Some(y), Some(z)] => Err(HeadingDoubt::Units(vec![x, y, z])),
        _ => Ok(None),
    }
}

/// How many columns a heading names, if it names those of x, y and z among them.
pub(super) fn named_columns(heading: &[u8]) -> Option<usize> {
    let separator = Separator::of(heading);
    let columns = names(heading, separator).len();
    let axes = named_axes(heading, separator, columns);
    axes.ok().flatten().map(|_| columns)
}

/// Whether x, y and z stand in a line that is not read for the columns of rows, and not first.
pub(super) fn are_elsewhere(line: &[u8]) -> bool {
    let cells = text::cells(without_title(line));
    let found: Vec<_> = cells.map(|cell| Name::of(cell).axis()).collect();
    let at = |axis| {
        found
            .iter()
            .position(|found| *found == Some((Way::Plain, axis)))
    };
    let [x, y, z] = [0, 1, 2].map(at);
    x.is_some() && y.is_some() && z.is_some() && [x, y, z] != [Some(0), Some(1), Some(2)]
}

/// A heading behind a title such as `Columns:`.
fn without_title(heading: &[u8]) -> &[u8] {
    let end = heading
        .windows(2)
        .rposition(|pair| pair[0] == b':' && pair[1].is_ascii_whitespace());
    end.map_or(heading, |end| &heading[end + 1..])
}

/// Whether words between blanks are those of a sentence, or numbers among them.
fn is_sentence(line: &[u8]) -> bool {
    text::words(line).any(|word| {
        let is_stopped = word.ends_with(b".") && !word.eq_ignore_ascii_case(b"no.");
        let ends_a_part = word.ends_with(b":") || word.ends_with(b",") || is_stopped;
        let lower = word.to_ascii_lowercase();
        let is_of_sentence = OF_SENTENCES.iter().any(|other| lower == other.as_bytes());
        ends_a_part || is_of_sentence || text::number(0, word).is_ok()
    })
}

/// What a heading says of every column.
fn names(heading: &[u8], separator: Separator) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    for name in separator.split(heading) {
        // Between blanks a unit in brackets stands alone.
        let is_unit = separator == Separator::Blank && matches!(name.first(), Some(b'(' | b'['));
        match names.last_mut().filter(|_| is_unit) {
            Some(last) => last.unit = in_brackets(&String::from_utf8_lossy(name)),
            None => names.push(Name::of(name)),
        }
    }
    names
}

/// The columns of x, y and z; of several for one axis those that have one unit for all three.
fn axes(names: &[Name]) -> Result<Option<Axes>, HeadingDoubt> {
    let found: Vec<_> = names.iter().map(Name::axis).collect();
    for way in [Way::Plain, Way::Place, Way::Together] {
        let of_axis = |axis| {
            let columns = found.iter().enumerate();
            let columns = columns.filter(move |(_, found)| **found == Some((way, axis)));
            columns.map(|(column, _)| column).collect::<Vec<_>>()
        };
        let all = [0, 1, 2].map(of_axis);
        if all.iter().all(|columns| !columns.is_empty()) {
            return chosen(&all, names).map(Some);
        }
    }
    Ok(None)
}

/// One column of each axis: those in one unit, in none, or in steps of an image, the first of these that there is.
fn chosen(all: &[Vec<usize>; 3], names: &[Name]) -> Result<Axes, HeadingDoubt> {
    let unit_of = |column: &usize| names[*column].unit.clone();
    let mut units: Vec<Option<String>> = all.iter().flatten().map(unit_of).collect();
    units.sort();
    units.dedup();
    let rank = |unit: &Option<String>| match unit.as_deref() {
        Some(unit) if !is_step(unit) => 0,
        None => 1,
        Some(_) => 2,
    };
    let in_unit = |unit: &Option<String>| {
        let one = |columns: &Vec<usize>| {
            let mut own = columns.iter().filter(|column| unit_of(column) == *unit);
            own.next().copied().filter(|_| own.next().is_none())
        };
        let [x, y, z] = [0, 1, 2].map(|axis| one(&all[axis]));
        Some((rank(unit), [x?, y?, z?], unit.clone()))
    };
    let mut complete: Vec<_> = units.iter().filter_map(in_unit).collect();
    complete.sort();
    match complete.as_slice() {
        [(_, columns, unit)] => Ok(Axes::in_unit(*columns, unit.clone())),
        [(best, columns, unit), (next, ..), ..] if best < next => {
            Ok(Axes::in_unit(*columns, unit.clone()))
        }
        [] if all.iter().all(|columns| columns.len() == 1) => {
            let told: Vec<String> = units.into_iter().flatten().collect();
            match told.len() {
                1 => Ok(Axes::in_unit([0, 1, 2].map(|axis| all[axis][0]), None)),
                _ => Err(HeadingDoubt::Units(told)),
            }
        }
        _ => Err(HeadingDoubt::Twice),
    }
}

#[cfg(test)]
mod tests;
