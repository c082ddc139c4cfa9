//! STL, in text or binary.
//!
//! stl_io writes our STL, but does not read it: its version 0.11 takes every file that starts
//! with `solid ` for text (many binary files do) and every other for binary (text without a name,
//! in upper case or after a blank), drops the second solid of a text file, keeps only 32 bits of
//! its numbers, and passes over NaN and spare bytes. What is left to do for a binary file, once
//! all that is ruled out, is one loop over records of 50 bytes.

mod ascii;

use nalgebra::Point3;

use super::Scan;
use super::error::{ParseError, Place};
use super::weld::Welder;
use crate::digits::plural;

const HEADER: usize = 84;
const FACET: usize = 50;

/// Whether the length is what the count at byte 80 asks for: no text passes this test.
pub(super) fn is_exactly_binary(bytes: &[u8]) -> bool {
    count(bytes).is_some_and(|count| count * FACET as u64 + HEADER as u64 == bytes.len() as u64)
}

/// Whether the file starts with the word `solid`, as text does, and some binary files.
pub(super) fn starts_with_solid(bytes: &[u8]) -> bool {
    let word = bytes.trim_ascii_start();
    word.get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        && word.get(5).is_none_or(u8::is_ascii_whitespace)
}

/// Reads either kind. Binary files hold a zero byte early on, in their count or attributes.
pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let start = &bytes[..bytes.len().min(512)];
    let text = starts_with_solid(bytes) && !start.contains(&0) && !is_exactly_binary(bytes);
    let (mut scan, welder) = if text {
        ascii::read(bytes)?
    } else {
        read_binary(bytes)?
    };
    scan.points = welder.into_points()?;
    Ok(scan)
}

fn count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(80..HEADER)?.first_chunk()?;
    Some(u32::from_le_bytes(*count).into())
}

fn read_binary(bytes: &[u8]) -> Result<(Scan, Welder), ParseError> {
    let Some(count) = count(bytes) else {
        return Err(ParseError::CutShort {
            place: Place::Byte(bytes.len()),
            expected: "the rest of a binary STL header (84 bytes), or a text starting with `solid`",
        });
    };
    let body = &bytes[HEADER..];
    let count = usize::try_from(count).unwrap_or(usize::MAX);
    let Some((facets, spare)) = count
        .checked_mul(FACET)
        .and_then(|needed| body.split_at_checked(needed))
    else {
        return Err(ParseError::CountTooLarge {
            byte: HEADER,
            element: "facet".into(),
            rows: count,
            row_bytes: FACET,
            left: body.len(),
        });
    };
    let mut scan = Scan::default();
    let mut welder = Welder::default();
    for (number, facet) in facets.chunks_exact(FACET).enumerate() {
        let corners = [12, 24, 36].map(|at| corner(&facet[at..at + 12]));
        if !corners.iter().flat_map(Point3::iter).all(|c| c.is_finite()) {
            let byte = HEADER + number * FACET;
            let what = "facet";
            let place = Place::Record { what, number, byte };
            return Err(ParseError::NotFinite { place });
        }
        scan.triangles
            .push(corners.map(|corner| welder.add(corner)));
    }
    if !spare.is_empty() {
        let (bytes, facets) = (plural(spare.len(), "byte"), plural(count, "facet"));
        scan.warnings.push(format!(
            "Left {bytes} unread after the {facets} that the header counts."
        ));
    }
    Ok((scan, welder))
}

fn corner(bytes: &[u8]) -> Point3<f64> {
    let coordinate = |at: usize| {
        let bytes = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
        f32::from_le_bytes(bytes).into()
    };
    Point3::new(coordinate(0), coordinate(4), coordinate(8))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binary(header: &[u8], facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend((facets.len() as u32).to_le_bytes());
        for corners in facets {
            bytes.extend([0; 12]);
            bytes.extend(corners.as_flattened().iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const FACETS: [[[f32; 3]; 3]; 2] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[1.0, 0.0, -0.0], [1.0, 1.0, 2.0], [0.0, 1.0, 0.0]],
    ];

    #[test]
    fn corners_are_shared_and_minus_zero_is_zero() {
        let scan = parse(&binary(b"", &FACETS)).unwrap();
        assert_eq!(scan.points.len(), 4);
        assert_eq!(scan.triangles, [[0, 1, 2], [1, 3, 2]]);
    }

    #[test]
    fn a_binary_header_may_start_with_solid() {
        let mut bytes = binary(b"solid part1\nfacet normal", &FACETS);
        assert_eq!(parse(&bytes).unwrap().triangles.len(), 2);
        bytes.extend([1, 2, 3]);
        let scan = parse(&bytes).unwrap();
        assert_eq!(scan.triangles.len(), 2);
        assert!(
            scan.warnings[0].starts_with("Left 3 bytes "),
            "{:?}",
            scan.warnings
        );
    }

    #[test]
    fn a_count_beyond_the_file_is_refused() {
        let mut bytes = binary(b"", &FACETS);
        bytes[80..84].copy_from_slice(&4_000_000_000u32.to_le_bytes());
        let error = parse(&bytes).unwrap_err();
        assert!(
            matches!(error, ParseError::CountTooLarge { left: 100, .. }),
            "{error}"
        );
    }
}
