//! Why a scan could not be read: what was wrong, where, what was expected and what to do.

use std::fmt;
use std::io;
use std::path::PathBuf;

use super::VolumeError;
use crate::digits::plural;

/// Why [`read_scan`](super::read_scan) failed; names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file could not be opened or read: check the path and its permissions.
    #[error("cannot read the file {}", path.display())]
    Io {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file goes on beyond the limit: a device, an archive made to do harm, or a scan to be thinned.
    #[error("{} has more than the {limit} bytes that may be read", path.display())]
    TooLarge {
        /// The file asked for.
        path: PathBuf,
        /// The most bytes that may be read.
        limit: u64,
    },
    /// The file is packed with gzip, but cannot be unpacked: copy it again.
    #[error("cannot unpack {}: it is cut short or damaged, copy it again", path.display())]
    Packed {
        /// The file asked for.
        path: PathBuf,
        /// What is wrong with it.
        source: io::Error,
    },
    /// What is packed with gzip is packed so itself: unpack the file once.
    #[error("{} is packed with gzip twice: unpack it once, for what is packed once is read", path.display())]
    PackedTwice {
        /// The file asked for.
        path: PathBuf,
    },
    /// The file is an image, but no grain can be read from it.
    #[error("cannot read a grain from {}", path.display())]
    Volume {
        /// The file asked for.
        path: PathBuf,
        /// What is wrong with the image.
        source: VolumeError,
    },
    /// The file is a fitted model.
    #[error(
        "{} is no scan: it is JSON, as models are, which measure, mesh, report, contact, clump, export-dem and bed read; a scene of \
         glTF is to be converted to PLY",
        path.display()
    )]
    Model {
        /// The file asked for.
        path: PathBuf,
    },
    /// The file was read, but its bytes are not a usable scan.
    #[error("cannot read a scan from {}", path.display())]
    Parse {
        /// The file asked for.
        path: PathBuf,
        /// What is wrong with its content.
        source: ParseError,
    },
}

/// A place in a scan file, for messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A line of text, counted from one.
    Line(usize),
    /// A byte, counted from zero.
    Byte(usize),
    /// A point, counted from zero.
    Point(usize),
    /// A triangle, counted from zero.
    Triangle(usize),
    /// A record of binary data.
    Record {
        /// What the record is: `vertex`, `face`, `strips`, `facet` or `row`.
        what: &'static str,
        /// Its number, counted from zero as indices in the file are.
        number: usize,
        /// Where it starts, in bytes from the beginning of the file.
        byte: usize,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Point(point) => write!(f, "point {point} (counted from 0)"),
            Self::Triangle(triangle) => write!(f, "triangle {triangle} (counted from 0)"),
            Self::Record { what, number, byte } => {
                write!(f, "{what} {number} (counted from 0, at byte {byte})")
            }
        }
    }
}

/// Why [`parse_scan`](super::parse_scan) refused the bytes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseError {
    /// There are no bytes: the copy or export failed.
    #[error("the file is empty; expected a scan in PLY, STL, OBJ or XYZ format")]
    Empty,
    /// A known kind of file that is not a scan: convert or unpack it.
    #[error("the file starts like {what}, which is not read here; {advice}")]
    Foreign {
        /// What the file is.
        what: &'static str,
        /// How to get a scan out of it.
        advice: &'static str,
    },
    /// The bytes are neither a known format nor text.
    #[error(
        "byte {byte} is neither text nor part of a known format; \
         expected a scan in PLY, STL, OBJ or XYZ format"
    )]
    Unknown {
        /// The first byte that no text holds.
        byte: usize,
    },
    /// Something else stands where the format wants a given thing.
    #[error("{place}: expected {expected}, found {found}; correct it or export the scan again")]
    Unexpected {
        /// Where.
        place: Place,
        /// What the format wants there.
        expected: &'static str,
        /// What stands there, quoted and shortened.
        found: String,
    },
    /// The text ends too early: copy or export the file again.
    #[error(
        "{place}: the file ends where {expected} should follow; it is cut short, copy or export \
         it again"
    )]
    CutShort {
        /// The last place that was read.
        place: Place,
        /// What should have followed.
        expected: &'static str,
    },
    /// The text has fewer rows than the header counts: copy or export the file again.
    #[error(
        "line {line}: the file ends after {found} of {rows} rows of the element {element}; it is \
         cut short, copy or export it again"
    )]
    TooFewRows {
        /// The last line of the file.
        line: usize,
        /// The element whose rows are missing.
        element: String,
        /// How many rows the header counts.
        rows: usize,
        /// How many rows there are.
        found: usize,
    },
    /// The header counts more rows than the file has bytes for: copy or export it again.
    #[error(
        "byte {byte}: the header promises {} of at least {}, but the file has only {} left; it is cut \
         short or its count is wrong, export it again",
        plural(*rows, &format!("{element} row")),
        plural(*row_bytes, "byte"),
        plural(*left, "byte")
    )]
    CountTooLarge {
        /// Where the rows start.
        byte: usize,
        /// The element whose rows they are.
        element: String,
        /// How many rows the header promises.
        rows: usize,
        /// The least number of bytes that one row takes.
        row_bytes: usize,
        /// Bytes from `byte` to the end of the file.
        left: usize,
    },
    /// A coordinate is NaN or infinite: remove the point or export the scan again.
    #[error("{place}: a coordinate is not a finite number; remove the point or export again")]
    NotFinite {
        /// Where.
        place: Place,
    },
    /// A fourth coordinate is not 1: readers of OBJ disagree on what it does.
    #[error(
        "{place}: the fourth number of `v` is {weight}: a weight, by which x, y and z were to be divided, or something \
         measured, such as an intensity, which would leave them as they are; write the points with three numbers"
    )]
    Weight {
        /// The line.
        place: Place,
        /// The number.
        weight: f64,
    },
    /// A face names a point that does not exist.
    #[error(
        "{place}: the face names point {index}, but the scan has {}, numbered from \
         {first}; export the scan again", plural(*points, "point")
    )]
    IndexOutOfRange {
        /// Where.
        place: Place,
        /// The index as the file gives it.
        index: i64,
        /// How many points there are.
        points: usize,
        /// The number of the first point in this format.
        first: u8,
    },
    /// The PLY header lacks a coordinate, or declares it as a list.
    #[error(
        "the header has no number property `{axis}` in an element `vertex`; expected x, y and z, \
         rename the coordinates or export the scan again"
    )]
    NoCoordinate {
        /// The first coordinate that is missing.
        axis: &'static str,
    },
    /// More points than a triangle's 32-bit indices can name: thin the scan.
    #[error("{points} points are more than a mesh can number (4294967295); thin the scan")]
    TooManyPoints {
        /// How many points there are.
        points: usize,
    },
    /// The file is valid but holds no points.
    #[error("the file has no points; expected a scan, check the export")]
    NoPoints,
    /// The STL file is valid but holds no facets.
    #[error("the file has no facets; expected a scan, check the export")]
    NoFacets,
    /// A coordinate whose square would overflow: change the unit.
    #[error("point {point}: coordinate {value:e} is beyond 1e100; scale the scan to a usual unit")]
    TooFar {
        /// The point, counted from zero.
        point: usize,
        /// The coordinate.
        value: f64,
    },
    /// All points but a few are one place beside the distances of these.
    #[error(
        "point {point}{} is {distance:e} away from all others, which are one place beside that; take such rows out, as what a scanner \
         writes for no data", among(*.count)
    )]
    FarAway {
        /// The first such point, counted from zero.
        point: usize,
        /// How many there are.
        count: usize,
        /// Its distance, in the scan's unit.
        distance: f64,
    },
    /// What a heading says of the columns of x, y and z cannot be followed.
    #[error("{place}: the heading {heading} {doubt}")]
    Heading {
        /// Where it is.
        place: Place,
        /// Its start, in quotes.
        heading: String,
        /// Why not.
        doubt: HeadingDoubt,
    },
    /// All points coincide, or are so near that squares underflow.
    #[error(
        "all points ({points}) lie at one place; expected the surface of a body, check the unit and the export"
    )]
    NoExtent {
        /// How many points there are.
        points: usize,
    },
    /// All points lie on one straight line.
    #[error("all points ({points}) lie on one line; expected the surface of a body")]
    Collinear {
        /// How many points there are.
        points: usize,
    },
    /// An error that something odd, which was found before, may explain.
    #[error("{error}. {}", warnings.join(" "))]
    Beside {
        /// What stopped the reader.
        error: Box<ParseError>,
        /// What was odd before: whole sentences.
        warnings: Vec<String>,
    },
}

impl ParseError {
    /// The same, with what was odd before.
    pub(super) fn beside(self, warnings: &[String]) -> Self {
        match warnings {
            [] => self,
            warnings => Self::Beside {
                error: Box::new(self),
                warnings: warnings.to_vec(),
            },
        }
    }
}

/// Why the heading of a table does not tell x, y and z.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HeadingDoubt {
    /// An axis has several columns, of which none belongs with those of the others.
    #[error("names x, y or z more than once: name each once, or leave the other columns out")]
    Twice,
    /// The axes are told in several units.
    #[error("tells x, y and z in several units ({}): write all in one", .0.join(", "))]
    Units(
        /// The units, `none` where an axis has none.
        Vec<String>,
    ),
    /// A column is an angle.
    #[error("names an angle ({0}): convert the columns to x, y and z, and name these")]
    Angle(
        /// Its name.
        String,
    ),
}

/// What follows the first of several points.
fn among(count: usize) -> String {
    match count {
        1 => String::new(),
        count => format!(", one of {count} such,"),
    }
}
