//! What stands between the columns of a table.

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

    /// The columns of a row, without the quotes around them; what stands between quotes separates none.
    pub(super) fn split(self, row: &[u8]) -> impl Iterator<Item = &[u8]> {
        let mut is_quoted = false;
        let columns = row.split(move |byte| {
            is_quoted ^= *byte == b'"';
            !is_quoted && self.is_between(*byte)
        });
        let columns = columns.map(<[u8]>::trim_ascii);
        columns
            .filter(move |column| self != Self::Blank || !column.is_empty())
            .map(unquoted)
    }

    fn is_between(self, byte: u8) -> bool {
        match self {
            Self::Blank => byte.is_ascii_whitespace(),
            Self::Byte(separator) => byte == separator,
        }
    }
}

/// A column without the quotes around it. One that has a quote at one end only is left as it is.
fn unquoted(column: &[u8]) -> &[u8] {
    let inner = column.strip_prefix(b"\"");
    let inner = inner.and_then(|inner| inner.strip_suffix(b"\""));
    inner.map_or(column, <[u8]>::trim_ascii)
}
