//! Colours, and maps of numbers to colours.

use colorous::Gradient;

/// Red, green and blue in sRGB.
pub(crate) type Colour = [u8; 3];

/// What a picture is drawn on.
pub(crate) const GROUND: Colour = [255; 3];

/// The colour of labels and lines.
pub(crate) const INK: Colour = [45; 3];

/// The colour of a share from 0 to 1 of a range: viridis (Smith, van der Walt 2015), in which equal steps look equal,
/// to colour-blind eyes too.
pub(crate) fn sequential(share: f64) -> Colour {
    of(colorous::VIRIDIS, share)
}

/// The colour of a number from -1 (blue) by 0 (white) to 1 (red), in steps that colour-blind eyes tell apart (Brewer's
/// RdBu).
pub(crate) fn diverging(value: f64) -> Colour {
    of(colorous::RED_BLUE, 0.5 - 0.5 * value)
}

/// What is not a number is grey.
fn of(gradient: Gradient, share: f64) -> Colour {
    match share.is_nan() {
        true => [150; 3],
        false => gradient.eval_continuous(share.clamp(0.0, 1.0)).as_array(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_have_their_colours_and_nothing_is_grey() {
        let [red, _, blue] = diverging(0.8);
        assert!(red > blue);
        let [red, _, blue] = diverging(-0.8);
        assert!(blue > red);
        assert!(diverging(0.0).iter().all(|part| *part > 235));
        assert_eq!(diverging(f64::NAN), [150; 3]);
        assert_eq!(diverging(-7.0), diverging(-1.0));
    }

    #[test]
    fn the_sequence_becomes_lighter_step_by_step() {
        let light = |share: f64| {
            let [r, g, b] = sequential(share).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let steps: Vec<f64> = (0..=20).map(|i| light(f64::from(i) / 20.0)).collect();
        assert!(steps.is_sorted(), "{steps:?}");
    }
}
