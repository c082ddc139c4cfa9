//! Text STL: any case, any line ends, several solids, names of any content and encoding.
//!
//! Normals and colours are passed over unread: writers fill normals with zeros or NaN, and winding decides.

use nalgebra::Point3;

use crate::scan::Scan;
use crate::scan::error::{ParseError, Place};
use crate::scan::text::{Lines, coordinate, unexpected, words};
use crate::scan::weld::Welder;

pub(super) fn read(bytes: &[u8]) -> Result<(Scan, Welder), ParseError> {
    let mut scan = Scan::default();
    let mut welder = Welder::default();
    let mut rows = Rows(Lines::after(0, bytes));
    let mut inside_solid = false;
    while let Some((line, row)) = rows.next_row() {
        let word = words(row).next().unwrap_or_default();
        if word.eq_ignore_ascii_case(b"solid") {
            inside_solid = true;
        } else if word.eq_ignore_ascii_case(b"endsolid") {
            inside_solid = false;
        } else if word.eq_ignore_ascii_case(b"facet") {
            let corners = rows.read_facet()?;
            scan.triangles
                .push(corners.map(|corner| welder.add(corner)));
        } else if !word.eq_ignore_ascii_case(b"color") {
            return Err(unexpected(line, "`facet`, `solid` or `endsolid`", row));
        }
    }
    if inside_solid {
        let warning = "The file ends without `endsolid`; facets may be missing.";
        scan.warnings.push(warning.into());
    }
    Ok((scan, welder))
}

struct Rows<'a>(Lines<'a>);

impl<'a> Rows<'a> {
    fn next_row(&mut self) -> Option<(usize, &'a [u8])> {
        self.0.find(|(_, line)| !line.trim_ascii().is_empty())
    }

    /// What follows a line `facet normal`, up to `endfacet`.
    fn read_facet(&mut self) -> Result<[Point3<f64>; 3], ParseError> {
        self.expect("outer", "`outer loop`")?;
        let corners = [self.corner()?, self.corner()?, self.corner()?];
        self.expect("endloop", "`endloop` after three corners")?;
        self.expect("endfacet", "`endfacet`")?;
        Ok(corners)
    }

    /// The next row, which must start with `word`.
    fn expect(
        &mut self,
        word: &str,
        expected: &'static str,
    ) -> Result<(usize, &'a [u8]), ParseError> {
        let Some((line, row)) = self.next_row() else {
            let place = Place::Line(self.0.number);
            return Err(ParseError::CutShort { place, expected });
        };
        let first = words(row).next().unwrap_or_default();
        if first.eq_ignore_ascii_case(word.as_bytes()) {
            Ok((line, row))
        } else {
            Err(unexpected(line, expected, row))
        }
    }

    fn corner(&mut self) -> Result<Point3<f64>, ParseError> {
        const EXPECTED: &str = "`vertex` and three numbers, three times per facet";
        let (line, row) = self.expect("vertex", EXPECTED)?;
        let mut values = words(row).skip(1);
        match [(); 4].map(|()| values.next()) {
            [Some(x), Some(y), Some(z), None] => Ok(Point3::new(
                coordinate(line, x)?,
                coordinate(line, y)?,
                coordinate(line, z)?,
            )),
            _ => Err(unexpected(line, EXPECTED, row)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scan::stl::parse;

    const FACET: &str = "FACET NORMAL nan 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0.1\n\
        vertex 0 1 0\nendloop\nendfacet\n";

    #[test]
    fn every_solid_counts_and_names_may_be_keywords() {
        let text = format!(
            "solid facet\ncolor 0.5 0.5 1\n{FACET}endsolid facet\nSolid\n{FACET}endsolid\n"
        );
        for text in [
            text.clone(),
            text.replace('\n', "\r"),
            text.replace('\n', "\r\n"),
        ] {
            let scan = parse(text.as_bytes()).unwrap();
            assert_eq!((scan.points.len(), scan.triangles.len()), (3, 2));
            assert!(scan.warnings.is_empty(), "{:?}", scan.warnings);
        }
    }

    #[test]
    fn numbers_keep_more_than_32_bits() {
        assert_eq!(
            parse(format!("solid\n{FACET}").as_bytes()).unwrap().points[1].z,
            0.1
        );
    }

    #[test]
    fn a_missing_endsolid_leaves_a_warning() {
        let scan = parse(format!("solid\n{FACET}").as_bytes()).unwrap();
        assert!(scan.warnings[0].contains("endsolid"), "{:?}", scan.warnings);
    }

    #[test]
    fn two_corners_are_refused_with_the_line() {
        let text = format!("solid\n{}", FACET.replace("vertex 1 0 0.1\n", ""));
        let error = parse(text.as_bytes()).unwrap_err();
        assert!(error.to_string().starts_with("line 6:"), "{error}");
    }
}
