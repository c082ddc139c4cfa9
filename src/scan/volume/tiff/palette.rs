//! Stacks whose colours are in a table, as programs show labels. Labels are the numbers that are stored, whatever their
//! colours; the decoder reads no such images, so that their bytes are made to say that the numbers are grey values.

use std::borrow::Cow;
use std::io::Cursor;
use tiff::TiffResult;
use tiff::decoder::Decoder;
use tiff::tags::{ByteOrder, PhotometricInterpretation, Tag};

/// The bytes of a stack, without tables of colours.
///
/// # Errors
/// Those of the decoder.
pub(super) fn as_grey(bytes: &[u8]) -> TiffResult<Cow<'_, [u8]>> {
    let mut decoder = Decoder::new(Cursor::new(bytes))?;
    let layout = Layout {
        order: decoder.byte_order(),
        is_big: bytes[2..4].contains(&43),
    };
    let mut grey = Cow::Borrowed(bytes);
    loop {
        let told = decoder.find_tag_unsigned(Tag::PhotometricInterpretation)?;
        if told == Some(PhotometricInterpretation::RGBPalette.to_u16())
            && let Some(directory) = decoder.ifd_pointer()
            && let Some(value) = layout.value(bytes, directory.0)
        {
            let black_is_zero = PhotometricInterpretation::BlackIsZero.to_u16();
            grey.to_mut()[value..value + 2].copy_from_slice(&layout.bytes(black_is_zero));
        }
        if !decoder.more_images() {
            return Ok(grey);
        }
        decoder.next_image()?;
    }
}

/// How numbers are stored.
struct Layout {
    order: ByteOrder,
    /// With places of eight bytes, as files of more than 4 GB have.
    is_big: bool,
}

impl Layout {
    fn bytes(&self, number: u16) -> [u8; 2] {
        match self.order {
            ByteOrder::LittleEndian => number.to_le_bytes(),
            ByteOrder::BigEndian => number.to_be_bytes(),
        }
    }

    /// Where a directory tells how samples are to be understood: each of its entries has a tag, a type, a count and a value.
    fn value(&self, bytes: &[u8], directory: u64) -> Option<usize> {
        let (count, entry, value) = match self.is_big {
            true => (8, 20, 12),
            false => (2, 12, 8),
        };
        let first = usize::try_from(directory).ok()?.checked_add(count)?;
        let tag = self.bytes(Tag::PhotometricInterpretation.to_u16());
        let entries = bytes.get(first..)?.chunks_exact(entry);
        let at = entries
            .take(usize::from(u16::MAX))
            .position(|entry| entry.starts_with(&tag))?;
        Some(first + at * entry + value)
    }
}
