//! Wavefront OBJ: points and faces; all else is passed over.
//!
//! A reader of our own, since tobj 4.0 drops the points of a file without faces, copies them once
//! per group, and fails on lines continued by `\`.

use std::borrow::Cow;

use nalgebra::Point3;

use super::Scan;
use super::error::{ParseError, Place};
use super::polygon::Faces;
use super::text::{Lines, integer, number, unexpected, words};
use super::unseen::drop_unseen;
use crate::digits::plural;

/// The words that OBJ files begin with; nothing else does.
const KEYWORDS: [&[u8]; 11] = [
    b"v", b"vn", b"vt", b"f", b"fo", b"o", b"g", b"s", b"p", b"mtllib", b"usemtl",
];

/// Whether the first line that is no remark is one of OBJ.
pub(super) fn recognise(bytes: &[u8]) -> bool {
    let first = Lines::after(0, bytes)
        .filter_map(|(_, line)| words(line).next())
        .find(|word| !word.starts_with(b"#"));
    first.is_some_and(|word| KEYWORDS.contains(&word))
}

pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let mut scan = Scan::default();
    let (mut faces, mut corners) = (Faces::default(), Vec::new());
    // The highest index of a face so far, and its line: faces may come before their points.
    let mut highest = (0, 0);
    let mut short = 0;
    let mut lines = Lines::after(0, bytes);
    while let Some((number, line)) = lines.next() {
        let line = whole_line(line, &mut lines);
        let mut values = words(&line).take_while(|word| !word.starts_with(b"#"));
        match values.next() {
            Some(b"v") => scan.points.push(vertex(number, &line, values)?),
            // `fo` is how the first programs wrote it.
            Some(b"f" | b"fo") => {
                corners.clear();
                for value in values {
                    let index = corner(number, value, scan.points.len())?;
                    highest = highest.max((index, number));
                    corners.push(index);
                }
                short += usize::from(corners.len() < 3);
                faces.add(&corners);
            }
            _ => {}
        }
    }
    if short > 0 {
        let faces = plural(short, "face");
        scan.warnings
            .push(format!("Dropped {faces} of fewer than three corners."));
    }
    let (index, line) = highest;
    if !faces.is_empty() && index as usize >= scan.points.len() {
        return Err(out_of_range(line, i64::from(index) + 1, scan.points.len()));
    }
    faces.give(&mut scan);
    drop_unseen(&mut scan)?;
    Ok(scan)
}

/// The point of a line `v`. A fourth number that ends the line is a weight, by which the others are divided, or what a
/// scanner put there, by which they are not: only 1 leaves no doubt. Where more follow they are a colour.
fn vertex<'a>(
    line: usize,
    text: &[u8],
    values: impl Iterator<Item = &'a [u8]>,
) -> Result<Point3<f64>, ParseError> {
    let values: Vec<&[u8]> = values.collect();
    let [x, y, z, rest @ ..] = &values[..] else {
        return Err(unexpected(line, "`v` and three numbers", text));
    };
    let point = Point3::new(number(line, x)?, number(line, y)?, number(line, z)?);
    let &[weight] = rest else {
        return Ok(point);
    };
    match number(line, weight)? {
        1.0 => Ok(point),
        weight => Err(ParseError::Weight {
            place: Place::Line(line),
            weight,
        }),
    }
}

/// A line with those that continue it, where it ends with `\`. Remarks are never continued: one
/// may end with the path of a folder.
fn whole_line<'a>(first: &'a [u8], lines: &mut Lines<'a>) -> Cow<'a, [u8]> {
    let start = match first.strip_suffix(b"\\") {
        Some(start) if !start.trim_ascii_start().starts_with(b"#") => start,
        _ => return Cow::Borrowed(first),
    };
    let mut whole = start.to_vec();
    for (_, line) in lines {
        whole.push(b' ');
        match line.strip_suffix(b"\\") {
            Some(part) => whole.extend(part),
            None => {
                whole.extend(line);
                break;
            }
        }
    }
    Cow::Owned(whole)
}

/// The point that a corner such as `7`, `7/1/2` or `-1` names, counted from zero. Negative
/// numbers count back from the last point so far.
fn corner(line: usize, value: &[u8], points: usize) -> Result<u32, ParseError> {
    let end = value.iter().position(|&b| b == b'/');
    let index = integer(line, &value[..end.unwrap_or(value.len())])?;
    let from_zero = if index < 0 {
        index.checked_add(points as i64)
    } else {
        index.checked_sub(1)
    };
    from_zero
        .and_then(|index| u32::try_from(index).ok())
        .ok_or_else(|| out_of_range(line, index, points))
}

fn out_of_range(line: usize, index: i64, points: usize) -> ParseError {
    ParseError::IndexOutOfRange {
        place: Place::Line(line),
        index,
        points,
        first: 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

    #[test]
    fn points_without_faces_are_kept() {
        assert_eq!(parse(POINTS.as_bytes()).unwrap().points.len(), 4);
    }

    #[test]
    fn faces_may_be_polygons_relative_continued_and_ahead_of_their_points() {
        for face in [
            "f 1 2 3 4",
            "fo 1 2 3 4",
            "f 1/1 2//2 3/3/3 4",
            "f 1 2 \\\n3 4",
        ] {
            let expected = [[0, 1, 2], [0, 2, 3]];
            for text in [format!("{face}\n{POINTS}"), format!("{POINTS}{face}")] {
                assert_eq!(
                    parse(text.as_bytes()).unwrap().triangles,
                    expected,
                    "{text}"
                );
            }
        }
        let scan = parse(format!("{POINTS}f -4 -3 -1").as_bytes()).unwrap();
        assert_eq!(scan.triangles, [[0, 1, 3]]);
    }

    #[test]
    fn indices_out_of_range_are_refused_with_their_line() {
        for face in ["f 1 2 5", "f 0 1 2", "f -5 1 2", "f 1 2 99999999999"] {
            let error = parse(format!("{POINTS}{face}\nf 1 2 3").as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with("line 5:"), "{error}");
        }
    }

    #[test]
    fn a_fourth_number_is_refused_unless_it_is_one_and_six_are_a_place_and_a_colour() {
        let first = |line: &str| parse(format!("{line}\n{POINTS}").as_bytes()).map(|s| s.points[0]);
        for line in ["v 1 2 3", "v 1 2 3 1.0 # one", "v 1 2 3 .5 .5 .5"] {
            assert_eq!(first(line), Ok(Point3::new(1.0, 2.0, 3.0)), "{line}");
        }
        for line in [
            "v 1 2 3 0",
            "v 1 2 3 -1",
            "v 2 4 6 2",
            "v 1 2 3 .5",
            "v 1 2 3 x",
        ] {
            let told = first(line).unwrap_err().to_string();
            assert!(told.starts_with("line 1:"), "{told}");
        }
    }

    #[test]
    fn a_point_that_was_not_seen_is_dropped_unless_a_face_has_it() {
        let text = format!("v nan nan nan\n{POINTS}f 2 3 4\n");
        let scan = parse(text.as_bytes()).unwrap();
        assert_eq!(
            (scan.points.len(), &scan.triangles[..]),
            (4, &[[0, 1, 2]][..])
        );
        assert!(
            scan.warnings[0].starts_with("Dropped 1 point "),
            "{:?}",
            scan.warnings
        );
        let place = Place::Point(0);
        let found = parse(format!("{text}f 1 2 3").as_bytes());
        assert_eq!(found.unwrap_err(), ParseError::NotFinite { place });
    }

    #[test]
    fn a_remark_may_follow_a_face_and_a_point() {
        let points = POINTS.replace('\n', " # point\n");
        let scan = parse(format!("{points}f 1 2 3 # face 4\nf 1 2 4 #").as_bytes()).unwrap();
        assert_eq!(scan.triangles, [[0, 1, 2], [0, 1, 3]]);
    }

    #[test]
    fn a_remark_that_ends_with_a_backslash_does_not_swallow_a_point() {
        let scan = parse(format!("# from C:\\scans\\\n{POINTS}").as_bytes()).unwrap();
        assert_eq!(scan.points.len(), 4);
    }
}
