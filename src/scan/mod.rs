//! Reading scans: one reader per format into one [`Scan`].
//!
//! Any file may be hostile. No reader trusts a count before the bytes behind it were seen, none
//! panics, and each error says what was wrong, where, and what to do.

pub(crate) mod check;
mod error;
mod format;
mod inspect;
mod obj;
mod ply;
mod polygon;
mod source;
mod stl;
mod text;
mod topology;
mod weld;
mod xyz;

use std::path::Path;

use crate::mesh::Mesh;
use nalgebra::Point3;

pub use error::{ParseError, Place, ReadError};
use format::Format;
pub use source::{MAX_BYTES, read_bytes, read_stream};
pub use topology::Topology;
pub(crate) use topology::each_edge;
pub(crate) use weld::first_at_same_place;

/// The points of a scan, in f64, in the file's own frame and unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scan {
    /// All points in file order, duplicates included.
    pub points: Vec<Point3<f64>>,
    /// Three indices into `points` per triangle; empty when the file holds points only.
    pub triangles: Vec<[u32; 3]>,
    /// How the triangles hang together; none when there are no triangles.
    pub topology: Option<Topology>,
    /// What was odd in the file, but did not stop the reader: whole sentences.
    pub warnings: Vec<String>,
}

impl Scan {
    /// The scan that a mesh is.
    pub(crate) fn from_mesh(mesh: Mesh) -> Self {
        let mut scan = Self {
            points: mesh.vertices,
            triangles: mesh.triangles,
            ..Self::default()
        };
        inspect::inspect(&mut scan);
        scan
    }

    /// Whether all points lie in one plane, or do not span one: they enclose nothing.
    pub fn is_flat(&self) -> bool {
        check::check(&self.points).map_or(true, |span| span.flat)
    }
}

/// Reads a scan from a PLY, STL, OBJ or XYZ file of at most [`MAX_BYTES`], packed with gzip or not.
///
/// # Errors
///
/// Those of [`read_bytes`] where the file cannot be read, [`ReadError::Parse`] where its content is no
/// usable scan; see [`parse_scan`].
pub fn read_scan(path: &Path) -> Result<Scan, ReadError> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    parse_file(path, &bytes, None)
}

/// Reads a scan from the bytes of a file: [`parse_scan`] with the file's name in its errors. Where the content
/// leaves the format open, `format` decides, such as `stl`, or else the extension, that before `.gz`.
///
/// # Errors
///
/// [`ReadError::Parse`].
pub fn parse_file(path: &Path, bytes: &[u8], format: Option<&str>) -> Result<Scan, ReadError> {
    let format = format.or_else(|| source::extension(path));
    parse_scan(bytes, format).map_err(|source| ReadError::Parse {
        path: path.into(),
        source,
    })
}

/// Reads a scan from the bytes of a file.
///
/// The content decides the format: PLY (text, or binary of either byte order), STL (text or
/// binary), OBJ, or a table of numbers with x, y and z in its first columns or in those so named.
/// The `extension` only breaks ties. Coordinates keep all digits of the file, polygons become
/// fans of triangles, and the repeated corners of STL become shared points.
///
/// Triangles with coinciding corners are dropped and a mesh wound inwards is turned outwards;
/// these and whatever else is odd, such as holes or several bodies, leave a warning.
///
/// # Errors
///
/// See [`ParseError`]: content that is not one of the formats, or is cut short, or whose points
/// are none, not finite, all the same or all on one line.
pub fn parse_scan(bytes: &[u8], extension: Option<&str>) -> Result<Scan, ParseError> {
    const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let format = format::detect(bytes, extension)?;
    let mut scan = match format {
        Format::Ply => ply::parse(bytes)?,
        Format::Stl => stl::parse(bytes)?,
        Format::Obj => obj::parse(bytes)?,
        Format::Xyz => xyz::parse(bytes)?,
    };
    if format == Format::Stl && scan.triangles.is_empty() {
        return Err(ParseError::NoFacets);
    }
    let span = check::check(&scan.points)?;
    if span.flat {
        let warning = "All points lie in one plane: they do not enclose a body.";
        scan.warnings.push(warning.into());
    }
    if format == Format::Stl {
        weld::close_gaps(&mut scan, span.extent);
    }
    inspect::inspect(&mut scan);
    Ok(scan)
}

/// `1 row`, `2 rows`.
pub(crate) fn plural(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}
