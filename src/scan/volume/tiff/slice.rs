//! The samples of a slice.

use crate::scan::volume::VolumeError;
use crate::scan::volume::samples::Kind;
use tiff::decoder::DecodingResult;

/// Appends the samples of a slice, the least byte first. Where white is zero the decoder turns them round, and they are
/// turned back: labels are the numbers that are stored.
pub(super) fn append(
    slice: DecodingResult,
    is_white_zero: bool,
    voxels: &mut Vec<u8>,
) -> Result<Kind, VolumeError> {
    macro_rules! all {
        ($samples:expr, $kind:expr, $stored:expr) => {{
            let stored = $samples.into_iter().map(|sample| match is_white_zero {
                true => $stored(sample),
                false => sample,
            });
            voxels.extend(stored.flat_map(|sample| sample.to_le_bytes()));
            Ok($kind)
        }};
    }
    match slice {
        DecodingResult::U8(samples) => all!(samples, Kind::U8, |x: u8| !x),
        DecodingResult::I8(samples) => all!(samples, Kind::I8, |x: i8| !x),
        DecodingResult::U16(samples) => all!(samples, Kind::U16, |x: u16| !x),
        DecodingResult::I16(samples) => all!(samples, Kind::I16, |x: i16| !x),
        DecodingResult::U32(samples) => all!(samples, Kind::U32, |x: u32| !x),
        DecodingResult::I32(samples) => all!(samples, Kind::I32, |x: i32| !x),
        DecodingResult::U64(samples) => all!(samples, Kind::U64, |x: u64| !x),
        DecodingResult::I64(samples) => all!(samples, Kind::I64, |x: i64| !x),
        DecodingResult::F32(samples) => all!(samples, Kind::F32, |x: f32| 1.0 - x),
        DecodingResult::F64(samples) => all!(samples, Kind::F64, |x: f64| 1.0 - x),
        _ => Err(VolumeError::Unsupported {
            what: "a TIFF of half-precision numbers".into(),
        }),
    }
}

/// The same of samples of so many bits, several to a byte and the highest bits first; each row begins with a byte of its
/// own.
pub(super) fn append_packed(
    slice: DecodingResult,
    bits: u8,
    width: usize,
    is_white_zero: bool,
    voxels: &mut Vec<u8>,
) -> Result<Kind, VolumeError> {
    let DecodingResult::U8(packed) = slice else {
        let what = "a TIFF of signed numbers of less than a byte".into();
        return Err(VolumeError::Unsupported { what });
    };
    let turned = if is_white_zero { 0xff } else { 0 };
    let bits = usize::from(bits);
    let per_byte = 8 / bits;
    for row in packed.chunks_exact(width.div_ceil(per_byte).max(1)) {
        voxels.extend((0..width).map(|x| {
            let shift = 8 - bits * (x % per_byte + 1);
            ((row[x / per_byte] ^ turned) >> shift) & ((1 << bits) - 1)
        }));
    }
    Ok(Kind::U8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_samples_are_spread_row_by_row() {
        let spread = |bytes: &[u8], bits, width, is_white_zero| {
            let mut voxels = Vec::new();
            let slice = DecodingResult::U8(bytes.into());
            append_packed(slice, bits, width, is_white_zero, &mut voxels).unwrap();
            voxels
        };
        let rows = [0b1010_0000, 0b0100_0000, 0b0000_0001, 0b1000_0000];
        let samples = [1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0];
        assert_eq!(spread(&rows, 1, 10, false), samples);
        assert_eq!(spread(&rows.map(|byte: u8| !byte), 1, 10, true), samples);
        let nibbles = [0x12, 0x30, 0x45, 0x60];
        assert_eq!(spread(&nibbles, 4, 3, false), [1, 2, 3, 4, 5, 6]);
    }
}
