//! The names by which programs call the columns of x, y and z.

use super::separator::Separator;

/// Words before an axis, or before its number from 0 on: `pos_x`, `Points_0` and `Points:0` (ParaView).
const PLACES: [&str; 8] = [
    "pos",
    "position",
    "point",
    "points",
    "coord",
    "coords",
    "coordinate",
    "coordinates",
];

/// Words after an axis that are no part of its name, as in `x_mm`.
const UNITS: [&str; 10] = [
    "nm", "um", "\u{b5}m", "\u{3bc}m", "mm", "cm", "dm", "m", "in", "px",
];

/// How an axis is named. Where a heading names the axes in several ways, the first of these counts.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// `x`
    Plain,
    /// `pos_x`, `Points_0` or `x_coord`
    Place,
    /// `px` or `posx`
    Together,
}

/// The columns of x, y and z, where a heading has a name for every column and names these.
pub(super) fn named_axes(
    heading: &[u8],
    separator: Separator,
    columns: usize,
) -> Option<[usize; 3]> {
    let mut separators = [separator, Separator::of(heading)].into_iter();
    separators.find_map(|separator| {
        let names = names(heading, separator);
        (names.len() == columns).then(|| axes(&names))?
    })
}

/// How many columns a heading names, if it names those of x, y and z among them.
pub(super) fn named_columns(heading: &[u8]) -> Option<usize> {
    let separator = Separator::of(heading);
    let columns = names(heading, separator).len();
    named_axes(heading, separator, columns).map(|_| columns)
}

/// The words of every name of a heading.
fn names(heading: &[u8], separator: Separator) -> Vec<Vec<String>> {
    // Between blanks a unit in brackets stands alone.
    let is_unit =
        |name: &[u8]| separator == Separator::Blank && matches!(name.first(), Some(b'(' | b'['));
    let names = separator.split(heading);
    names.filter(|name| !is_unit(name)).map(words).collect()
}

/// The words of a name, without its unit: those of `"X (mm)"` and of `x_mm` are `x`.
fn words(name: &[u8]) -> Vec<String> {
    let name = String::from_utf8_lossy(name).to_lowercase();
    let name = name.split(['(', '[']).next().unwrap_or_default();
    let words = name.split(|letter: char| !letter.is_alphanumeric());
    let words = words.filter(|word| !word.is_empty());
    let mut words: Vec<String> = words.map(str::to_owned).collect();
    if let [_, .., last] = words.as_slice()
        && UNITS.contains(&last.as_str())
    {
        words.pop();
    }
    words
}

fn axes(names: &[Vec<String>]) -> Option<[usize; 3]> {
    let axes: Vec<_> = names.iter().map(|words| axis(words)).collect();
    let ways = [Way::Plain, Way::Place, Way::Together].into_iter();
    let mut found = ways.filter_map(|way| {
        let column = |axis| axes.iter().position(|found| *found == Some((way, axis)));
        Some([column(0)?, column(1)?, column(2)?])
    });
    found.next()
}

/// The axis that the words of a name mean.
fn axis(words: &[String]) -> Option<(Way, usize)> {
    let of_letter = |word: &str| ["x", "y", "z"].iter().position(|axis| *axis == word);
    let of_number = |word: &str| ["0", "1", "2"].iter().position(|axis| *axis == word);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [word] => {
            let plain = of_letter(word).map(|axis| (Way::Plain, axis));
            plain.or_else(|| {
                let rest = ["pos", "p"].iter().find_map(|p| word.strip_prefix(p));
                Some((Way::Together, of_letter(rest?)?))
            })
        }
        [first, last] if PLACES.contains(&first) => {
            let axis = of_letter(last).or_else(|| of_number(last));
            axis.map(|axis| (Way::Place, axis))
        }
        [first, last] if PLACES.contains(&last) => Some((Way::Place, of_letter(first)?)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(heading: &str) -> Option<[usize; 3]> {
        let separator = Separator::of(heading.as_bytes());
        let columns = names(heading.as_bytes(), separator).len();
        named_axes(heading.as_bytes(), separator, columns)
    }

    #[test]
    fn programs_call_axes_by_many_names() {
        for heading in [
            "Nx,Ny,Nz,X,Y,Z",
            "R,G,B,x_mm,y_mm,z_mm",
            "\"a\",\"b\",\"c\",\"Points:0\",\"Points:1\",\"Points:2\"",
            "\"Normals_0\",\"Normals_1\",\"Normals_2\",\"Points_0\",\"Points_1\",\"Points_2\"",
            "nx ny nz px py pz",
            "a,b,c,pos_x,pos_y,pos_z",
            "a;b;c;Point X;Point Y;Point Z",
            "a b c x_coord y_coord z_coord",
            "a,b,c,X (\u{b5}m),Y [mm],Z",
            "nx ny nz X [mm] Y [mm] Z [mm]",
            "px py pz x y z",
        ] {
            assert_eq!(found(heading), Some([3, 4, 5]), "{heading}");
        }
        assert_eq!(found("z_mm,y_mm,x_mm"), Some([2, 1, 0]));
    }

    #[test]
    fn other_names_are_none() {
        for heading in [
            "nx,ny,nz",
            "x_normal,y_normal,z_normal",
            "x,y,intensity",
            "Normals_0,Normals_1,Normals_2",
            "x,pos_y,z",
        ] {
            assert_eq!(found(heading), None, "{heading}");
        }
        let blank = Separator::Blank;
        assert_eq!(named_axes(b"x y z", blank, 6), None);
        assert_eq!(named_axes(b"z,y,x", blank, 3), Some([2, 1, 0]));
    }
}
