//! Meshes as binary glTF 2.0: a head in JSON and numbers of 32 bits.
//!
//! Places are seen from the middle of the mesh, where the node of the mesh lies: 32 bits are enough for a grain far from
//! the origin. Fields are attributes of the vertices whose names begin with an underscore, as the format asks; it has no
//! numbers that are not known, so that a field with such is left out.

use super::mesh::{check, count};
use super::{Detail, WriteError};
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};
use serde_json::{Map, Value, json};
use std::io::Write;

/// Types of numbers, and what buffers are for.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_BYTE: u32 = 5121;
const VERTICES: u32 = 34962;
const TRIANGLES: u32 = 34963;

/// The numbers, and what the head says of them.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds numbers; gives the index of their accessor, which is of the kind told.
    fn add(&mut self, bytes: impl Iterator<Item = u8>, target: u32, mut accessor: Value) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - start;
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": length, "target": target
        }));
        accessor["bufferView"] = json!(self.views.len() - 1);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn vectors(&mut self, vectors: &[Vector3<f64>], bounds: Option<[[f32; 3]; 2]>) -> usize {
        let mut accessor = json!({"componentType": FLOAT, "count": vectors.len(), "type": "VEC3"});
        if let Some([low, high]) = bounds {
            accessor["min"] = json!(low);
            accessor["max"] = json!(high);
        }
        let parts = vectors
            .iter()
            .flat_map(|vector| -> [f64; 3] { (*vector).into() });
        self.add(
            parts.flat_map(|part| (part as f32).to_le_bytes()),
            VERTICES,
            accessor,
        )
    }
}

/// Writes a binary glTF; triangles, normals, colours and fields.
///
/// # Errors
///
/// [`WriteError`]: a coordinate beyond 32 bits, a broken index, more than the format counts, or a failing writer.
pub(super) fn write_glb(
    mesh: &Mesh,
    detail: &Detail,
    writer: &mut impl Write,
) -> Result<(), WriteError> {
    check(mesh, f64::from(f32::MAX))?;
    count("vertices", mesh.vertices.len())?;
    let (middle, places) = about_middle(mesh);
    let mut buffer = Buffer::default();
    let mut attributes = Map::new();
    let mut put = |name: &str, accessor: usize| attributes.insert(name.into(), json!(accessor));
    put("POSITION", buffer.vectors(&places, Some(bounds(&places))));
    if detail.has_normals(mesh) {
        put("NORMAL", buffer.vectors(detail.normals, None));
    }
    if detail.has_colours(mesh) {
        let colours = detail
            .colours
            .iter()
            .flat_map(|[r, g, b]| [*r, *g, *b].map(linear).into_iter().chain([255]));
        let accessor = json!({
            "componentType": UNSIGNED_BYTE, "normalized": true, "count": places.len(), "type": "VEC4"
        });
        put("COLOR_0", buffer.add(colours, VERTICES, accessor));
    }
    let is_known = |value: &f64| (*value as f32).is_finite();
    for field in detail
        .fields(mesh)
        .filter(|field| field.values.iter().all(is_known))
    {
        let values = field
            .values
            .iter()
            .flat_map(|value| (*value as f32).to_le_bytes());
        let accessor = json!({"componentType": FLOAT, "count": places.len(), "type": "SCALAR"});
        put(
            &format!("_{}", field.name.to_uppercase()),
            buffer.add(values, VERTICES, accessor),
        );
    }
    let corners = mesh
        .triangles
        .iter()
        .flatten()
        .flat_map(|corner| corner.to_le_bytes());
    let accessor = json!({
        "componentType": UNSIGNED_INT, "count": 3 * mesh.triangles.len(), "type": "SCALAR"
    });
    let indices = buffer.add(corners, TRIANGLES, accessor);
    let head = json!({
        "asset": {"version": "2.0", "generator": "grainform"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [middle.x, middle.y, middle.z]}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.8}}],
        "buffers": [{"byteLength": buffer.bytes.len()}],
        "bufferViews": buffer.views,
        "accessors": buffer.accessors,
    });
    write_chunks(&head.to_string(), &buffer.bytes, writer)
}

/// The head is filled up with blanks to four bytes; all numbers are of four bytes.
fn write_chunks(head: &str, bytes: &[u8], writer: &mut impl Write) -> Result<(), WriteError> {
    let blanks = head.len().next_multiple_of(4) - head.len();
    let length = count("bytes", 12 + 8 + head.len() + blanks + 8 + bytes.len())?;
    writer.write_all(b"glTF")?;
    for number in [2, length, (head.len() + blanks) as u32] {
        writer.write_all(&number.to_le_bytes())?;
    }
    writer.write_all(b"JSON")?;
    writer.write_all(head.as_bytes())?;
    writer.write_all(&b"   "[..blanks])?;
    writer.write_all(&(bytes.len() as u32).to_le_bytes())?;
    writer.write_all(b"BIN\0")?;
    writer.write_all(bytes)?;
    Ok(())
}

/// The middle of a mesh, in 32 bits, and its vertices seen from there.
fn about_middle(mesh: &Mesh) -> (Point3<f64>, Vec<Vector3<f64>>) {
    let places: Vec<Vector3<f64>> = mesh.vertices.iter().map(|vertex| vertex.coords).collect();
    let [low, high] = bounds(&places);
    let middle = |axis: usize| f64::from(low[axis]) / 2.0 + f64::from(high[axis]) / 2.0;
    let middle = Point3::new(middle(0), middle(1), middle(2));
    (
        middle,
        places.iter().map(|place| place - middle.coords).collect(),
    )
}

/// Least and largest coordinates, as the numbers that are written.
fn bounds(places: &[Vector3<f64>]) -> [[f32; 3]; 2] {
    let Some(first) = places.first() else {
        return [[0.0; 3]; 2];
    };
    let ends = places.iter().fold([*first; 2], |[low, high], place| {
        [low.inf(place), high.sup(place)]
    });
    ends.map(|end| [end.x as f32, end.y as f32, end.z as f32])
}

/// A part of an sRGB colour in linear light, as glTF has colours of vertices.
fn linear(part: u8) -> u8 {
    let part = f64::from(part) / 255.0;
    let linear = match part <= 0.04045 {
        true => part / 12.92,
        false => ((part + 0.055) / 1.055).powf(2.4),
    };
    (255.0 * linear).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::annotate::Field;

    #[test]
    fn the_head_tells_where_the_numbers_are() {
        let far = Vector3::new(5e6, 0.0, 0.0);
        let mut mesh = Mesh::radial(3, |_| 1.0);
        let normals: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.coords).collect();
        mesh.vertices.iter_mut().for_each(|vertex| *vertex += far);
        let mut fields = [("segment", 2.0), ("deviation", f64::NAN)].map(|(name, value)| Field {
            name,
            values: vec![value; normals.len()],
        });
        fields[0].values[1] = 7.0;
        let detail = Detail {
            normals: &normals,
            fields: &fields,
            colours: &vec![[255, 0, 0]; normals.len()],
        };
        let mut bytes = Vec::new();
        write_glb(&mesh, &detail, &mut bytes).unwrap();
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(
            (&bytes[..4], number(4), number(8)),
            (&b"glTF"[..], 2, bytes.len())
        );
        let head: Value = serde_json::from_slice(&bytes[20..20 + number(12)]).unwrap();
        let start = 20 + number(12) + 8;
        assert_eq!(number(start - 8), bytes.len() - start);
        let primitive = &head["meshes"][0]["primitives"][0];
        assert!(primitive["attributes"].get("_DEVIATION").is_none());
        let at = |accessor: &Value| {
            let accessor = &head["accessors"][accessor.as_u64().unwrap() as usize];
            let view = &head["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
            start + view["byteOffset"].as_u64().unwrap() as usize
        };
        let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!(float(at(&primitive["attributes"]["_SEGMENT"]) + 4), 7.0);
        let shift = head["nodes"][0]["translation"][0].as_f64().unwrap();
        let place = f64::from(float(at(&primitive["attributes"]["POSITION"])));
        assert!((place + shift - mesh.vertices[0].x).abs() < 1e-6);
        let corner = number(at(&primitive["indices"]) + 4);
        assert_eq!(corner, mesh.triangles[0][1] as usize);
    }
}
