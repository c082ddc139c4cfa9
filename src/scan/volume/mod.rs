//! Segmented volumes: images of labels, a grain for each label, as computed tomography gives them.
//!
//! NRRD, MetaImage, NIfTI, TIFF stacks and `.npy` are read, with their spacing, origin and directions. The headers are
//! a few lines each and are read here, for the crates that know them bring whole array libraries along; TIFF has a
//! crate of its own.

mod bodies;
mod border;
mod error;
mod extent;
mod frames;
mod half_way;
mod lattice;
mod metaimage;
mod nifti;
mod npy;
mod nrrd;
mod recurring;
mod samples;
mod scatter;
mod steps;
mod tiff;
mod unit;
mod voxel_lattice;

pub use bodies::VoxelBody;
pub use error::VolumeError;
pub(crate) use extent::Extent;
pub(super) use lattice::{Centres, centres};
pub use voxel_lattice::VoxelLattice;
pub(super) use voxel_lattice::Voxels;

use super::check::check;
use super::{ReadError, Scan, inspect, source};
use crate::mesh::{Grid, Mesh, contour};
use extent::{Run, touches};
use half_way::half_way;
use nalgebra::{Matrix3, Point3, Vector3};
use samples::Samples;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// More labels than any scan has grains: it is an image of grey values.
const MOST_LABELS: usize = 100_000;

/// Volume of the boxes round all labels, over that of the image, at most: grains that are packed overlap a few times.
const MOST_BOXES: f64 = 100.0;

/// Fewest voxels that have a shape: those of a ball of radius 2.
pub(super) const LEAST_VOXELS: usize = 30;

/// An image of labels; zero is what is around the grains.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// Numbers of voxels along the axes of the image, that which runs fastest first.
    size: [usize; 3],
    samples: Samples,
    /// The middle of the first voxel.
    origin: Point3<f64>,
    /// From one voxel to the next along each axis of the image, in columns.
    steps: Matrix3<f64>,
    /// The unit of lengths that the header tells.
    unit: Option<String>,
    /// What the file does not tell.
    warnings: Vec<String>,
}

/// Reads a label image from the bytes of a file; `None` where they are no image. At most `limit` bytes are unpacked.
/// Headers that name a file for the voxels are followed to one beside them.
///
/// # Errors
/// [`ReadError::Volume`] with what is wrong.
pub fn parse_volume(path: &Path, bytes: &[u8], limit: u64) -> Result<Option<Volume>, ReadError> {
    let beside = Beside {
        header: path,
        limit,
    };
    let found = if nrrd::is_it(bytes) {
        nrrd::parse(bytes, &beside)
    } else if bytes.starts_with(b"\x93NUMPY") {
        npy::parse(bytes)
    } else if tiff::is_it(bytes) {
        tiff::parse(bytes, limit)
    } else if nifti::is_it(bytes) {
        nifti::parse(bytes)
    } else if metaimage::is_it(path, bytes) {
        metaimage::parse(bytes, &beside)
    } else {
        return Ok(None);
    };
    found.map(Some).map_err(|source| ReadError::Volume {
        path: path.into(),
        source,
    })
}

/// The file beside an image's own that has its voxels, where the image, of these bytes, is a header that names one
/// (`.nhdr`, `.mhd`). `None` too where the name leads to another folder.
pub fn voxel_file(path: &Path, bytes: &[u8]) -> Option<PathBuf> {
    let name = if nrrd::is_it(bytes) {
        nrrd::voxel_file(bytes)
    } else if metaimage::is_it(path, bytes) {
        metaimage::voxel_file(bytes)
    } else {
        None
    };
    beside(path, &name?)
}

/// A file in the same folder; `None` where the name leads elsewhere.
fn beside(path: &Path, name: &str) -> Option<PathBuf> {
    let is_plain = Path::new(name).file_name().is_some_and(|own| own == name);
    is_plain.then(|| path.with_file_name(name))
}

/// Where a header finds the voxels that it names, and how much may be read of them.
struct Beside<'a> {
    header: &'a Path,
    limit: u64,
}

impl Beside<'_> {
    /// The bytes of a file in the same folder, unpacked.
    fn read(&self, name: &str) -> Result<Vec<u8>, VolumeError> {
        let path = beside(self.header, name);
        let path = path.ok_or_else(|| VolumeError::Elsewhere { name: name.into() })?;
        source::read_bytes(&path, self.limit).map_err(|error| told(name, &error))
    }

    /// What is packed with gzip within a file.
    fn unpack(&self, packed: &[u8]) -> Result<Vec<u8>, VolumeError> {
        source::read_stream(packed, Path::new("its voxels"), self.limit)
            .map_err(|error| told("it", &error))
    }
}

/// Why the voxels of a file cannot be read.
fn told(name: &str, error: &ReadError) -> VolumeError {
    match *error {
        ReadError::TooLarge { limit, .. } => VolumeError::TooLarge { limit },
        _ => VolumeError::Voxels {
            name: name.into(),
            reason: error.to_string(),
        },
    }
}

impl Volume {
    /// An image with axes along x, y and z.
    ///
    /// # Errors
    /// [`VolumeError`] if there are too few samples, or the steps are not those of a lattice.
    fn new(
        size: [usize; 3],
        samples: Samples,
        origin: Point3<f64>,
        steps: Matrix3<f64>,
    ) -> Result<Self, VolumeError> {
        let voxels = size
            .iter()
            .try_fold(1_usize, |all, side| all.checked_mul(*side));
        let voxels = voxels
            .filter(|voxels| *voxels > 0)
            .ok_or(VolumeError::Size { size })?;
        if samples.count() < voxels {
            let found = samples.count();
            return Err(VolumeError::CutShort { voxels, found });
        }
        let surplus = samples.surplus(voxels);
        let lengths: f64 = steps.column_iter().map(|step| step.norm()).product();
        let is_lattice = steps.determinant().abs() > 1e-6 * lengths;
        if !is_lattice || !steps.iter().chain(origin.iter()).all(|x| x.is_finite()) {
            return Err(VolumeError::NoLattice);
        }
        Ok(Self {
            size,
            samples,
            origin,
            steps,
            unit: None,
            warnings: surplus.into_iter().collect(),
        })
    }

    fn with_warning(mut self, warning: &str) -> Self {
        self.warnings.push(warning.into());
        self
    }

    /// Keeps the unit that the header tells, see [`unit::common`], and warns where it is not millimetres, which most are
    /// in: none is converted.
    fn in_unit(mut self, unit: Option<String>) -> Self {
        if let Some(unit) = unit.as_deref().filter(|unit| *unit != "mm") {
            let unit = unit.escape_debug();
            let warning = format!("The image's lengths are in {unit}, as its header says.");
            self.warnings.push(warning);
        }
        self.unit = unit;
        self
    }

    /// The unit of lengths that the header tells, such as `mm`; `None` where it tells none.
    pub fn unit(&self) -> Option<&str> {
        self.unit.as_deref()
    }

    /// The labels but zero, and their numbers of voxels.
    ///
    /// # Errors
    /// [`VolumeError::GreyValues`] if the image is none of labels.
    pub fn labels(&self) -> Result<BTreeMap<i64, usize>, VolumeError> {
        let extents = self.extents()?.into_iter();
        Ok(extents
            .map(|(label, extent)| (label, extent.voxels))
            .collect())
    }

    /// The labels but zero, and where they are.
    fn extents(&self) -> Result<BTreeMap<i64, Extent>, VolumeError> {
        let mut found: BTreeMap<i64, Extent> = BTreeMap::new();
        let [_, height, depth] = self.size;
        let mut below: Vec<Vec<Run>> = vec![Vec::new(); height];
        for z in 0..depth {
            for y in 0..height {
                let runs = self.row(y, z)?;
                for run in &runs {
                    let [from, to] = run.1;
                    let extent = found.entry(run.0).or_default();
                    extent.add([from, y, z], [to - 1, y, z]);
                    // Row after row those of the slice take the places of those of the slice below.
                    let mut beside = [y.checked_sub(1), Some(y)].into_iter().flatten();
                    let is_alone = !beside.any(|y| touches(&below[y], run));
                    extent.alone += usize::from(is_alone);
                    if found.len() > MOST_LABELS {
                        return Err(VolumeError::TooManyLabels { most: MOST_LABELS });
                    }
                }
                below[y] = runs;
            }
        }
        let with_shape = || found.values().filter(|own| own.voxels >= LEAST_VOXELS);
        let scattered = with_shape().filter(|own| own.is_scattered()).count();
        match scattered > 1 && 2 * scattered > with_shape().count() {
            true => Err(VolumeError::Scattered { labels: scattered }),
            false => Ok(found),
        }
    }

    /// The labels but zero in a row along the first axis, each from where to where.
    fn row(&self, y: usize, z: usize) -> Result<Vec<Run>, VolumeError> {
        let [width, height, _] = self.size;
        let row = width * (y + height * z);
        let (mut runs, mut x) = (Vec::new(), 0);
        while x < width {
            let (from, label) = (x, self.samples.label(row + x)?);
            while x < width && self.samples.label(row + x)? == label {
                x += 1;
            }
            if label != 0 {
                runs.push((label, [from, x]));
            }
        }
        Ok(runs)
    }

    /// What the file does not tell: whole sentences.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The boundary of what has a label; where none is given, of the only one.
    ///
    /// Its points are the middles between the centres of voxels inside and outside. On the whole these are off the true
    /// surface neither inwards nor outwards, and so no volume is lost; each may be half a voxel off, which the scan
    /// knows ([`Scan::scatter`]).
    ///
    /// # Errors
    /// [`VolumeError`] if there is no such label, or several and none was asked for.
    pub fn scan(&self, label: Option<i64>) -> Result<Scan, VolumeError> {
        let extents = self.extents()?;
        let labels = || -> BTreeMap<i64, usize> {
            let labels = extents.iter();
            labels
                .map(|(label, extent)| (*label, extent.voxels))
                .collect()
        };
        let mut only = extents.iter().next().filter(|_| extents.len() == 1);
        if let Some(label) = label {
            let missing = || VolumeError::NoSuchLabel {
                label,
                labels: labels(),
            };
            only = Some(extents.get_key_value(&label).ok_or_else(missing)?);
        }
        match only {
            Some((label, extent)) => self.grain(*label, extent),
            None if extents.is_empty() => Err(VolumeError::NoLabels),
            None => Err(VolumeError::SeveralLabels { labels: labels() }),
        }
    }

    /// Where all labels are.
    ///
    /// # Errors
    /// [`VolumeError`] if there is no label, or if these are none.
    pub(crate) fn grains(&self) -> Result<BTreeMap<i64, Extent>, VolumeError> {
        let extents = self.extents()?;
        if extents.is_empty() {
            return Err(VolumeError::NoLabels);
        }
        let boxes: f64 = extents.values().map(Extent::volume).sum();
        let image: f64 = self.size.iter().map(|side| *side as f64).product();
        if boxes > MOST_BOXES * image {
            let times = boxes / image;
            return Err(VolumeError::Interleaved { times });
        }
        Ok(extents)
    }

    /// The boundary of a label within its extent.
    pub(crate) fn grain(&self, label: i64, extent: &Extent) -> Result<Scan, VolumeError> {
        let Extent {
            voxels, low, high, ..
        } = extent;
        if *voxels < LEAST_VOXELS {
            let voxels = *voxels;
            return Err(VolumeError::TooFew { label, voxels });
        }
        let mut grid = Grid::new(std::array::from_fn(|axis| high[axis] - low[axis] + 1));
        let [width, height, _] = self.size;
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    if self.samples.label(x + width * (y + height * z))? == label {
                        grid.fill([x - low[0], y - low[1], z - low[2]]);
                    }
                }
            }
        }
        let touching = border::look(label, &grid, extent, self.size, &self.steps)?;
        let first = self.origin + self.steps * Vector3::from(low.map(|i| i as f64));
        let mut scan = voxel_scan(&grid, first, &self.steps)?;
        let warnings = self.warnings.iter().cloned().chain(touching);
        scan.warnings.splice(0..0, warnings);
        scan.unit.clone_from(&self.unit);
        Ok(scan)
    }
}

/// The voxels between which closed faces lie, if their vertices are half-way between two.
pub(super) fn between_voxels(scan: &Scan) -> Option<Voxels> {
    scan.topology.as_ref().filter(|topology| topology.closed)?;
    let lattice = half_way(&scan.points, &scan.triangles)?;
    let to_steps = lattice.steps.try_inverse()?;
    let mut mesh = scan.welded();
    for vertex in &mut mesh.vertices {
        *vertex = (to_steps * (*vertex - lattice.first)).into();
    }
    let scatter = scatter::scatter(&mesh, &lattice.steps);
    Some(Voxels { lattice, scatter })
}

/// The boundary of the voxels of a grid as a scan.
fn voxel_scan(grid: &Grid, first: Point3<f64>, steps: &Matrix3<f64>) -> Result<Scan, VolumeError> {
    let mut mesh: Mesh = contour(grid, |_, _| 0.5);
    let scatter = scatter::scatter(&mesh, steps);
    for vertex in &mut mesh.vertices {
        *vertex = first + steps * vertex.coords;
    }
    if steps.determinant() < 0.0 {
        for [_, b, c] in &mut mesh.triangles {
            std::mem::swap(b, c);
        }
    }
    check(&mesh.vertices).map_err(|_| VolumeError::NoBody)?;
    let mut scan = Scan::of_mesh(mesh);
    inspect::inspect(&mut scan);
    let steps = *steps;
    let lattice = VoxelLattice { first, steps };
    scan.voxels = Some(Voxels { lattice, scatter });
    Ok(scan)
}

#[cfg(test)]
mod tests;
