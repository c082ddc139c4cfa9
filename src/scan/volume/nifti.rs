//! NIfTI-1 in one file: 348 bytes of header, and the voxels.

use super::samples::{Kind, Order, Samples};
use super::{Volume, VolumeError, unit};
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};

/// Bytes of the header.
const HEADER: usize = 348;

pub(super) fn is_it(bytes: &[u8]) -> bool {
    bytes
        .get(344..HEADER)
        .is_some_and(|magic| magic == b"n+1\0" || magic == b"ni1\0")
        || is_second(bytes)
}

/// Of the second version, whose header is longer.
fn is_second(bytes: &[u8]) -> bool {
    bytes
        .get(4..8)
        .is_some_and(|magic| magic == b"n+2\0" || magic == b"ni2\0")
}

pub(super) fn parse(bytes: &[u8]) -> Result<Volume, VolumeError> {
    if is_second(bytes) {
        let what = "a NIfTI-2 image".into();
        return Err(VolumeError::Unsupported { what });
    }
    let order = match bytes.first_chunk() {
        Some(start) if i32::from_le_bytes(*start) == HEADER as i32 => Order::Little,
        Some(start) if i32::from_be_bytes(*start) == HEADER as i32 => Order::Big,
        _ => return Err(VolumeError::Header { what: "length" }),
    };
    if &bytes[344..HEADER] == b"ni1\0" {
        let what = "a NIfTI image in two files".into();
        return Err(VolumeError::Unsupported { what });
    }
    let header = Header { bytes, order };
    let axes = header.short(40);
    let extra = (4..=axes.clamp(0, 7)).map(|axis| header.short(40 + 2 * axis as usize));
    if axes < 3 || extra.into_iter().any(|side| side > 1) {
        let what = "a NIfTI image that has not three axes".into();
        return Err(VolumeError::Unsupported { what });
    }
    let size = [42, 44, 46].map(|at| usize::try_from(header.short(at)).unwrap_or(0));
    let [slope, offset] = [112, 116].map(|at| header.float(at));
    if slope.is_finite() && slope != 0.0 && [slope, offset] != [1.0, 0.0] {
        let what =
            format!("a NIfTI image of scaled numbers (scl_slope {slope}, scl_inter {offset})");
        return Err(VolumeError::Unsupported { what });
    }
    let kind = match header.short(70) {
        2 => Kind::U8,
        4 => Kind::I16,
        8 => Kind::I32,
        16 => Kind::F32,
        64 => Kind::F64,
        256 => Kind::I8,
        512 => Kind::U16,
        768 => Kind::U32,
        1024 => Kind::I64,
        1280 => Kind::U64,
        _ => return Err(VolumeError::Header { what: "data type" }),
    };
    let start = header.float(108);
    let voxels = match start >= HEADER as f64 {
        true => bytes.get(start as usize..).unwrap_or_default(),
        false => return Err(VolumeError::Header { what: "vox_offset" }),
    };
    let (origin, steps) = header.lattice();
    let bytes = voxels.to_vec();
    let volume = Volume::new(size, Samples { bytes, kind, order }, origin, steps)?;
    let name = ["", "m", "mm", "um"].get(usize::from(header.bytes[123] & 7));
    Ok(volume.in_unit(name.and_then(|name| unit::of(name))))
}

struct Header<'a> {
    bytes: &'a [u8],
    order: Order,
}

impl Header<'_> {
    fn short(&self, at: usize) -> i16 {
        let bytes = [self.bytes[at], self.bytes[at + 1]];
        match self.order {
            Order::Little => i16::from_le_bytes(bytes),
            Order::Big => i16::from_be_bytes(bytes),
        }
    }

    fn float(&self, at: usize) -> f64 {
        let bytes = [0, 1, 2, 3].map(|i| self.bytes[at + i]);
        f64::from(match self.order {
            Order::Little => f32::from_le_bytes(bytes),
            Order::Big => f32::from_be_bytes(bytes),
        })
    }

    /// Where the first voxel is, and the steps to its neighbours: by the affine form where there is one, else by the
    /// quaternion, else by the spacing alone.
    fn lattice(&self) -> (Point3<f64>, Matrix3<f64>) {
        let (qform, sform) = (self.short(252), self.short(254));
        let floats = |from: usize| [0, 1, 2].map(|i| self.float(from + 4 * i));
        if sform > 0 {
            let rows = [280, 296, 312];
            let origin = rows.map(|row| self.float(row + 12));
            let row = |row: usize| Vector3::from(floats(row)).transpose();
            let steps = Matrix3::from_rows(&rows.map(row));
            return (Point3::from(origin), steps);
        }
        let mut spacing = Vector3::from(floats(80));
        if qform <= 0 {
            return (Point3::origin(), Matrix3::from_diagonal(&spacing));
        }
        if self.float(76) < 0.0 {
            spacing.z = -spacing.z;
        }
        let [b, c, d] = floats(256);
        let a = (1.0 - b * b - c * c - d * d).max(0.0).sqrt();
        let turn = UnitQuaternion::new_normalize(Quaternion::new(a, b, c, d));
        let steps = turn.to_rotation_matrix().matrix() * Matrix3::from_diagonal(&spacing);
        (Point3::from(floats(268)), steps)
    }
}
