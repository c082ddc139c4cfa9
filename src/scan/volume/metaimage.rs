//! MetaImage: lines `Key = value`, of which the last tells where the voxels are: here (`LOCAL`, .mha) or in a file of
//! their own (.mhd).

use super::samples::{Kind, Order, Samples};
use super::{Beside, Volume, VolumeError, source, unit};
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

/// Whether a file begins as one, or is called as one.
pub(super) fn is_it(path: &Path, bytes: &[u8]) -> bool {
    let begins = |key: &[u8]| {
        let rest = bytes.strip_prefix(key).map(<[u8]>::trim_ascii_start);
        rest.is_some_and(|rest| rest.starts_with(b"="))
    };
    let extension = source::extension(path).map(str::to_ascii_lowercase);
    matches!(extension.as_deref(), Some("mhd" | "mha")) || begins(b"ObjectType") || begins(b"NDims")
}

pub(super) fn parse(bytes: &[u8], beside: &Beside<'_>) -> Result<Volume, VolumeError> {
    let (fields, rest) = header(bytes)?;
    let field = |name: &str| fields.get(name).map(String::as_str);
    if field("ObjectType").is_some_and(|kind| kind != "Image") {
        let what = "a MetaIO object that is no image".into();
        return Err(VolumeError::Unsupported { what });
    }
    let three = |names: &[&str]| names.iter().find_map(|name| numbers::<3>(field(name)));
    let size = three(&["DimSize"]).filter(|size| size.iter().all(|n| *n >= 1.0));
    let size = size.ok_or(VolumeError::Header { what: "DimSize" })?;
    let kind = field("ElementType").and_then(kind);
    let kind = kind.ok_or(VolumeError::Header {
        what: "ElementType",
    })?;
    if field("BinaryData").is_some_and(|value| value.eq_ignore_ascii_case("false")) {
        let what = "a MetaImage with its voxels as text (BinaryData = False)".into();
        return Err(VolumeError::Unsupported { what });
    }
    let is_true = |name: &str| field(name).is_some_and(|value| value.eq_ignore_ascii_case("true"));
    if field("HeaderSize").is_some_and(|size| size != "0") {
        let what = "a MetaImage whose voxels begin somewhere in a file".into();
        return Err(VolumeError::Unsupported { what });
    }
    if field("ElementNumberOfChannels").is_some_and(|channels| channels != "1") {
        let what = "a MetaImage of several numbers per voxel".into();
        return Err(VolumeError::Unsupported { what });
    }
    let named = named(&fields).map(|name| beside.read(name)).transpose()?;
    let voxels = named.as_deref().unwrap_or(rest);
    let bytes = match is_true("CompressedData") {
        true => inflate(voxels, beside.limit)?,
        false => voxels.to_vec(),
    };
    let spacing = three(&["ElementSpacing", "ElementSize"]);
    let origin = three(&["Offset", "Position", "Origin"]).unwrap_or_default();
    let directions = ["TransformMatrix", "Rotation", "Orientation"];
    let directions = directions.iter().find_map(|name| numbers::<9>(field(name)));
    // Nine numbers are the directions of the axes, one after the other.
    let directions = directions.map_or(Matrix3::identity(), |numbers| {
        Matrix3::from_column_slice(&numbers)
    });
    let order = match is_true("BinaryDataByteOrderMSB") || is_true("ElementByteOrderMSB") {
        true => Order::Big,
        false => Order::Little,
    };
    let steps = Vector3::from(spacing.unwrap_or([1.0; 3]));
    let volume = Volume::new(
        size.map(|side| side as usize),
        Samples { bytes, kind, order },
        Point3::from(origin),
        directions * Matrix3::from_diagonal(&steps),
    )?;
    Ok(match spacing {
        Some(_) => volume.in_unit(field("DistanceUnits").and_then(unit::of)),
        None => volume.with_warning("The MetaImage has no spacing: lengths are in voxels."),
    })
}

/// The file that has the voxels, where they are not in that of the header.
pub(super) fn voxel_file(bytes: &[u8]) -> Option<String> {
    named(&header(bytes).ok()?.0).map(str::to_owned)
}

fn named(fields: &HashMap<String, String>) -> Option<&str> {
    let name = fields.get("ElementDataFile").map(String::as_str);
    name.filter(|name| !name.eq_ignore_ascii_case("LOCAL"))
}

/// The fields, and what follows them.
fn header(bytes: &[u8]) -> Result<(HashMap<String, String>, &[u8]), VolumeError> {
    let mut fields = HashMap::new();
    let mut rest = bytes;
    while !fields.contains_key("ElementDataFile") {
        let end = rest.iter().position(|byte| *byte == b'\n');
        let end = end.unwrap_or(rest.len());
        let line = String::from_utf8_lossy(&rest[..end]).into_owned();
        let Some((name, value)) = line.split_once('=') else {
            return Err(VolumeError::Header {
                what: "ElementDataFile",
            });
        };
        fields.insert(name.trim().to_owned(), value.trim().to_owned());
        rest = rest.get(end + 1..).unwrap_or_default();
    }
    Ok((fields, rest))
}

/// What is packed with zlib.
fn inflate(packed: &[u8], limit: u64) -> Result<Vec<u8>, VolumeError> {
    let mut bytes = Vec::new();
    let read = flate2::read::ZlibDecoder::new(packed)
        .take(limit.saturating_add(1))
        .read_to_end(&mut bytes);
    match read {
        Ok(_) if bytes.len() as u64 > limit => Err(VolumeError::TooLarge { limit }),
        Ok(_) => Ok(bytes),
        Err(error) => Err(VolumeError::Voxels {
            name: "it".into(),
            reason: error.to_string(),
        }),
    }
}

fn numbers<const N: usize>(text: Option<&str>) -> Option<[f64; N]> {
    let words = text?.split_whitespace();
    let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
    numbers?.try_into().ok()
}

fn kind(name: &str) -> Option<Kind> {
    Some(match name {
        "MET_UCHAR" => Kind::U8,
        "MET_CHAR" => Kind::I8,
        "MET_USHORT" => Kind::U16,
        "MET_SHORT" => Kind::I16,
        "MET_UINT" => Kind::U32,
        "MET_INT" => Kind::I32,
        "MET_ULONG_LONG" => Kind::U64,
        "MET_LONG_LONG" => Kind::I64,
        "MET_FLOAT" => Kind::F32,
        "MET_DOUBLE" => Kind::F64,
        _ => return None,
    })
}
