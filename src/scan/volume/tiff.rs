//! TIFF stacks: an image per slice. Spacing is that which ImageJ writes; other files have none along the stack.

use super::samples::{Kind, Order, Samples};
use super::{Volume, VolumeError};
use nalgebra::{Matrix3, Point3, Vector3};
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// How many times smaller than its voxels a file may be: no more than packing can do, so that no header makes room for
/// what is not there.
const LARGEST_RATIO: usize = 1100;

pub(super) fn parse(bytes: &[u8], limit: u64) -> Result<Volume, VolumeError> {
    let limit = usize::try_from(limit).unwrap_or(usize::MAX);
    let limit = limit.min(LARGEST_RATIO.saturating_mul(bytes.len()));
    let mut limits = Limits::default();
    limits.decoding_buffer_size = limit;
    let mut decoder = Decoder::new(Cursor::new(bytes))
        .map_err(told)?
        .with_limits(limits);
    let [width, height] = size(&mut decoder)?;
    let spacing = spacing(&mut decoder);
    let (mut kind, mut voxels, mut slices) = (None, Vec::new(), 0);
    loop {
        if size(&mut decoder)? != [width, height] {
            let what = "a stack of slices of several sizes".into();
            return Err(VolumeError::Unsupported { what });
        }
        if !matches!(decoder.colortype().map_err(told)?, ColorType::Gray(_)) {
            let what = "a coloured TIFF".into();
            return Err(VolumeError::Unsupported { what });
        }
        let own = append(decoder.read_image().map_err(told)?, &mut voxels)?;
        if *kind.get_or_insert(own) != own {
            let what = "a stack of slices of several types".into();
            return Err(VolumeError::Unsupported { what });
        }
        slices += 1;
        if voxels.len() > limit {
            return Err(VolumeError::Size {
                size: [width, height, slices],
            });
        }
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().map_err(told)?;
    }
    let samples = Samples {
        bytes: voxels,
        kind: kind.unwrap_or(Kind::U8),
        order: Order::Little,
    };
    let steps = Matrix3::from_diagonal(&spacing.unwrap_or(Vector3::repeat(1.0)));
    let volume = Volume::new([width, height, slices], samples, Point3::origin(), steps)?;
    Ok(match spacing {
        Some(_) => volume,
        None => volume.with_warning("The TIFF stack has no spacing: lengths are in voxels."),
    })
}

type Stack<'a> = Decoder<Cursor<&'a [u8]>>;

fn size(decoder: &mut Stack<'_>) -> Result<[usize; 2], VolumeError> {
    let (width, height) = decoder.dimensions().map_err(told)?;
    Ok([width as usize, height as usize])
}

/// The steps that ImageJ tells, where it has written the file.
fn spacing(decoder: &mut Stack<'_>) -> Option<Vector3<f64>> {
    let text = decoder.get_tag_ascii_string(Tag::ImageDescription).ok()?;
    let depth = text.lines().find_map(|line| line.strip_prefix("spacing="));
    let depth: f64 = depth
        .filter(|_| text.starts_with("ImageJ="))?
        .trim()
        .parse()
        .ok()?;
    let mut step = |tag: Tag| {
        let per_unit = decoder.get_tag(tag).ok()?;
        let per_unit = match per_unit {
            tiff::decoder::ifd::Value::Rational(n, d) => f64::from(n) / f64::from(d),
            _ => return None,
        };
        (per_unit > 0.0 && per_unit.is_finite()).then(|| 1.0 / per_unit)
    };
    Some(Vector3::new(
        step(Tag::XResolution)?,
        step(Tag::YResolution)?,
        depth,
    ))
}

/// Appends the samples of a slice, the least byte first.
fn append(slice: DecodingResult, voxels: &mut Vec<u8>) -> Result<Kind, VolumeError> {
    macro_rules! all {
        ($samples:expr, $kind:expr) => {{
            voxels.extend($samples.iter().flat_map(|sample| sample.to_le_bytes()));
            Ok($kind)
        }};
    }
    match slice {
        DecodingResult::U8(samples) => all!(samples, Kind::U8),
        DecodingResult::I8(samples) => all!(samples, Kind::I8),
        DecodingResult::U16(samples) => all!(samples, Kind::U16),
        DecodingResult::I16(samples) => all!(samples, Kind::I16),
        DecodingResult::U32(samples) => all!(samples, Kind::U32),
        DecodingResult::I32(samples) => all!(samples, Kind::I32),
        DecodingResult::U64(samples) => all!(samples, Kind::U64),
        DecodingResult::I64(samples) => all!(samples, Kind::I64),
        DecodingResult::F32(samples) => all!(samples, Kind::F32),
        DecodingResult::F64(samples) => all!(samples, Kind::F64),
        _ => Err(VolumeError::Unsupported {
            what: "a TIFF of half-precision numbers".into(),
        }),
    }
}

fn told(error: TiffError) -> VolumeError {
    VolumeError::Voxels {
        name: "the TIFF stack".into(),
        reason: error.to_string(),
    }
}
