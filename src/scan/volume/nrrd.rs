//! NRRD: lines of text, an empty one, and the voxels, or the name of the file that has them.

use super::samples::{Kind, Order, Samples};
use super::{Beside, Volume, VolumeError};
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::HashMap;

pub(super) fn is_it(bytes: &[u8]) -> bool {
    bytes.starts_with(b"NRRD")
}

pub(super) fn parse(bytes: &[u8], beside: &Beside<'_>) -> Result<Volume, VolumeError> {
    let (fields, voxels) = header(bytes)?;
    let field = |name: &str| fields.get(name).map(String::as_str);
    let size: Vec<usize> = numbers(field("sizes")).ok_or(VolumeError::Header { what: "sizes" })?;
    let Ok(size) = <[usize; 3]>::try_from(size) else {
        let what = "an NRRD image that has not three axes".into();
        return Err(VolumeError::Unsupported { what });
    };
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
        Some("big") => Order::Big,
        _ => Order::Little,
    };
    let named = named(&fields).map(|name| beside.read(name)).transpose()?;
    let voxels = named.as_deref().unwrap_or(voxels);
    let bytes = match field("encoding") {
        Some("raw") => voxels.to_vec(),
        Some("gzip" | "gz") => beside.unpack(voxels)?,
        other => {
            let what = format!("the NRRD encoding {}", other.unwrap_or("of no name"));
            return Err(VolumeError::Unsupported { what });
        }
    };
    let steps = match (field("space directions"), field("spacings")) {
        (Some(text), _) => {
            let columns: Option<Vec<_>> = text.split_whitespace().map(vector).collect();
            let columns = columns.filter(|columns| columns.len() == 3);
            Matrix3::from_columns(&columns.ok_or(VolumeError::Header {
                what: "space directions",
            })?)
        }
        (None, Some(text)) => {
            let spacings: Option<Vec<f64>> = numbers(Some(text));
            let spacings = spacings.filter(|spacings| spacings.len() == 3);
            let spacings = spacings.ok_or(VolumeError::Header { what: "spacings" })?;
            Matrix3::from_diagonal(&Vector3::from_column_slice(&spacings))
        }
        (None, None) => Matrix3::identity(),
    };
    let origin = match field("space origin") {
        Some(text) => vector(text).ok_or(VolumeError::Header {
            what: "space origin",
        })?,
        None => Vector3::zeros(),
    };
    let samples = Samples { bytes, kind, order };
    let volume = Volume::new(size, samples, Point3::from(origin), steps)?;
    let is_spaced = field("space directions").or(field("spacings")).is_some();
    let volume = match is_spaced {
        true => volume,
        false => volume.with_warning("The NRRD image has no spacing: lengths are in voxels."),
    };
    let units = field("space units").or(field("units")).unwrap_or_default();
    Ok(units
        .split('"')
        .map(str::trim)
        .filter(|unit| !unit.is_empty() && unit.chars().all(char::is_alphabetic))
        .fold(volume, |volume, unit| volume.in_unit(unit)))
}

/// The file that has the voxels, where they are not in that of the header.
pub(super) fn voxel_file(bytes: &[u8]) -> Option<String> {
    named(&header(bytes).ok()?.0).map(str::to_owned)
}

fn named(fields: &HashMap<String, String>) -> Option<&str> {
    let name = fields.get("data file").or_else(|| fields.get("datafile"));
    name.map(String::as_str)
}

/// The fields, and what follows them.
fn header(bytes: &[u8]) -> Result<(HashMap<String, String>, &[u8]), VolumeError> {
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
