//! The PLY header: made harmless as bytes, then read by ply-rs.
//!
//! ply-rs 4.0 refuses a Latin-1 comment and a CR-only file, lets a repeated element or property
//! replace the first, and knows no property names such as `scalar_C2C_(1)`, which point cloud
//! programs write. So the header is rewritten line by line before ply-rs sees it: remarks lose
//! their text, properties that no one here reads get a plain name, and repetitions are refused.

use std::collections::HashSet;

use ply_rs::parser::{Parser, Reader};
use ply_rs::ply::{ElementDef, Encoding, PropertyAccess, PropertyType, Version};

use super::meaning;
use crate::scan::error::{ParseError, Place};
use crate::scan::text::{quote, unexpected, words};
use crate::scan::{heap, unit_remark};

/// Longest header, in bytes without the text of its remarks. Real ones stay below 10 kB; the
/// limit keeps a hostile header from filling the memory.
const LONGEST_HEADER: usize = 1 << 20;

/// The properties that are read; all others only take up room in their row.
const NAMES: [&[u8]; 7] = [b"x", b"y", b"z", b"X", b"Y", b"Z", b"vertex_indices"];

pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<ElementDef>,
    /// How many points the element `vertex` promises.
    pub(super) points: usize,
    /// Where the body starts, in bytes.
    pub(super) body: usize,
    /// How many lines the header takes.
    pub(super) lines: usize,
    /// Whether the version is one that this reader was written for.
    pub(super) known_version: bool,
    /// The unit of lengths that a comment tells.
    pub(super) unit: Option<String>,
    /// What is odd: whole sentences.
    pub(super) warnings: Vec<String>,
}

/// A row that only has to be passed over.
pub(super) struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Header, ParseError> {
    let newline = newline(bytes);
    let mut rewriter = Rewriter::default();
    let mut body = 0;
    for (index, line) in bytes.split(|&b| b == newline).enumerate() {
        body += line.len() + 1;
        if rewriter.push(index + 1, line.trim_ascii())? {
            let original = |line: usize| bytes.split(|&b| b == newline).nth(line - 1);
            let mut header = parse(&rewriter.text, body.min(bytes.len()), index + 1, original)?;
            header.unit = rewriter.unit;
            header.warnings.extend(rewriter.warnings);
            return Ok(header);
        }
    }
    Err(ParseError::CutShort {
        place: Place::Line(bytes.split(|&b| b == newline).count()),
        expected: "`end_header`",
    })
}

/// The byte that ends header lines, decided by the first one: a CR-only header may be followed
/// by a body that starts with LF.
fn newline(bytes: &[u8]) -> u8 {
    let first = bytes.iter().position(|b| matches!(b, b'\n' | b'\r'));
    match first.map(|at| &bytes[at..]) {
        Some([b'\r', next, ..]) if *next != b'\n' => b'\r',
        _ => b'\n',
    }
}

#[derive(Default)]
struct Rewriter {
    text: String,
    elements: HashSet<Vec<u8>>,
    properties: HashSet<Vec<u8>>,
    unit: Option<String>,
    warnings: Vec<String>,
}

impl Rewriter {
    /// Adds a line; true when it ends the header.
    fn push(&mut self, number: usize, line: &[u8]) -> Result<bool, ParseError> {
        let mut tokens: Vec<&[u8]> = words(line).collect();
        let fresh_name = format!("other{number}");
        match tokens.first().copied().unwrap_or(b"comment") {
            magic if number == 1 => {
                if !magic.eq_ignore_ascii_case(b"ply") {
                    return Err(unexpected(number, "`ply` as the first line", line));
                }
                tokens = vec![b"ply"];
            }
            b"comment" | b"obj_info" => {
                let remark = line.strip_prefix(b"comment ").unwrap_or_default();
                let remark = str::from_utf8(remark).unwrap_or_default();
                self.warnings.extend(heap::warning(remark));
                self.unit = unit_remark::unit(remark).or(self.unit.take());
                tokens = vec![b"comment"];
            }
            b"format" | b"end_header" => {}
            b"element" => {
                self.properties.clear();
                if let Some(name) = tokens.get(1)
                    && !self.elements.insert(name.to_vec())
                {
                    return Err(unexpected(number, "an element not declared before", name));
                }
            }
            b"property" => {
                self.check_property(number, line, &mut tokens, fresh_name.as_bytes())?;
            }
            _ => {
                let expected = "a header line: format, comment, element, property or end_header";
                return Err(unexpected(number, expected, line));
            }
        }
        for token in &tokens {
            self.text += &String::from_utf8_lossy(token);
            self.text.push(' ');
        }
        self.text.push('\n');
        if self.text.len() > LONGEST_HEADER {
            return Err(unexpected(number, "the end of the header by now", line));
        }
        Ok(line == b"end_header")
    }

    /// Keeps the name of a property that is read, once per element, and replaces any other.
    fn check_property<'a>(
        &mut self,
        number: usize,
        line: &[u8],
        tokens: &mut [&'a [u8]],
        fresh_name: &'a [u8],
    ) -> Result<(), ParseError> {
        const FLOATS: [&[u8]; 4] = [b"float", b"float32", b"double", b"float64"];
        if let [_, b"list", length, ..] = tokens
            && FLOATS.contains(length)
        {
            return Err(unexpected(number, "a list length of an integer type", line));
        }
        let [_, .., name] = tokens else {
            return Ok(());
        };
        if *name == b"vertex_index" {
            *name = b"vertex_indices";
        }
        if !NAMES.contains(name) {
            *name = fresh_name;
        } else if !self.properties.insert(name.to_vec()) {
            return Err(unexpected(number, "a property not declared before", name));
        }
        Ok(())
    }
}

fn parse<'a>(
    text: &str,
    body: usize,
    lines: usize,
    original: impl Fn(usize) -> Option<&'a [u8]>,
) -> Result<Header, ParseError> {
    let header = Parser::<Skipped>::new()
        .read_header(&mut Reader::new(text.as_bytes()))
        .map_err(|error| {
            let line = error.line().unwrap_or(lines);
            let found = original(line).unwrap_or_default();
            unexpected(line, expectation(found), found)
        })?;
    let mut elements: Vec<ElementDef> = header.elements.into_values().collect();
    let warnings = meaning::settle(&mut elements);
    let empty = |element: &&ElementDef| element.properties.is_empty() && element.count > 0;
    if let Some(element) = elements.iter().find(empty) {
        return Err(ParseError::Unexpected {
            place: Place::Line(lines),
            expected: "a property in every element with rows",
            found: format!("none in {}", quote(element.name.as_bytes())),
        });
    }
    Ok(Header {
        encoding: header.encoding,
        points: count_points(&elements)?,
        elements,
        body,
        lines,
        known_version: header.version == Version { major: 1, minor: 0 },
        unit: None,
        warnings,
    })
}

/// What ply-rs wanted where it stopped, by the line's first word.
fn expectation(line: &[u8]) -> &'static str {
    match words(line).next() {
        Some(b"element") => "`element`, a name and a row count",
        Some(b"property") => "`property`, a type and a name, below an `element`",
        _ => "one `format` line such as `format ascii 1.0` in the header",
    }
}

fn count_points(elements: &[ElementDef]) -> Result<usize, ParseError> {
    let vertex = elements.iter().find(|element| element.name == "vertex");
    let axis = |name: &&str| {
        let property = vertex.and_then(|vertex| vertex.properties.get(*name));
        property.is_some_and(|axis| matches!(axis.data_type, PropertyType::Scalar(_)))
    };
    match (["x", "y", "z"].into_iter().find(|name| !axis(name)), vertex) {
        (Some(axis), _) => Err(ParseError::NoCoordinate { axis }),
        (None, Some(vertex)) if vertex.count > 0 => Ok(vertex.count),
        _ => Err(ParseError::NoPoints),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOUD: &str = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";

    fn header(rest: &str) -> Result<Header, ParseError> {
        read(format!("ply\nformat ascii 1.0\n{rest}end_header\n").as_bytes())
    }

    #[test]
    fn odd_and_repeated_names_keep_their_place_in_the_row() {
        let odd = "property float scalar_(1)\nproperty uchar a\nproperty uchar a\n";
        let header = header(&format!("{CLOUD}{odd}")).unwrap();
        assert_eq!(header.elements[0].properties.len(), 6);
    }

    #[test]
    fn repetitions_are_refused_with_their_line() {
        let error = header(&format!("{CLOUD}property float x\n")).err().unwrap();
        assert!(error.to_string().starts_with("line 7:"), "{error}");
        let error = header(&format!("{CLOUD}{CLOUD}")).err().unwrap();
        assert!(error.to_string().starts_with("line 7:"), "{error}");
    }

    #[test]
    fn errors_of_ply_rs_show_the_line_as_written() {
        let error = header("element vertex -5\n").err().unwrap().to_string();
        assert!(error.starts_with("line 3: expected `element`"), "{error}");
        assert!(error.contains("`element vertex -5`"), "{error}");
    }

    #[test]
    fn a_cr_header_keeps_the_line_feed_of_the_body() {
        let bytes = CLOUD.replace('\n', "\r");
        let bytes = format!("ply\rformat ascii 1.0\r{bytes}end_header\r\nrest");
        let header = read(bytes.as_bytes()).unwrap();
        assert_eq!(&bytes[header.body..], "\nrest");
    }
}
