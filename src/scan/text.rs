//! Lines and numbers of text formats, as bytes: nothing here needs the file to be UTF-8.

use super::error::{ParseError, Place};

/// Lines with their numbers, counted from one. A line ends at LF, CR LF or CR.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// The number of the line read last.
    pub(super) number: usize,
}

impl<'a> Lines<'a> {
    /// Lines of `rest`, when `number` lines stand before it.
    pub(super) fn after(number: usize, rest: &'a [u8]) -> Self {
        Self { rest, number }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let (line, rest) = match end {
            None => (self.rest, &[][..]),
            Some(end) if self.rest[end..].starts_with(b"\r\n") => {
                (&self.rest[..end], &self.rest[end + 2..])
            }
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
        };
        self.rest = rest;
        self.number += 1;
        Some((self.number, line))
    }
}

/// The words of a line, between blanks.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// What stands between blanks, commas and semicolons.
pub(super) fn cells(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|byte| byte.is_ascii_whitespace() || matches!(byte, b',' | b';'))
        .filter(|cell| !cell.is_empty())
}

/// A number, perhaps not finite.
pub(super) fn number(line: usize, word: &[u8]) -> Result<f64, ParseError> {
    std::str::from_utf8(word)
        .ok()
        .and_then(|word| {
            let number = word.parse().ok();
            number
                .or_else(|| of_fortran(word))
                .or_else(|| of_windows(word))
        })
        .ok_or_else(|| unexpected(line, "a number with a decimal point", word))
}

/// A number such as `1.5D+00`, as Fortran writes those of double precision.
fn of_fortran(word: &str) -> Option<f64> {
    let (digits, exponent) = word.split_once(['D', 'd'])?;
    format!("{digits}e{exponent}").parse().ok()
}

/// What is no finite number, as programs of Windows write it: `1.#QNAN`, `-1.#IND`, `1.#INF` or `-nan(ind)`.
fn of_windows(word: &str) -> Option<f64> {
    let word = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    match word.strip_prefix("1.#") {
        Some(name) if name.starts_with("inf") => Some(f64::INFINITY),
        Some(name) => (!name.is_empty()).then_some(f64::NAN),
        None => word.starts_with("nan(").then_some(f64::NAN),
    }
}

/// A number that can be a coordinate.
pub(super) fn coordinate(line: usize, word: &[u8]) -> Result<f64, ParseError> {
    let value = number(line, word)?;
    if value.is_finite() {
        Ok(value)
    } else {
        let place = Place::Line(line);
        Err(ParseError::NotFinite { place })
    }
}

/// A whole number.
pub(super) fn integer(line: usize, word: &[u8]) -> Result<i64, ParseError> {
    std::str::from_utf8(word)
        .ok()
        .and_then(|word| word.parse().ok())
        .ok_or_else(|| unexpected(line, "a whole number", word))
}

pub(super) fn unexpected(line: usize, expected: &'static str, found: &[u8]) -> ParseError {
    ParseError::Unexpected {
        place: Place::Line(line),
        expected,
        found: quote(found),
    }
}

/// The start of some bytes, fit for a message on one line.
pub(super) fn quote(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let bytes = bytes.trim_ascii();
    if bytes.is_empty() {
        return "nothing".into();
    }
    let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST)]);
    let dots = if bytes.len() > LONGEST { "..." } else { "" };
    format!("`{}{dots}`", shown.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_lf_crlf_and_cr() {
        let lines: Vec<_> = Lines::after(0, b"a\nb\r\nc\rd\n\re").collect();
        let expected: [&[u8]; 6] = [b"a", b"b", b"c", b"d", b"", b"e"];
        assert_eq!(lines.iter().map(|l| l.1).collect::<Vec<_>>(), expected);
        assert_eq!(lines[5].0, 6);
    }

    #[test]
    fn a_decimal_comma_is_not_a_number() {
        assert!(number(3, b"1,5").is_err());
        assert_eq!(number(3, b"+.5"), Ok(0.5));
    }

    #[test]
    fn what_windows_writes_for_no_number_is_none() {
        for word in [
            "1.#QNAN",
            "-1.#IND",
            "-1.#IND00",
            "1.#SNAN",
            "-nan(ind)",
            "NaN(snan)",
            "1.#QO",
        ] {
            assert!(number(1, word.as_bytes()).unwrap().is_nan(), "{word}");
        }
        for word in ["1.#INF", "-1.#INF00"] {
            assert!(number(1, word.as_bytes()).unwrap().is_infinite(), "{word}");
        }
        for word in ["1.#", "2.#INF", "nano", "#INF"] {
            assert!(number(1, word.as_bytes()).is_err(), "{word}");
        }
    }

    #[test]
    fn quotes_are_short_and_on_one_line() {
        assert_eq!(quote(b"a\tb\xff\n"), "`a\\tb\u{fffd}`");
        assert!(quote(&[b'x'; 1000]).len() < 50);
    }
}
