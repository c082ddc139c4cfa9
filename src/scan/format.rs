//! Which format the bytes are in. The content decides; the extension only where it does not.

use super::error::ParseError;
use super::text::{Lines, cells, number};
use super::{obj, stl};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Format {
    Ply,
    Stl,
    Obj,
    Xyz,
}

/// Starts of files that are often taken for scans: what they are, and what to do.
const FOREIGN: [(&[u8], &str, &str); 34] = [
    (b"\x1f\x8b", "gzip data", UNPACK),
    (b"BZh", "bzip2 data", UNPACK),
    (b"\xfd7zXZ", "xz data", UNPACK),
    (b"7z\xbc\xaf", "a 7z archive", UNPACK),
    (b"Rar!", "a RAR archive", UNPACK),
    (b"\x28\xb5\x2f\xfd", "zstd data", UNPACK),
    (
        b"version https://git-lfs",
        "a Git LFS pointer",
        "fetch the file itself with `git lfs pull`",
    ),
    (b"\xff\xfe", UTF_16.0, UTF_16.1),
    (b"\xfe\xff", UTF_16.0, UTF_16.1),
    (b"<?xml", "XML, as of AMF, X3D or VTP", CONVERT),
    (
        b"<",
        "a web page or XML",
        "download the file itself or convert it to PLY",
    ),
    (b"OFF\n", "an OFF mesh", CONVERT),
    (b"OFF\r", "an OFF mesh", CONVERT),
    (b"OFF ", "an OFF mesh", CONVERT),
    (b"COFF\n", "an OFF mesh", CONVERT),
    (b"NOFF\n", "an OFF mesh", CONVERT),
    (b"glTF", "a glTF model", CONVERT),
    (b"LASF", "a LAS point cloud", CONVERT),
    (b"ASTM-E57", "an E57 point cloud", CONVERT),
    (b"# .PCD", "a PCD point cloud", CONVERT),
    (b"# vtk", "a VTK file", CONVERT),
    (b"#VRML", "a VRML model", CONVERT),
    (b"# AmiraMesh", "an Amira file", CONVERT),
    (b"# Avizo", "an Avizo file", CONVERT),
    (b"# HyperSurface", "an Amira surface", CONVERT),
    (b"ISO-10303-21", "a STEP model", "export its mesh as STL"),
    (b"$MeshFormat", "a gmsh mesh", CONVERT),
    (b"Kaydara FBX", "an FBX model", CONVERT),
    (b"BLENDER", "a Blender file", "export the mesh as PLY"),
    (b"%PDF", "a PDF", "take the scan itself"),
    (b"{\\rtf", "RTF text", "save it as plain text"),
    (b"MATLAB 5.0", "a MATLAB file", FROM_MATLAB),
    (b"\x89HDF", "an HDF5 or MATLAB file", FROM_MATLAB),
    (
        b"\xd0\xcf\x11\xe0",
        "an Excel workbook or another file of Office",
        "save its table as CSV",
    ),
];

/// Names in a zip archive that tell what it is, and what to do.
const IN_ZIP: [(&[u8], &str, &str); 3] = [
    (b"xl/", "an Excel workbook", "save its sheet as CSV"),
    (b"3D/", "a 3MF model", "convert it to STL"),
    (
        b".npy",
        "arrays of NumPy",
        "write the points with `numpy.savetxt`",
    ),
];
const FROM_MATLAB: &str = "write its points with `writematrix`, or its faces with `stlwrite`";
const UTF_16: (&str, &str) = ("UTF-16 text", "save it as UTF-8 or ASCII");
const UNPACK: &str = "unpack it first";
const CONVERT: &str = "convert it to PLY";

/// Bytes before the mark of a DICOM image.
const PREAMBLE: usize = 128;

/// Bytes that tell whether a file is text.
const EARLY: usize = 4096;

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
    if start.starts_with(b"PK\x03\x04") {
        let (what, advice) = in_zip(start);
        return Err(ParseError::Foreign { what, advice });
    }
    if bytes
        .get(PREAMBLE..)
        .is_some_and(|rest| rest.starts_with(b"DICM"))
    {
        let (what, advice) = (
            "a DICOM image",
            "export the segmented grain as NRRD or NIfTI",
        );
        return Err(ParseError::Foreign { what, advice });
    }
    if is_utf_16(bytes) {
        let (what, advice) = UTF_16;
        return Err(ParseError::Foreign { what, advice });
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
        (None, _) if begins_with_row(bytes) => Ok(Format::Xyz),
        (None, Some("ply")) => Ok(Format::Ply),
        (None, Some("stl")) => Ok(Format::Stl),
        (None, Some("obj")) => Ok(Format::Obj),
        (None, _) => Ok(Format::Xyz),
    }
}

/// What a zip archive is, by the names of what is in it.
fn in_zip(bytes: &[u8]) -> (&'static str, &'static str) {
    let holds = |name: &[u8]| {
        let start = &bytes[..bytes.len().min(EARLY)];
        start.windows(name.len()).any(|window| window == name)
    };
    let known = IN_ZIP.into_iter().find(|(name, ..)| holds(name));
    known.map_or(("a zip archive", UNPACK), |(_, what, advice)| {
        (what, advice)
    })
}

/// Whether the first line that is no remark is three numbers or more, as in a table.
fn begins_with_row(bytes: &[u8]) -> bool {
    let mut lines = Lines::after(0, bytes).map(|(_, line)| line.trim_ascii());
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"));
    first.is_some_and(|line| {
        cells(line).count() >= 3 && cells(line).all(|cell| number(0, cell).is_ok())
    })
}

/// Whether a file begins as UTF-16 does without a mark: every other byte is zero, and those between are text.
fn is_utf_16(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(EARLY)];
    let every_other = |first: usize| start.iter().skip(first).step_by(2);
    let is_text_after = |zeros: usize| {
        let are_zeros = every_other(zeros).all(|byte| *byte == 0);
        are_zeros && !every_other(1 - zeros).any(is_strange)
    };
    start.len() > 1 && [0, 1].into_iter().any(is_text_after)
}

fn starts_with_ply(bytes: &[u8]) -> bool {
    let [a, b, c, next, ..] = *bytes else {
        return false;
    };
    [a, b, c].eq_ignore_ascii_case(b"ply") && next.is_ascii_whitespace()
}

/// The first byte that text of no single-byte encoding nor UTF-8 holds, early in the file.
fn first_strange_byte(bytes: &[u8]) -> Option<usize> {
    bytes.iter().take(EARLY).position(is_strange)
}

fn is_strange(byte: &u8) -> bool {
    byte.is_ascii_control() && !byte.is_ascii_whitespace()
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
        assert_eq!(detect(b"# remark\n1 2 3 4", Some("obj")), Ok(Format::Xyz));
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
            (b"\xff\xfe1\0 \0", "UTF-16"),
            (b"1\0 \x002\0", "UTF-16"),
            (b"\x001\0 \x002", "UTF-16"),
            (
                b"PK\x03\x04....[Content_Types].xml....xl/workbook.xml",
                "Excel",
            ),
            (b"PK\x03\x04....points.npy", "NumPy"),
            (b"PK\x03\x04....bean.ply", "zip"),
            (b"<?xml version='1.0'?><amf>", "AMF"),
            (b"\x89HDF\r\n", "MATLAB"),
        ] {
            let error = detect(bytes, Some("stl")).unwrap_err().to_string();
            assert!(error.contains(what), "{error}");
        }
    }
}
