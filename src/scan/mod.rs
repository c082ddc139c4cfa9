//! Reading scans: one reader per format into one [`Scan`]; label images are [volumes](Volume) of many.
//!
//! Any file may be hostile. No reader trusts a count before the bytes behind it were seen, none
//! panics, and each error says what was wrong, where, and what to do.

mod apart;
pub(crate) mod check;
mod close_gaps;
mod coarse;
mod drawn;
mod error;
mod format;
pub(crate) mod heap;
mod inspect;
mod junctions;
mod mend;
mod obj;
mod ply;
mod polygon;
mod repeated;
mod slits;
mod source;
mod split;
mod stl;
mod text;
mod topology;
pub(crate) mod unit_remark;
mod unseen;
mod volume;
mod weld;
mod xyz;

use std::path::Path;

use crate::mesh::Mesh;
use nalgebra::Point3;

pub(crate) use apart::apart;
pub(crate) use drawn::{by_coordinates, drawn, indices_drawn};
pub use error::{HeadingDoubt, ParseError, Place, ReadError};
use format::Format;
pub(crate) use repeated::distinct;
pub use source::{MAX_BYTES, read_bytes, read_stream};
pub use split::{Cut, Plane, Split, SplitGrain, split, split_labels, split_uncut};
pub(crate) use split::{are_two_grains, has_neck, voxels_have_neck};
pub use topology::Topology;
pub(crate) use topology::each_edge;
#[cfg(feature = "cli")]
pub(crate) use volume::Extent;
use volume::{Centres, Voxels};
pub use volume::{Volume, VolumeError, VoxelBody, VoxelLattice, parse_volume, voxel_file};

/// What is told of points in one plane.
const FLAT: &str = "All points lie in one plane: they do not enclose a body.";

/// The points of a scan, in f64, in the file's own frame and unit, and the triangles between them.
///
/// Points and triangles do not change any more, so what is known of the triangles is true of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scan {
    pub(crate) points: Vec<Point3<f64>>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) topology: Option<Topology>,
    /// The voxels that the surface lies between.
    pub(crate) voxels: Option<Voxels>,
    /// Of points that may be the centres of voxels, the mean distance from one to the next.
    pub(crate) step: Option<f64>,
    /// See [`Self::unit`].
    pub(crate) unit: Option<String>,
    pub(crate) warnings: Vec<String>,
}

impl Scan {
    /// A scan of points without triangles. They are taken as they are: what cannot be fitted is refused there.
    pub fn from_points(points: Vec<Point3<f64>>) -> Self {
        Self {
            points,
            ..Self::default()
        }
    }

    /// A scan of the vertices and triangles of a mesh, looked over as those of a file are: see [`parse_scan`].
    ///
    /// ```
    /// use grainform::nalgebra::point;
    /// use grainform::{Mesh, Scan};
    ///
    /// let tetrahedron = Mesh {
    ///     vertices: vec![
    ///         point![0.0, 0.0, 0.0],
    ///         point![1.0, 0.0, 0.0],
    ///         point![0.0, 1.0, 0.0],
    ///         point![0.0, 0.0, 1.0],
    ///     ],
    ///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    /// };
    /// let scan = Scan::from_mesh(tetrahedron)?;
    /// assert!(scan.topology().is_some_and(|topology| topology.closed));
    /// # Ok::<(), grainform::scan::ParseError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`ParseError`] where a triangle names a vertex that does not exist, or the vertices are none, not finite, all
    /// the same or all on one line.
    pub fn from_mesh(mesh: Mesh) -> Result<Self, ParseError> {
        let points = mesh.vertices.len();
        if u32::try_from(points).is_err() {
            return Err(ParseError::TooManyPoints { points });
        }
        let last = |corners: &[u32; 3]| corners.iter().fold(0, |last, &corner| last.max(corner));
        let named = mesh.triangles.iter().map(last).enumerate();
        if let Some((triangle, index)) = named.max_by_key(|&(_, index)| index)
            && index as usize >= points
        {
            return Err(ParseError::IndexOutOfRange {
                place: Place::Triangle(triangle),
                index: index.into(),
                points,
                first: 0,
            });
        }
        let mut scan = Self::of_mesh(mesh);
        scan.look_over()?;
        Ok(scan)
    }

    fn of_mesh(mesh: Mesh) -> Self {
        Self {
            points: mesh.vertices,
            triangles: mesh.triangles,
            ..Self::default()
        }
    }

    /// All points in file order, duplicates included, except where corners along open rims were made one.
    pub fn points(&self) -> &[Point3<f64>] {
        &self.points
    }

    /// Three indices into [`Self::points`] per triangle; empty when there are points only.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// How the triangles hang together; none when there are no triangles.
    pub fn topology(&self) -> Option<&Topology> {
        self.topology.as_ref()
    }

    /// Standard deviation of the points from the surface, along its normals, that is known before any fit: of voxels
    /// that by which they are coarse; `None` where nothing is known.
    pub fn scatter(&self) -> Option<f64> {
        self.voxels.as_ref().map(|voxels| voxels.scatter)
    }

    /// Whether the faces lie between voxels.
    pub(crate) fn is_of_voxels(&self) -> bool {
        self.voxels.is_some()
    }

    /// The unit of lengths that the header of an image or the heading of a table tells, such as `mm`; `None` where it tells none, as
    /// other files do.
    pub fn unit(&self) -> Option<&str> {
        self.unit.as_deref()
    }

    /// What was odd, but did not stop the reader: whole sentences.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Why something failed with this scan, and what was odd about it, which may explain that.
    /// What encloses nothing is refused as flat: that is not told twice.
    #[cfg(feature = "cli")]
    pub(crate) fn explained(&self, reason: String) -> String {
        let odd = self.warnings.iter().filter(|odd| *odd != FLAT);
        match odd.cloned().collect::<Vec<_>>().as_slice() {
            [] => reason,
            odd => format!("{reason}. {}", odd.join(" ")),
        }
    }

    /// Checks the points, and inspects the triangles.
    fn look_over(&mut self) -> Result<(), ParseError> {
        if check::check(&self.points)? == check::Span::Plane {
            self.warnings.push(FLAT.into());
        }
        inspect::inspect(self);
        self.look_for_voxels();
        Ok(())
    }

    /// Takes faces between voxels for those of a segmented volume.
    fn look_for_voxels(&mut self) {
        let Some(voxels) = volume::between_voxels(self) else {
            return;
        };
        self.warnings.push(format!(
            "The vertices lie half-way between voxels of {}, as marching cubes without grey values put them: the faces are \
             taken as those of a segmented volume.",
            voxels.lattice.sides()
        ));
        self.voxels = Some(voxels);
    }

    /// Takes points that are the centres of voxels for the boundary of these.
    fn on_lattice(mut self) -> Self {
        match volume::centres(&self.points) {
            Some(Centres::Of(grain)) => return *grain,
            Some(Centres::Open(lattice)) => {
                self.warnings.push(format!(
                    "All points lie on a lattice with steps of {}, and do not close round a grain. If they are the centres of voxels, \
                     its surface lies half a step outside of them; errors allow for that. Read the image itself, or all of its \
                     outermost voxels.",
                    lattice.sides()
                ));
                let steps = lattice.steps.column_iter().map(|step| step.norm());
                self.step = Some(steps.sum::<f64>() / 3.0);
            }
            None => {}
        }
        self
    }

    /// The scan that a part of its faces is: what is known of all points is true of the part's too. Bodies of voxels each may have
    /// their own.
    pub(crate) fn part(&self, mesh: Mesh) -> Self {
        let mut part = Self {
            voxels: self.voxels,
            step: self.step,
            unit: self.unit.clone(),
            ..Self::of_mesh(mesh)
        };
        inspect::inspect(&mut part);
        if part.voxels.is_none() {
            part.look_for_voxels();
        }
        part
    }

    /// Of a segmented volume, where its voxels lie: the points are half-way between two of them. `None` of other scans.
    pub fn voxel_lattice(&self) -> Option<&VoxelLattice> {
        self.voxels.as_ref().map(|voxels| &voxels.lattice)
    }

    /// Of a segmented volume, what the voxels of the grain take up: their number times the volume of one. `None` of other
    /// scans.
    pub fn voxel_volume(&self) -> Option<f64> {
        let volume = |lattice: &VoxelLattice| lattice.volume(&self.points);
        self.voxel_lattice().map(volume)
    }

    /// Whether all points lie in one plane, or do not span one: they enclose nothing.
    pub fn is_flat(&self) -> bool {
        check::check(&self.points).map_or(true, |span| span == check::Span::Plane)
    }
}

/// Reads a scan from a PLY, STL, OBJ or XYZ file of at most [`MAX_BYTES`], packed with gzip or not, or the only label
/// of an image that [`parse_volume`] reads.
///
/// # Errors
///
/// Those of [`read_bytes`] where the file cannot be read, and of [`parse_file`] where its content is no usable scan.
pub fn read_scan(path: &Path) -> Result<Scan, ReadError> {
    let bytes = read_bytes(path, MAX_BYTES)?;
    parse_file(path, &bytes, None)
}

/// Reads a scan from the bytes of a file: [`parse_scan`], or the only label of an image ([`parse_volume`]), with the
/// file's name in its errors. Where the content
/// leaves the format open, `format` decides, such as `stl`, or else the extension, that before `.gz`.
///
/// # Errors
///
/// [`ReadError::Parse`], [`ReadError::Volume`] and [`ReadError::Model`].
pub fn parse_file(path: &Path, bytes: &[u8], format: Option<&str>) -> Result<Scan, ReadError> {
    if let Some(volume) = parse_volume(path, bytes, MAX_BYTES)? {
        return volume.scan(None).map_err(|source| ReadError::Volume {
            path: path.into(),
            source,
        });
    }
    if starts_as_model(bytes) {
        return Err(ReadError::Model { path: path.into() });
    }
    let format = format.or_else(|| source::extension(path));
    parse_scan(bytes, format).map_err(|source| ReadError::Parse {
        path: path.into(),
        source,
    })
}

/// Whether bytes are those of a model, and of no scan.
pub(crate) fn starts_as_model(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().starts_with(b"{")
}

/// Reads a scan from the bytes of a file.
///
/// The content decides the format: PLY (text, or binary of either byte order), STL (text or
/// binary), OBJ, or a table of numbers with x, y and z in its first columns or in those so named.
/// The `extension` only breaks ties. Coordinates keep all digits of the file, polygons become
/// fans of triangles, and the repeated corners of STL become shared points.
///
/// Points on a lattice that are the centres of the voxels of a grain, all or the outermost, become the boundary of these voxels, with a
/// warning.
/// Corners along open rims that nearly coincide are made one, triangles with coinciding corners or that repeat others are dropped,
/// those along whose sides others have corners are parted there, and a mesh wound inwards is turned outwards; these and whatever else is odd, such as holes or several bodies, leave a warning.
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
    scan.warnings.extend(coarse::coarse(&scan.points));
    let odd = scan.warnings.clone();
    scan.look_over().map_err(|error| error.beside(&odd))?;
    if scan.triangles.is_empty() {
        scan = scan.on_lattice();
    }
    Ok(scan)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::point;

    fn tetrahedron() -> Mesh {
        Mesh {
            vertices: vec![
                point![0.0, 0.0, 0.0],
                point![1.0, 0.0, 0.0],
                point![0.0, 1.0, 0.0],
                point![0.0, 0.0, 1.0],
            ],
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        }
    }

    #[test]
    fn a_scan_of_a_mesh_keeps_its_faces_and_knows_what_they_enclose() {
        let scan = Scan::from_mesh(tetrahedron()).unwrap();
        assert_eq!(scan.triangles(), tetrahedron().triangles);
        let topology = scan.topology().unwrap();
        assert!(topology.closed && (topology.volume - 1.0 / 6.0).abs() < 1e-15);
        let scan = Scan::from_points(tetrahedron().vertices);
        assert!(scan.triangles().is_empty() && scan.topology().is_none());
    }

    #[test]
    fn a_mesh_that_names_a_vertex_it_has_not_is_refused_with_the_triangle() {
        let mut mesh = tetrahedron();
        mesh.triangles[2][1] = 4;
        let error = Scan::from_mesh(mesh).unwrap_err().to_string();
        let start =
            "triangle 2 (counted from 0): the face names point 4, but the scan has 4 points";
        assert!(error.starts_with(start), "{error}");
        let mut mesh = tetrahedron();
        mesh.vertices[0].x = f64::NAN;
        let place = Place::Point(0);
        assert_eq!(Scan::from_mesh(mesh), Err(ParseError::NotFinite { place }));
    }
}
