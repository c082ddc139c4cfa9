//! Which format the bytes are in. The content decides; the extension only where it does not.

use super::error::ParseError;
use super::{obj, stl};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Format {
    Ply,
    Stl,
    Obj,
    Xyz,
}

/// Starts of files that are often taken for scans: what they are, and what to do.
const FOREIGN: [(&[u8], &str, &str); 14] = [
    (b"\x1f\x8b", "gzip data", UNPACK),
    (b"PK\x03\x04", "a zip archive", UNPACK),
    (b"BZh", "bzip2 data", UNPACK),
    (b"\xfd7zXZ", "xz data", UNPACK),
    (
        b"version https://git-lfs",
        "a Git LFS pointer",
        "fetch the file itself with `git lfs pull`",
    ),
    (b"\xff\xfe", "UTF-16 text", "save it as UTF-8 or ASCII"),
    (b"\xfe\xff", "UTF-16 text", "save it as UTF-8 or ASCII"),
    (
        b"<",
        "a web page or XML",
        "download the file itself or convert it to PLY",
    ),
    (b"OFF", "an OFF mesh", CONVERT),
    (b"glTF", "a glTF model", CONVERT),
    (b"LASF", "a LAS point cloud", CONVERT),
    (b"ASTM-E57", "an E57 point cloud", CONVERT),
    (b"# .PCD", "a PCD point cloud", CONVERT),
    (b"# vtk", "a VTK file", CONVERT),
];
const UNPACK: &str = "unpack it first";
const CONVERT: &str = "convert it to PLY";

pub(super) fn detect(bytes: &[u8], extension: Option<&str>) -> Result<Format, ParseError> {
    if bytes.is_empty() {
        return Err(ParseError::Empty);
    }
    if stl::is_exactly_binary(bytes) {
        return Ok(Format::Stl);
    }
    let start = bytes.trim_ascii_start();
    for (magic, what, advice) in FOREIGN {
        if start.starts_with(magic) {
            return Err(ParseError::Foreign { what, advice });
        }
    }
    if starts_with_ply(bytes) {
        return Ok(Format::Ply);
    }
    if stl::starts_with_solid(bytes) {
        return Ok(Format::Stl);
    }
    let extension = extension.map(str::to_ascii_lowercase);
    match (first_strange_byte(bytes), extension.as_deref()) {
        (Some(_), Some("stl")) => Ok(Format::Stl),
        (Some(byte), _) => Err(ParseError::Unknown { byte }),
        (None, _) if obj::recognise(bytes) => Ok(Format::Obj),
        (None, Some("ply")) => Ok(Format::Ply),
        (None, Some("stl")) => Ok(Format::Stl),
        (None, Some("obj")) => Ok(Format::Obj),
        (None, _) => Ok(Format::Xyz),
    }
}

fn starts_with_ply(bytes: &[u8]) -> bool {
    let [a, b, c, next, ..] = *bytes else {
        return false;
    };
    [a, b, c].eq_ignore_ascii_case(b"ply") && next.is_ascii_whitespace()
}

/// The first byte that text of no single-byte encoding nor UTF-8 holds, early in the file.
fn first_strange_byte(bytes: &[u8]) -> Option<usize> {
    let strange = |b: &u8| b.is_ascii_control() && !b.is_ascii_whitespace();
    bytes.iter().take(4096).position(strange)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides_against_the_extension() {
        let cases: [(&[u8], Format); 5] = [
            (b"ply\n", Format::Ply),
            (b"PLY\r\n", Format::Ply),
            (b" solid\nfacet", Format::Stl),
            (b"# remark\n\nv 1 2 3", Format::Obj),
            (b"1 2 3", Format::Xyz),
        ];
        for (bytes, format) in cases {
            assert_eq!(detect(bytes, Some("txt")), Ok(format));
            assert_eq!(detect(bytes, None), Ok(format));
        }
    }

    #[test]
    fn the_extension_decides_where_the_content_does_not() {
        assert_eq!(detect(&[1; 90], Some("STL")), Ok(Format::Stl));
        assert_eq!(detect(&[1; 90], None), Err(ParseError::Unknown { byte: 0 }));
        assert_eq!(detect(b"a b c\n1 2 3", Some("obj")), Ok(Format::Obj));
    }

    #[test]
    fn a_binary_header_of_obj_words_stays_stl() {
        let bytes = [&b"o part"[..], &[0; 200]].concat();
        assert_eq!(detect(&bytes, Some("stl")), Ok(Format::Stl));
    }

    #[test]
    fn foreign_files_are_named() {
        for (bytes, what) in [
            (&b"\x1f\x8b\x08"[..], "gzip"),
            (b"<!DOCTYPE html>", "web page"),
        ] {
            let error = detect(bytes, Some("stl")).unwrap_err().to_string();
            assert!(error.contains(what), "{error}");
        }
    }
}
