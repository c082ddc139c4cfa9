//! Point clouds as PLY and XYZ.

use std::io::{self, Write};

use nalgebra::Point3;

use super::WriteError;
use crate::scan::{SplitGrain, heap, unit_remark};

/// Writes a binary little-endian PLY of points with 64-bit coordinates.
///
/// # Errors
///
/// [`WriteError`]: a coordinate that is not finite, or a failing writer.
pub fn write_points_ply(points: &[Point3<f64>], writer: &mut impl Write) -> Result<(), WriteError> {
    write_cloud(points, &[], writer)
}

/// Writes the points of one grain of a [split](crate::scan::split) as [`write_points_ply`] does. Where it was cut from a heap, a
/// comment says from how many, of which those who read the file are warned; another tells the unit, where the scan does.
///
/// # Errors
///
/// Those of [`write_points_ply`].
pub fn write_split_grain(grain: &SplitGrain, writer: &mut impl Write) -> Result<(), WriteError> {
    let of_heap = grain.cut.map(|cut| heap::remark(cut.grains));
    let of_unit = grain.scan.unit().map(unit_remark::remark);
    let comments: Vec<String> = of_heap.into_iter().chain(of_unit).collect();
    write_cloud(grain.scan.points(), &comments, writer)
}

fn write_cloud(
    points: &[Point3<f64>],
    comments: &[String],
    writer: &mut impl Write,
) -> Result<(), WriteError> {
    check(points, f64::MAX)?;
    writer.write_all(ply_header(points.len(), comments).as_bytes())?;
    writer.write_all(b"end_header\n")?;
    Ok(write_rows(points, writer)?)
}

/// Writes a line `x y z` per point, in the shortest decimals that read back as the same numbers.
///
/// # Errors
///
/// [`WriteError`]: a coordinate that is not finite, or a failing writer.
pub fn write_points_xyz(points: &[Point3<f64>], writer: &mut impl Write) -> Result<(), WriteError> {
    check(points, f64::MAX)?;
    for point in points {
        writeln!(writer, "{} {} {}", point.x, point.y, point.z)?;
    }
    Ok(())
}

/// The header of a PLY up to the end of its element `vertex`.
pub(super) fn ply_header(points: usize, comments: &[String]) -> String {
    let comments = comments
        .iter()
        .map(|comment| format!("comment {comment}\n"));
    let comments: String = comments.collect();
    format!(
        "ply\nformat binary_little_endian 1.0\ncomment written by grainform\n{comments}\
         element vertex {points}\nproperty double x\nproperty double y\nproperty double z\n"
    )
}

pub(super) fn write_rows(points: &[Point3<f64>], writer: &mut impl Write) -> io::Result<()> {
    for point in points {
        let mut row = [0; 24];
        for (number, bytes) in point.iter().zip(row.chunks_exact_mut(8)) {
            bytes.copy_from_slice(&number.to_le_bytes());
        }
        writer.write_all(&row)?;
    }
    Ok(())
}

/// Refuses coordinates that are not finite or larger than a format can hold.
pub(super) fn check(points: &[Point3<f64>], largest: f64) -> Result<(), WriteError> {
    for (vertex, point) in points.iter().enumerate() {
        let fits = |c: &&f64| c.is_finite() && c.abs() <= largest;
        if let Some(&value) = point.iter().find(|c| !fits(c)) {
            return Err(WriteError::OutOfRange { vertex, value });
        }
    }
    Ok(())
}
