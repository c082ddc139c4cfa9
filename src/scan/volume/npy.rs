//! NumPy arrays: a line of Python that tells type, order and shape, and the voxels. There is no spacing.

use super::samples::{Kind, Order, Samples};
use super::{Volume, VolumeError};
use nalgebra::{Matrix3, Point3};

/// An array with indices (z, y, x), as images have them.
pub(super) fn parse(bytes: &[u8]) -> Result<Volume, VolumeError> {
    let wrong = |what| VolumeError::Header { what };
    // Version 1 counts the bytes of the line in two bytes, later ones in four.
    let (start, length) = match bytes.get(6..12) {
        Some([1, _, a, b, ..]) => (10, usize::from(u16::from_le_bytes([*a, *b]))),
        Some([2 | 3, _, a, b, c, d]) => (12, u32::from_le_bytes([*a, *b, *c, *d]) as usize),
        _ => return Err(wrong("version")),
    };
    let end = start + length;
    let line = bytes.get(start..end).ok_or(wrong("length"))?;
    let line = std::str::from_utf8(line).map_err(|_| wrong("text"))?;
    let descr = after(line, "'descr':").and_then(|rest| rest.split('\'').nth(1));
    let descr = descr.ok_or(wrong("descr"))?;
    let (order, name) = match descr.split_at_checked(1) {
        Some((">", name)) => (Order::Big, name),
        Some(("<" | "|" | "=", name)) => (Order::Little, name),
        _ => return Err(wrong("descr")),
    };
    let kind = match name {
        "u1" | "b1" => Kind::U8,
        "i1" => Kind::I8,
        "u2" => Kind::U16,
        "i2" => Kind::I16,
        "u4" => Kind::U32,
        "i4" => Kind::I32,
        "u8" => Kind::U64,
        "i8" => Kind::I64,
        "f4" => Kind::F32,
        "f8" => Kind::F64,
        _ => return Err(wrong("descr")),
    };
    let is_fortran = after(line, "'fortran_order':").ok_or(wrong("fortran_order"))?;
    let is_fortran = is_fortran.trim_start().starts_with("True");
    let shape = after(line, "'shape':").and_then(|rest| {
        let (inside, _) = rest.split_once('(')?.1.split_once(')')?;
        let sides = inside
            .split(',')
            .map(str::trim)
            .filter(|side| !side.is_empty());
        sides
            .map(|side| side.parse().ok())
            .collect::<Option<Vec<usize>>>()
    });
    let Ok([z, y, x]) = <[usize; 3]>::try_from(shape.ok_or(wrong("shape"))?) else {
        let what = "an array that has not three axes".into();
        return Err(VolumeError::Unsupported { what });
    };
    // The index that runs fastest is the last one, along x; of Fortran's order the first one, along z.
    let (size, steps) = match is_fortran {
        false => ([x, y, z], Matrix3::identity()),
        true => (
            [z, y, x],
            Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0),
        ),
    };
    let bytes = bytes[end..].to_vec();
    let volume = Volume::new(
        size,
        Samples { bytes, kind, order },
        Point3::origin(),
        steps,
    )?;
    Ok(volume.with_warning("An array has no spacing: lengths are in voxels."))
}

fn after<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    line.split_once(key).map(|(_, rest)| rest)
}
