//! What stands between the columns of a table.

use crate::scan::text::words;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Separator {
    Blank,
    Byte(u8),
}

impl Separator {
    pub(super) fn of(row: &[u8]) -> Self {
        let used = [b';', b','].into_iter().find(|byte| row.contains(byte));
        used.map_or(Self::Blank, Self::Byte)
    }

    /// The columns of a row, without the quotes around them.
    pub(super) fn split(self, row: &[u8]) -> impl Iterator<Item = &[u8]> {
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
            .map(unquoted)
    }
}

/// A column without the quotes around it. One that has a quote at one end only was cut at a separator within, and is
/// left as it is.
fn unquoted(column: &[u8]) -> &[u8] {
    let inner = column.strip_prefix(b"\"");
    let inner = inner.and_then(|inner| inner.strip_suffix(b"\""));
    inner.map_or(column, <[u8]>::trim_ascii)
}
