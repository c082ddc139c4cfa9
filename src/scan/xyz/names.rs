//! The names by which programs call the columns of x, y and z.

use super::separator::Separator;
use crate::scan::error::HeadingDoubt;
use crate::scan::text;

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

/// Units after an axis, as in `x_mm`, ...
const UNITS: [&str; 7] = ["nm", "um", "mm", "cm", "dm", "m", "inch"];

/// ... and steps of an image, which are lengths only where nothing else is told.
const STEPS: [&str; 6] = ["px", "pixel", "pixels", "vox", "voxel", "voxels"];

/// Words of columns beside x, y and z. Between blanks a line of other words is a sentence, however many it has.
const OTHERS: [&str; 47] = [
    "id",
    "index",
    "idx",
    "num",
    "number",
    "label",
    "class",
    "segment",
    "time",
    "timestamp",
    "intensity",
    "reflectance",
    "amplitude",
    "quality",
    "confidence",
    "weight",
    "scalar",
    "value",
    "gray",
    "grey",
    "red",
    "green",
    "blue",
    "alpha",
    "rgb",
    "rgba",
    "color",
    "colour",
    "curvature",
    "roughness",
    "density",
    "deviation",
    "error",
    "distance",
    "range",
    "normal",
    "radius",
    "depth",
    "temperature",
    "row",
    "col",
    "column",
    "line",
    "ring",
    "frame",
    "valid",
    "mask",
];

/// Words of columns that are angles.
const ANGLES: [&str; 7] = [
    "theta",
    "phi",
    "azimuth",
    "elevation",
    "polar",
    "angle",
    "latitude",
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

/// What a heading says of a column.
struct Name {
    words: Vec<String>,
    /// A unit or a step.
    unit: Option<String>,
}

/// The columns of x, y and z.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axes {
    pub(super) columns: [usize; 3],
    /// The unit that all three are told in.
    pub(super) unit: Option<String>,
}

impl Axes {
    /// Those of columns that nobody has named.
    pub(super) const FIRST: Self = Self {
        columns: [0, 1, 2],
        unit: None,
    };
}

/// The columns of x, y and z, where a heading has a name for every column and names these.
///
/// # Errors
/// [`HeadingDoubt`] where it cannot be told which ones are meant, or how.
pub(super) fn named_axes(
    heading: &[u8],
    separator: Separator,
    columns: usize,
) -> Result<Option<Axes>, HeadingDoubt> {
    for separator in [separator, Separator::of(heading)] {
        for line in [without_title(heading), heading] {
            let names = names(line, separator);
            if names.len() != columns || (separator == Separator::Blank && is_sentence(line)) {
                continue;
            }
            if let Some(axes) = axes(&names)? {
                return Ok(Some(axes));
            }
            if let Some(angle) = names.iter().find_map(angle) {
                return Err(HeadingDoubt::Angle(angle));
            }
        }
    }
    Ok(None)
}

/// How many columns a heading names, if it names those of x, y and z among them.
pub(super) fn named_columns(heading: &[u8]) -> Option<usize> {
    let separator = Separator::of(heading);
    let columns = names(heading, separator).len();
    let axes = named_axes(heading, separator, columns);
    axes.ok().flatten().map(|_| columns)
}

/// Whether x, y and z stand in a line that is not read for the columns of rows, and not first.
pub(super) fn are_elsewhere(line: &[u8]) -> bool {
    let is_between = |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b',' | b';');
    let words = without_title(line)
        .split(is_between)
        .filter(|word| !word.is_empty());
    let found: Vec<_> = words
        .map(|word| self::axis(&Name::of(word).words))
        .collect();
    let at = |axis| {
        found
            .iter()
            .position(|found| *found == Some((Way::Plain, axis)))
    };
    let [x, y, z] = [0, 1, 2].map(at);
    x.is_some() && y.is_some() && z.is_some() && [x, y, z] != [Some(0), Some(1), Some(2)]
}

/// A heading behind a title such as `Columns:`.
fn without_title(heading: &[u8]) -> &[u8] {
    let end = heading
        .windows(2)
        .rposition(|pair| pair[0] == b':' && pair[1].is_ascii_whitespace());
    end.map_or(heading, |end| &heading[end + 1..])
}

/// Whether words between blanks are those of a sentence.
fn is_sentence(line: &[u8]) -> bool {
    text::words(line).any(|word| {
        let name = Name::of(word);
        let is_column = |word: &String| {
            word.len() <= 2
                || OTHERS.contains(&word.as_str())
                || ANGLES.contains(&word.as_str())
                || !word.chars().all(char::is_alphabetic)
        };
        let is_unit = word.starts_with(b"(") || word.starts_with(b"[");
        let ends_a_part = word.ends_with(b":") || word.ends_with(b",") || word.ends_with(b".");
        ends_a_part || !(is_unit || axis(&name.words).is_some() || name.words.iter().any(is_column))
    })
}

/// What a heading says of every column.
fn names(heading: &[u8], separator: Separator) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    for name in separator.split(heading) {
        // Between blanks a unit in brackets stands alone.
        let is_unit = separator == Separator::Blank && matches!(name.first(), Some(b'(' | b'['));
        match names.last_mut().filter(|_| is_unit) {
            Some(last) => last.unit = in_brackets(&String::from_utf8_lossy(name)),
            None => names.push(Name::of(name)),
        }
    }
    names
}

impl Name {
    /// The words of a name, and its unit: those of `"X (mm)"` and of `x_mm` are `x` and `mm`.
    fn of(name: &[u8]) -> Self {
        let name = String::from_utf8_lossy(name).to_lowercase();
        let unit = in_brackets(&name);
        let name = name.split(['(', '[']).next().unwrap_or_default();
        let words = name.split(|letter: char| !letter.is_alphanumeric());
        let words = words.filter(|word| !word.is_empty());
        let mut words: Vec<String> = words.map(str::to_owned).collect();
        let last = match words.as_slice() {
            [_, .., last] => known_unit(last),
            _ => None,
        };
        if last.is_some() {
            words.pop();
        }
        Self {
            words,
            unit: unit.or(last),
        }
    }
}

/// The unit that stands in brackets.
fn in_brackets(name: &str) -> Option<String> {
    let (_, unit) = name.split_once(['(', '['])?;
    known_unit(unit.trim_end_matches([')', ']']).trim())
}

fn known_unit(word: &str) -> Option<String> {
    let word = word.to_lowercase().replace(['\u{b5}', '\u{3bc}'], "u");
    match word.as_str() {
        "in" => Some("inch".into()),
        known if UNITS.contains(&known) || STEPS.contains(&known) => Some(word),
        _ => None,
    }
}

/// The word for an angle in a name.
fn angle(name: &Name) -> Option<String> {
    let word = name
        .words
        .iter()
        .find(|word| ANGLES.contains(&word.as_str()));
    word.cloned()
}

/// The columns of x, y and z; of several for one axis those that have one unit for all three.
fn axes(names: &[Name]) -> Result<Option<Axes>, HeadingDoubt> {
    let found: Vec<_> = names.iter().map(|name| axis(&name.words)).collect();
    for way in [Way::Plain, Way::Place, Way::Together] {
        let of_axis = |axis| {
            let columns = found.iter().enumerate();
            let columns = columns.filter(move |(_, found)| **found == Some((way, axis)));
            columns.map(|(column, _)| column).collect::<Vec<_>>()
        };
        let all = [0, 1, 2].map(of_axis);
        if all.iter().all(|columns| !columns.is_empty()) {
            return chosen(&all, names).map(Some);
        }
    }
    Ok(None)
}

/// One column of each axis: those in one unit, in none, or in steps of an image, the first of these that there is.
fn chosen(all: &[Vec<usize>; 3], names: &[Name]) -> Result<Axes, HeadingDoubt> {
    let unit_of = |column: &usize| names[*column].unit.clone();
    let mut units: Vec<Option<String>> = all.iter().flatten().map(unit_of).collect();
    units.sort();
    units.dedup();
    let is_step = |unit: &str| STEPS.contains(&unit);
    let rank = |unit: &Option<String>| match unit.as_deref() {
        Some(unit) if !is_step(unit) => 0,
        None => 1,
        Some(_) => 2,
    };
    let in_unit = |unit: &Option<String>| {
        let one = |columns: &Vec<usize>| {
            let mut own = columns.iter().filter(|column| unit_of(column) == *unit);
            own.next().copied().filter(|_| own.next().is_none())
        };
        let [x, y, z] = [0, 1, 2].map(|axis| one(&all[axis]));
        Some((rank(unit), [x?, y?, z?], unit.clone()))
    };
    let mut complete: Vec<_> = units.iter().filter_map(in_unit).collect();
    complete.sort();
    match complete.as_slice() {
        [best] => Ok(best),
        [best, next, ..] if best.0 < next.0 => Ok(best),
        [_, _, ..] => Err(HeadingDoubt::Twice),
        [] => match all.iter().all(|columns| columns.len() == 1) {
            true => Err(HeadingDoubt::Units(
                units
                    .into_iter()
                    .map(|unit| unit.unwrap_or("none".into()))
                    .collect(),
            )),
            false => Err(HeadingDoubt::Twice),
        },
    }
    .map(|(_, columns, unit)| Axes {
        columns: *columns,
        unit: unit.clone().filter(|unit| !is_step(unit)),
    })
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
        axes_of(heading).unwrap().map(|axes| axes.columns)
    }

    fn axes_of(heading: &str) -> Result<Option<Axes>, HeadingDoubt> {
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
            "a,b,c,X (\u{b5}m),Y [um],Z_um",
            "nx ny nz X [mm] Y [mm] Z [mm]",
            "px py pz x y z",
        ] {
            assert_eq!(found(heading), Some([3, 4, 5]), "{heading}");
        }
        assert_eq!(found("z_mm,y_mm,x_mm"), Some([2, 1, 0]));
    }

    #[test]
    fn of_several_columns_of_an_axis_those_of_one_unit_count() {
        for (heading, columns, unit) in [
            (
                "x (vox),y (vox),z (vox),x (mm),y (mm),z (mm)",
                [3, 4, 5],
                Some("mm"),
            ),
            ("x_px,y_px,x_mm,y_mm,z_mm", [2, 3, 4], Some("mm")),
            ("x,y,z,x_mm,y_mm,z_mm", [3, 4, 5], Some("mm")),
            ("x_px,y_px,x,y,z", [2, 3, 4], None),
            ("x_px,y_px,z_px", [0, 1, 2], None),
            ("X [\u{b5}m] Y [um] Z [\u{3bc}m]", [0, 1, 2], Some("um")),
        ] {
            let axes = axes_of(heading).unwrap().unwrap();
            assert_eq!(
                (axes.columns, axes.unit.as_deref()),
                (columns, unit),
                "{heading}"
            );
        }
        for heading in ["x,y,z,x,y,z", "x,y,X,Y,Z", "x_mm,y_mm,z_mm,x_um,y_um,z_um"] {
            assert_eq!(axes_of(heading), Err(HeadingDoubt::Twice), "{heading}");
        }
        for heading in [
            "x [cm],y [cm],z [in]",
            "x_mm,y_mm,z_um",
            "x_px,y_px,z_mm",
            "x,y,z_mm",
        ] {
            let told = axes_of(heading);
            assert!(matches!(told, Err(HeadingDoubt::Units(_))), "{heading}");
        }
    }

    #[test]
    fn sentences_name_no_columns_and_titles_are_no_names() {
        for heading in [
            "exported grain points: x y z",
            "seed 12, coordinates x y z",
            "scan of seed x, y z",
            "points as x y z coordinates",
            "east north x y z",
        ] {
            assert_eq!(found(heading), None, "{heading}");
        }
        let titled = b"Columns: t x y z";
        let axes = named_axes(titled, Separator::Blank, 4).unwrap().unwrap();
        assert_eq!(axes.columns, [1, 2, 3]);
        assert_eq!(named_axes(titled, Separator::Blank, 5), Ok(None));
        assert!(are_elsewhere(titled) && are_elsewhere(b"seed 12, coordinates x y z"));
        assert!(!are_elsewhere(b"grain points: x y z nx") && !are_elsewhere(b"x y of it"));
    }

    #[test]
    fn angles_are_no_lengths() {
        let angle = |word: &str| Err(HeadingDoubt::Angle(word.into()));
        assert_eq!(axes_of("angle_deg,radius,height"), angle("angle"));
        assert_eq!(axes_of("theta phi r"), angle("theta"));
        assert_eq!(found("x,y,z,theta"), Some([0, 1, 2]));
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
        assert_eq!(named_axes(b"x y z", blank, 6), Ok(None));
        let reversed = named_axes(b"z,y,x", blank, 3).unwrap().unwrap();
        assert_eq!(reversed.columns, [2, 1, 0]);
    }
}
