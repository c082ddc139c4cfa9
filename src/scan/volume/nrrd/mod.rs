//! NRRD: lines of text, an empty one, and the voxels, or the name of the file that has them.

mod axes;
mod write;

use super::samples::{Kind, Order, Samples};
use super::{Beside, Volume, VolumeError};
use axes::Axes;
use nalgebra::Vector3;
use std::collections::HashMap;

/// What a header tells, by name.
type Fields = HashMap<String, String>;

pub(super) fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(b"NRRD")
}

pub(super) fn parse(bytes: &[u8], beside: &Beside<'_>) -> Result<Volume, VolumeError> {
    let (fields, voxels) = header(bytes)?;
    let field = |name: &str| fields.get(name).map(String::as_str);
    let Axes {
        size,
        origin,
        steps,
        unit,
        warning,
    } = Axes::of(&fields)?;
    if ["line skip", "lineskip", "byte skip", "byteskip"]
        .iter()
        .any(|name| field(name).is_some_and(|skip| skip != "0"))
    {
        let what = "an NRRD image whose voxels begin somewhere in a file".into();
        return Err(VolumeError::Unsupported { what });
    }
    let kind = field("type").and_then(kind);
    let kind = kind.ok_or(VolumeError::Header { what: "type" })?;
    let order = match field("endian") {
        Some(name) if name.eq_ignore_ascii_case("big") => Order::Big,
        _ => Order::Little,
    };
    let named = named(&fields).map(|name| beside.read(name)).transpose()?;
    let voxels = named.as_deref().unwrap_or(voxels);
    let encoding = field("encoding").unwrap_or("of no name");
    let bytes = match encoding.to_ascii_lowercase().as_str() {
        "raw" => voxels.to_vec(),
        "gzip" | "gz" => beside.unpack(voxels)?,
        _ => {
            let what = format!("the NRRD encoding {encoding}");
            return Err(VolumeError::Unsupported { what });
        }
    };
    let volume = Volume::new(size, Samples { bytes, kind, order }, origin, steps)?.in_unit(unit);
    Ok(match warning {
        Some(warning) => volume.with_warning(warning),
        None => volume,
    })
}

/// The file that has the voxels, where they are not in that of the header.
pub(super) fn voxel_file(bytes: &[u8]) -> Option<String> {
    named(&header(bytes).ok()?.0).map(str::to_owned)
}

fn named(fields: &Fields) -> Option<&str> {
    let name = fields.get("data file").or_else(|| fields.get("datafile"));
    name.map(String::as_str)
}

/// The fields, and what follows them.
fn header(bytes: &[u8]) -> Result<(Fields, &[u8]), VolumeError> {
    let mut fields = HashMap::new();
    let mut rest = bytes;
    loop {
        let Some(end) = rest.iter().position(|byte| *byte == b'\n') else {
            // A header of its own may end with the file.
            return Ok((fields, &[]));
        };
        let line = String::from_utf8_lossy(&rest[..end]);
        let line = line.trim();
        rest = &rest[end + 1..];
        if line.is_empty() {
            return Ok((fields, rest));
        }
        if let Some((name, value)) = line.split_once(": ")
            && !line.starts_with('#')
        {
            fields.insert(name.trim().to_ascii_lowercase(), value.trim().into());
        }
    }
}

fn numbers<T: std::str::FromStr>(text: Option<&str>) -> Option<Vec<T>> {
    let words = text?.split_whitespace();
    words.map(|word| word.parse().ok()).collect()
}

/// `(1,0,0)`
fn vector(text: &str) -> Option<Vector3<f64>> {
    let inside = text.trim().strip_prefix('(')?.strip_suffix(')')?;
    let numbers: Option<Vec<f64>> = inside.split(',').map(|x| x.trim().parse().ok()).collect();
    let [x, y, z] = numbers?[..] else { return None };
    Some(Vector3::new(x, y, z))
}

fn kind(name: &str) -> Option<Kind> {
    Some(match name.to_ascii_lowercase().as_str() {
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => Kind::U8,
        "signed char" | "int8" | "int8_t" => Kind::I8,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => Kind::U16,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => {
            Kind::I16
        }
        "uint" | "unsigned int" | "uint32" | "uint32_t" => Kind::U32,
        "int" | "signed int" | "int32" | "int32_t" => Kind::I32,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => {
            Kind::U64
        }
        "longlong" | "long long" | "long long int" | "signed long long" | "int64" | "int64_t" => {
            Kind::I64
        }
        "float" => Kind::F32,
        "double" => Kind::F64,
        _ => return None,
    })
}
