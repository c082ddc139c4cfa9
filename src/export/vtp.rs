//! Meshes as VTK PolyData, the XML format of ParaView and PyVista, its numbers appended as they are in memory.

use super::mesh::{check, count};
use super::{Detail, WriteError};
use crate::mesh::Mesh;
use std::io::Write;

/// The element that describes an array, but for the place of its numbers.
const NUMBER: &str = "type=\"Float64\"";
const VECTOR: &str = "type=\"Float64\" NumberOfComponents=\"3\"";
const INDEX: &str = "type=\"Int64\"";

/// Arrays that are told of in the head and appended one after the other.
#[derive(Default)]
struct Appended {
    blocks: Vec<Vec<u8>>,
    bytes: usize,
}

impl Appended {
    /// Adds an array of parts of eight bytes; gives the element that describes it.
    fn add(&mut self, kind: &str, name: &str, parts: impl Iterator<Item = [u8; 8]>) -> String {
        let block: Vec<u8> = parts.flatten().collect();
        let offset = self.bytes;
        self.bytes += size_of::<u64>() + block.len();
        self.blocks.push(block);
        format!("<DataArray {kind} Name=\"{name}\" format=\"appended\" offset=\"{offset}\"/>\n")
    }
}

/// Writes a VTK PolyData with 64-bit numbers; normals and fields are arrays of its points.
///
/// # Errors
///
/// [`WriteError`]: a coordinate that is not finite, a broken index, or a failing writer.
pub(super) fn write_vtp(
    mesh: &Mesh,
    detail: &Detail,
    writer: &mut impl Write,
) -> Result<(), WriteError> {
    check(mesh, f64::MAX)?;
    count("vertices", mesh.vertices.len())?;
    let mut appended = Appended::default();
    let (vertices, triangles) = (mesh.vertices.len(), mesh.triangles.len());
    let mut head = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n<Piece NumberOfPoints=\"{vertices}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">\n<PointData"
    );
    if detail.has_normals(mesh) {
        head.push_str(" Normals=\"normals\">\n");
        let parts = detail
            .normals
            .iter()
            .flat_map(|normal| -> [f64; 3] { (*normal).into() });
        head += &appended.add(VECTOR, "normals", parts.map(f64::to_le_bytes));
    } else {
        head.push_str(">\n");
    }
    for field in detail.fields(mesh) {
        let values = field.values.iter().map(|value| value.to_le_bytes());
        head += &appended.add(NUMBER, field.name, values);
    }
    head.push_str("</PointData>\n<Points>\n");
    let places = mesh
        .vertices
        .iter()
        .flat_map(|vertex| -> [f64; 3] { vertex.coords.into() });
    head += &appended.add(VECTOR, "points", places.map(f64::to_le_bytes));
    head.push_str("</Points>\n<Polys>\n");
    let corners = mesh
        .triangles
        .iter()
        .flatten()
        .map(|corner| i64::from(*corner));
    head += &appended.add(INDEX, "connectivity", corners.map(i64::to_le_bytes));
    let ends = (1..=triangles).map(|triangle| 3 * triangle as i64);
    head += &appended.add(INDEX, "offsets", ends.map(i64::to_le_bytes));
    head.push_str("</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    writer.write_all(head.as_bytes())?;
    for block in &appended.blocks {
        writer.write_all(&(block.len() as u64).to_le_bytes())?;
        writer.write_all(block)?;
    }
    writer.write_all(b"\n</AppendedData>\n</VTKFile>\n")?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::annotate::Field;

    #[test]
    fn arrays_lie_where_the_head_says() {
        let mesh = Mesh::radial(2, |n| 2.0 + n.x);
        let fields = [Field {
            name: "height",
            values: mesh.vertices.iter().map(|vertex| vertex.z).collect(),
        }];
        let detail = Detail {
            fields: &fields,
            ..Detail::default()
        };
        let mut bytes = Vec::new();
        write_vtp(&mesh, &detail, &mut bytes).unwrap();
        let start = bytes.windows(6).position(|six| six == b"raw\">\n").unwrap() + 7;
        let head = std::str::from_utf8(&bytes[..start]).unwrap();
        let block = |name: &str| {
            let element = &head[head.find(&format!("Name=\"{name}\"")).unwrap()..];
            let offset = element.split("offset=\"").nth(1).unwrap();
            let at: usize = offset.split('"').next().unwrap().parse().unwrap();
            let eight = |at: usize| <[u8; 8]>::try_from(&bytes[at..at + 8]).unwrap();
            let count = u64::from_le_bytes(eight(start + at)) as usize / 8;
            (1..=count)
                .map(move |i| eight(start + at + 8 * i))
                .collect::<Vec<_>>()
        };
        let heights: Vec<f64> = block("height")
            .into_iter()
            .map(f64::from_le_bytes)
            .collect();
        assert_eq!(heights, fields[0].values);
        let places: Vec<f64> = block("points")
            .into_iter()
            .map(f64::from_le_bytes)
            .collect();
        assert_eq!(
            places[3..6],
            [mesh.vertices[1].x, mesh.vertices[1].y, mesh.vertices[1].z]
        );
        assert_eq!(block("connectivity").len(), 3 * mesh.triangles.len());
        let last = block("offsets").last().copied().map(i64::from_le_bytes);
        assert_eq!(last, Some(3 * mesh.triangles.len() as i64));
        assert!(bytes.ends_with(b"</VTKFile>\n"));
    }
}
