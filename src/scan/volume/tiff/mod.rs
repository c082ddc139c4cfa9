//! TIFF stacks: an image per slice. Spacing is that of ImageJ or OME; other files have none along the stack.

mod description;
mod palette;
mod slice;

use super::samples::{Kind, Order, Samples};
use super::{Volume, VolumeError};
use description::{Description, Spacing};
use nalgebra::{Matrix3, Point3, Vector3};
use std::io::{Cursor, ErrorKind};
use tiff::decoder::ifd::Value;
use tiff::decoder::{Decoder, Limits};
use tiff::tags::{PhotometricInterpretation, Tag};
use tiff::{ColorType, TiffError};

/// How many times smaller than a slice a file may be: no more than packing can do, so that no header makes room for
/// what is not there.
const LARGEST_RATIO: usize = 1100;

/// Starts of files: of either order of bytes, of less than 4 GB or more.
const STARTS: [&[u8]; 4] = [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"];

pub(super) fn is_it(bytes: &[u8]) -> bool {
    STARTS.iter().any(|start| bytes.starts_with(start))
}

pub(super) fn parse(bytes: &[u8], limit: u64) -> Result<Volume, VolumeError> {
    let room = Room::of(bytes, limit);
    let told = |error| room.told(error);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = room.for_slice;
    limits.intermediate_buffer_size = room.for_slice;
    let bytes = palette::as_grey(bytes).map_err(told)?;
    let mut decoder = Decoder::new(Cursor::new(&*bytes))
        .map_err(told)?
        .with_limits(limits);
    let (width, height) = decoder.dimensions().map_err(told)?;
    let description = Description::of(&text(&mut decoder, bytes.len()))?;
    let (spacing, no_spacing) = match spacing(&mut decoder, description.spacing) {
        Ok(spacing) => (Some(spacing), None),
        Err(warning) => (None, Some(warning)),
    };
    let (mut kind, mut voxels, mut slices) = (None, Vec::new(), 0);
    loop {
        if decoder.dimensions().map_err(told)? != (width, height) {
            let what = "a stack of slices of several sizes".into();
            return Err(VolumeError::Unsupported { what });
        }
        let ColorType::Gray(bits) = decoder.colortype().map_err(told)? else {
            let what = "a coloured TIFF".into();
            return Err(VolumeError::Unsupported { what });
        };
        let interpretation = decoder.find_tag_unsigned(Tag::PhotometricInterpretation);
        let is_white_zero =
            interpretation.map_err(told)? == Some(PhotometricInterpretation::WhiteIsZero.to_u16());
        let samples = decoder.read_image().map_err(told)?;
        room.check(voxels.len(), u64::from(width) * u64::from(height))?;
        let own = match bits {
            1 | 2 | 4 => {
                slice::append_packed(samples, bits, width as usize, is_white_zero, &mut voxels)
            }
            _ => slice::append(samples, is_white_zero, &mut voxels),
        }?;
        if *kind.get_or_insert(own) != own {
            let what = "a stack of slices of several types".into();
            return Err(VolumeError::Unsupported { what });
        }
        slices += 1;
        room.check(voxels.len(), 0)?;
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().map_err(told)?;
    }
    description.check_slices(slices)?;
    let samples = Samples {
        bytes: voxels,
        kind: kind.unwrap_or(Kind::U8),
        order: Order::Little,
    };
    let size = [width as usize, height as usize, slices];
    let steps = Matrix3::from_diagonal(&spacing.unwrap_or(Vector3::repeat(1.0)));
    let volume = Volume::new(size, samples, Point3::origin(), steps)?;
    let warnings = no_spacing.into_iter().chain(description.warning());
    let volume = warnings.fold(volume, Volume::with_warning);
    // A unit of lengths that are not read is that of nothing.
    Ok(volume.in_unit(description.unit.filter(|_| spacing.is_some())))
}

/// How much the voxels may take.
struct Room {
    limit: u64,
    for_slice: usize,
}

impl Room {
    fn of(bytes: &[u8], limit: u64) -> Self {
        let allowed = usize::try_from(limit).unwrap_or(usize::MAX);
        let for_slice = allowed.min(LARGEST_RATIO.saturating_mul(bytes.len()));
        Self { limit, for_slice }
    }

    /// Whether there is room for more.
    fn check(&self, taken: usize, more: u64) -> Result<(), VolumeError> {
        match (taken as u64).saturating_add(more) > self.limit {
            true => Err(VolumeError::TooLarge { limit: self.limit }),
            false => Ok(()),
        }
    }

    fn told(&self, error: TiffError) -> VolumeError {
        let reason = match error {
            TiffError::LimitsExceeded if self.for_slice as u64 == self.limit => {
                return VolumeError::TooLarge { limit: self.limit };
            }
            TiffError::LimitsExceeded => "it promises more than its bytes can hold".into(),
            TiffError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
                "it ends before all of them are told; save it again".into()
            }
            TiffError::FormatError(error) => format!("it is damaged ({error}); save it again"),
            TiffError::UnsupportedError(error) => {
                format!(
                    "they are stored in a way that is not read here ({error}); save them unpacked"
                )
            }
            other => other.to_string(),
        };
        VolumeError::Voxels {
            name: "the TIFF stack".into(),
            reason,
        }
    }
}

type Stack<'a> = Decoder<Cursor<&'a [u8]>>;

/// The description of a stack; bytes that are not UTF-8 are Latin-1, as of a micrometre. A file holds no more of them than it has.
fn text(decoder: &mut Stack<'_>, most: usize) -> String {
    let mut directory = decoder.image_ifd();
    let length = directory
        .find_entry(Tag::ImageDescription)
        .map_or(0, |entry| entry.count());
    let mut bytes = vec![0; usize::try_from(length).map_or(most, |length| length.min(most))];
    let read = directory.find_tag_bytes(Tag::ImageDescription, &mut bytes, 0);
    bytes.truncate(read.ok().flatten().unwrap_or(0));
    let end = bytes.iter().position(|byte| *byte == 0);
    bytes.truncate(end.unwrap_or(bytes.len()));
    String::from_utf8(bytes)
        .unwrap_or_else(|error| error.as_bytes().iter().copied().map(char::from).collect())
}

/// The steps between voxels, or what is said where they are not told.
fn spacing(decoder: &mut Stack<'_>, told: Spacing) -> Result<Vector3<f64>, &'static str> {
    let mut step = |tag: Tag| match decoder.get_tag(tag) {
        Ok(Value::Rational(n, d)) if n > 0 && d > 0 => Some(f64::from(d) / f64::from(n)),
        _ => None,
    };
    let within = step(Tag::XResolution).zip(step(Tag::YResolution));
    match (told, within) {
        (Spacing::All(steps), _) => Ok(steps),
        (Spacing::Depth(z), Some((x, y))) => Ok(Vector3::new(x, y, z)),
        (Spacing::Untold, None | Some((1.0, 1.0))) => Err(NO_SPACING),
        (Spacing::Untold, Some(_)) => Err(NO_DEPTH),
        (Spacing::Depth(_) | Spacing::Incomplete, _) => Err(INCOMPLETE),
    }
}

const NO_SPACING: &str = "The TIFF stack has no spacing: lengths are in voxels.";

const NO_DEPTH: &str = "The TIFF stack tells the size of its pixels, but not the distance of its slices: neither is used, \
                        and lengths are in voxels.";

const INCOMPLETE: &str = "The TIFF stack does not tell a length above zero for each side of its voxels: what it tells is \
                          not used, and lengths are in voxels.";

#[cfg(test)]
mod tests;
