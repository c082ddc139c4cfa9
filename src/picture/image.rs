//! Pixels.

use super::{Anchor, Colour, Size};
use std::io::Write;

/// A picture in sRGB.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Image {
    size: [usize; 2],
    pixels: Vec<Colour>,
}

/// Why a picture was not written as PNG: the writer failed.
#[derive(Debug, thiserror::Error)]
#[error("the picture could not be written")]
pub(crate) struct PngError(#[from] png::EncodingError);

impl Image {
    /// A picture of one colour, of so many pixels in width and height.
    pub(crate) fn new(size: [usize; 2], colour: Colour) -> Self {
        Self::from_fn(size, |_, _| colour)
    }

    /// A picture of the colours at x and y, counted from the left and from above.
    pub(crate) fn from_fn(size: [usize; 2], colour: impl Fn(usize, usize) -> Colour) -> Self {
        let [width, height] = size;
        let pixels = (0..width * height).map(|at| colour(at % width, at / width));
        Self {
            size,
            pixels: pixels.collect(),
        }
    }

    /// The colour at x and y; black outside.
    pub(crate) fn pixel(&self, x: usize, y: usize) -> Colour {
        match x < self.size[0] && y < self.size[1] {
            true => self.pixels[y * self.size[0] + x],
            false => [0; 3],
        }
    }

    /// Sets the colour at x and y, if that is inside.
    pub(crate) fn put(&mut self, x: usize, y: usize, colour: Colour) {
        if x < self.size[0] && y < self.size[1] {
            self.pixels[y * self.size[0] + x] = colour;
        }
    }

    /// Lays another picture on this one, with its corner at left and top.
    pub(crate) fn lay(&mut self, other: &Self, [left, top]: [usize; 2]) {
        for y in 0..other.size[1] {
            for x in 0..other.size[0] {
                self.put(left + x, top + y, other.pixel(x, y));
            }
        }
    }

    /// Fills a rectangle from left and top, of so many pixels in width and height.
    pub(crate) fn fill(
        &mut self,
        [left, top]: [usize; 2],
        [width, height]: [usize; 2],
        colour: Colour,
    ) {
        self.lay(&Self::new([width, height], colour), [left, top]);
    }

    /// Writes a label beside a place: letters of ASCII and Latin-1, `?` for others.
    pub(crate) fn label(
        &mut self,
        text: &str,
        [x, y]: [usize; 2],
        anchor: Anchor,
        size: Size,
        ink: Colour,
    ) {
        let (width, height) = (size.width(text), size.height());
        let left = x.saturating_sub(anchor.before(width));
        let top = y.saturating_sub(height / 2);
        size.each_pixel(text, |dx, dy, share| {
            let (x, y) = (left + dx, top + dy);
            let under = self.pixel(x, y);
            let mixed = [0, 1, 2].map(|i| {
                let (from, to) = (f64::from(under[i]), f64::from(ink[i]));
                (from + share * (to - from)).round() as u8
            });
            self.put(x, y, mixed);
        });
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// [`PngError`] where the writer fails.
    pub(crate) fn write_png(&self, writer: impl Write) -> Result<(), PngError> {
        let [width, height] = self.size.map(|pixels| pixels as u32);
        let mut encoder = png::Encoder::new(writer, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        Ok(writer.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_png_reads_back_as_the_same_pixels() {
        let image = Image::from_fn([7, 5], |x, y| [x as u8 * 30, y as u8 * 50, 9]);
        let mut bytes = Vec::new();
        image.write_png(&mut bytes).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut read = vec![0; 7 * 5 * 3];
        reader.next_frame(&mut read).unwrap();
        assert_eq!(read, image.pixels.as_flattened());
    }

    #[test]
    fn a_label_stands_where_it_is_anchored() {
        let inked = |anchor| {
            let mut image = Image::new([120, 40], [255; 3]);
            image.label("0.1 mm²", [60, 20], anchor, Size::Small, [0; 3]);
            let dark = (0..120 * 40).filter(|at| image.pixels[*at] != [255; 3]);
            let columns: Vec<usize> = dark.map(|at| at % 120).collect();
            [columns.iter().min().copied(), columns.iter().max().copied()].map(Option::unwrap)
        };
        assert!(inked(Anchor::Left)[0] >= 60);
        let [low, high] = inked(Anchor::Middle);
        assert!((60 - low).abs_diff(high - 60) < 6, "{low} {high}");
    }
}
