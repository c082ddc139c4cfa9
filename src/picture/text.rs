//! Letters.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Which part of a label stands at its place, in height always its middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// Its left end.
    Left,
    /// Its middle.
    Middle,
}

/// How large letters are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    /// Of notes and numbers.
    Small,
    /// Of titles.
    Large,
}

impl Anchor {
    /// Pixels of a width that lie before the place.
    pub(super) fn before(self, width: usize) -> usize {
        match self {
            Self::Left => 0,
            Self::Middle => width / 2,
        }
    }
}

impl Size {
    fn raster(self) -> RasterHeight {
        match self {
            Self::Small => RasterHeight::Size16,
            Self::Large => RasterHeight::Size20,
        }
    }

    /// Height of a line, in pixels.
    pub(crate) fn height(self) -> usize {
        self.raster().val()
    }

    /// Width of a text, in pixels.
    pub(crate) fn width(self, text: &str) -> usize {
        text.chars().count() * get_raster_width(FontWeight::Regular, self.raster())
    }

    /// Gives each pixel of a text that has ink: from the left, from above, and the share of it that is ink.
    pub(super) fn each_pixel(self, text: &str, mut put: impl FnMut(usize, usize, f64)) {
        let letter = |letter| get_raster(letter, FontWeight::Regular, self.raster());
        let step = get_raster_width(FontWeight::Regular, self.raster());
        for (place, sign) in text.chars().enumerate() {
            let Some(raster) = letter(sign).or_else(|| letter('?')) else {
                continue;
            };
            for (y, row) in raster.raster().iter().enumerate() {
                for (x, ink) in row.iter().enumerate().filter(|(_, ink)| **ink > 0) {
                    put(place * step + x, y, f64::from(*ink) / 255.0);
                }
            }
        }
    }
}
