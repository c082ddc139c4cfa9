//! Meshes as STL, PLY and OBJ.
//!
//! stl_io writes the facets of STL; what it does not check (the count, the range of the numbers)
//! is checked before. ply-rs would need a copy of the mesh with a hash map per vertex, so PLY is
//! two loops of our own.

use std::io::{self, Write};

use nalgebra::Vector3;

use super::{Detail, WriteError};
use crate::mesh::Mesh;

/// What fills the header of 80 bytes. Text that starts with `solid` would pass for a text STL.
const STL_TITLE: &[u8; 80] = &{
    let mut title = [b' '; 80];
    let (start, _) = title.split_at_mut(31);
    start.copy_from_slice(b"Binary STL written by grainform");
    title
};

/// Writes a binary STL: 32-bit coordinates, unit normals by winding, zero for slivers.
///
/// Far from the origin 32 bits are coarse: at 5 000 000 they count in steps of 0.5.
///
/// # Errors
///
/// [`WriteError`]: a coordinate beyond 32 bits, a broken index, too many triangles, or a failing
/// writer.
pub fn write_stl(mesh: &Mesh, writer: &mut impl Write) -> Result<(), WriteError> {
    count("triangles", mesh.triangles.len())?;
    check(mesh, f64::from(f32::MAX))?;
    let facet = |corners: &[u32; 3]| {
        let corners = corners.map(|corner| mesh.vertices[corner as usize].coords);
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
        stl_io::Triangle {
            normal: single(normal.unwrap_or(Vector3::zeros())),
            vertices: corners.map(single),
        }
    };
    let mut writer = Titled { writer, written: 0 };
    Ok(stl_io::write_stl(
        &mut writer,
        mesh.triangles.iter().map(facet),
    )?)
}

fn single(vector: Vector3<f64>) -> stl_io::Vector<f32> {
    stl_io::Vector::new([vector.x as f32, vector.y as f32, vector.z as f32])
}

/// Puts the title in place of the empty header that stl_io writes.
struct Titled<'a, W> {
    writer: &'a mut W,
    written: usize,
}

impl<W: Write> Write for Titled<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let title = STL_TITLE.get(self.written..).unwrap_or_default();
        let written = if title.is_empty() {
            self.writer.write(bytes)?
        } else {
            self.writer.write(&title[..title.len().min(bytes.len())])?
        };
        self.written += written;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Writes a binary little-endian PLY with 64-bit coordinates.
///
/// # Errors
///
/// [`WriteError`]: a coordinate that is not finite, a broken index, or a failing writer.
pub fn write_ply(mesh: &Mesh, writer: &mut impl Write) -> Result<(), WriteError> {
    write_detailed_ply(mesh, &Detail::default(), writer)
}

/// The same, with normals and fields as further properties of the vertices.
pub(super) fn write_detailed_ply(
    mesh: &Mesh,
    detail: &Detail,
    writer: &mut impl Write,
) -> Result<(), WriteError> {
    check(mesh, f64::MAX)?;
    count("vertices", mesh.vertices.len())?;
    let has_normals = detail.has_normals(mesh);
    writer.write_all(super::points::ply_header(mesh.vertices.len(), &[]).as_bytes())?;
    let normals = ["nx", "ny", "nz"].into_iter().filter(|_| has_normals);
    for name in normals.chain(detail.fields(mesh).map(|field| field.name)) {
        writeln!(writer, "property double {name}")?;
    }
    let faces = mesh.triangles.len();
    writeln!(
        writer,
        "element face {faces}\nproperty list uchar uint vertex_indices"
    )?;
    writer.write_all(b"end_header\n")?;
    for (at, vertex) in mesh.vertices.iter().enumerate() {
        super::points::write_rows(&[*vertex], writer)?;
        if has_normals {
            super::points::write_rows(&[detail.normals[at].into()], writer)?;
        }
        for field in detail.fields(mesh) {
            writer.write_all(&field.values[at].to_le_bytes())?;
        }
    }
    for corners in &mesh.triangles {
        let mut row = [3; 13];
        for (corner, bytes) in corners.iter().zip(row[1..].chunks_exact_mut(4)) {
            bytes.copy_from_slice(&corner.to_le_bytes());
        }
        writer.write_all(&row)?;
    }
    Ok(())
}

/// Writes a Wavefront OBJ with the shortest decimals that read back as the same numbers.
///
/// # Errors
///
/// [`WriteError`]: a coordinate that is not finite, a broken index, or a failing writer.
pub fn write_obj(mesh: &Mesh, writer: &mut impl Write) -> Result<(), WriteError> {
    check(mesh, f64::MAX)?;
    for vertex in &mesh.vertices {
        writeln!(writer, "v {} {} {}", vertex.x, vertex.y, vertex.z)?;
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| u64::from(corner) + 1);
        writeln!(writer, "f {a} {b} {c}")?;
    }
    Ok(())
}

pub(super) fn count(what: &'static str, count: usize) -> Result<u32, WriteError> {
    u32::try_from(count).map_err(|_| WriteError::TooMany { what, count })
}

/// Refuses what the format cannot hold, before a byte is written.
pub(super) fn check(mesh: &Mesh, largest: f64) -> Result<(), WriteError> {
    super::points::check(&mesh.vertices, largest)?;
    let vertices = mesh.vertices.len();
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&corner| corner as usize >= vertices) {
            return Err(WriteError::NoSuchVertex {
                triangle,
                vertex,
                vertices,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use nalgebra::point;

    use super::*;

    fn triangle() -> Mesh {
        Mesh {
            vertices: vec![
                point![0.0, 0.0, 0.0],
                point![2.0, 0.0, 0.0],
                point![0.0, 2.0, 0.0],
            ],
            triangles: vec![[0, 1, 2]],
        }
    }

    #[test]
    fn stl_has_a_title_a_count_and_the_normal_of_the_winding() {
        let mut bytes = Vec::new();
        write_stl(&triangle(), &mut bytes).unwrap();
        assert!(bytes.starts_with(STL_TITLE));
        assert_eq!(bytes.len(), 134);
        assert_eq!(bytes[80..84], [1, 0, 0, 0]);
        assert_eq!(bytes[92..96], 1.0_f32.to_le_bytes());
    }

    #[test]
    fn what_a_format_cannot_hold_is_refused() {
        let mut mesh = triangle();
        mesh.vertices[1].x = 1e39;
        let refused = write_stl(&mesh, &mut Vec::new());
        assert!(matches!(
            refused,
            Err(WriteError::OutOfRange { vertex: 1, .. })
        ));
        assert!(write_ply(&mesh, &mut Vec::new()).is_ok());
        mesh.vertices[1].x = f64::NAN;
        assert!(write_obj(&mesh, &mut Vec::new()).is_err());
        mesh = triangle();
        mesh.triangles[0][2] = 3;
        let refused = write_ply(&mesh, &mut Vec::new());
        assert!(matches!(
            refused,
            Err(WriteError::NoSuchVertex { vertex: 3, .. })
        ));
    }
}
