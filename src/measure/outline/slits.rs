//! Slits and spikes of a closed line that are too narrow to be the body's.
//!
//! A flat wall that is seen edge-on covers nothing but what its corners' rounding makes of it: slivers, some of which stand apart
//! from the face beside them by as little. The border of what they cover goes in and out between them, and is half as long
//! again as the body's.

use nalgebra::Vector2;

/// A closed line without the stretches that it walks to and fro, closer together than `width`.
pub(super) fn without_slits(line: Vec<Vector2<f64>>, width: f64) -> Vec<Vector2<f64>> {
    // Twice, and not from the same corner: that may be the end of a slit.
    (0..2).fold(line, |line, _| {
        let start = line.len() / 2;
        let mut kept: Vec<Vector2<f64>> = Vec::with_capacity(line.len());
        for &corner in line[start..].iter().chain(&line[..start]) {
            // Where a slit ends, its line may go anywhere within its width.
            while let Some(&tip) = kept.last()
                && let Some(at) = kept.iter().rposition(|p| (p - tip).norm() > width)
                && turns_back(kept[at] - tip, corner - tip, width)
            {
                kept.truncate(at + 1);
            }
            kept.push(corner);
        }
        kept
    })
}

/// Whether two edges at a corner lie on each other, as far as the shorter of them reaches.
fn turns_back(back: Vector2<f64>, ahead: Vector2<f64>, width: f64) -> bool {
    let longer = back.norm().max(ahead.norm());
    back.dot(&ahead) >= 0.0 && back.perp(&ahead).abs() <= width * longer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::outline::signed_area;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn length(line: &[Vector2<f64>]) -> f64 {
        let edges = line.iter().zip(line.iter().cycle().skip(1));
        edges.map(|(p, q)| (q - p).norm()).sum()
    }

    proptest! {
        #[test]
        fn slits_and_spikes_of_a_square_go_wherever_the_line_begins(start in 0..17_usize) {
            let narrow = 1e-7;
            let mut line = [
                [0.0, 0.0], [1.0, 0.0],
                // A spike out of a corner, and a slit along the wall, of other corners to than fro.
                [2.0, 0.0], [1.5, narrow], [1.0, narrow],
                [1.0, 1.0],
                // A slit across nearly all of it, the end of which has corners that do not turn back.
                [0.4, 1.0], [0.4, 0.3], [0.4 - narrow, 0.3 - 0.2 * narrow], [0.4 - 2.0 * narrow, 0.3 - 0.1 * narrow],
                [0.4 - 2.0 * narrow, 1.0],
                [0.0, 1.0],
                [narrow, 0.2], [narrow, 0.1], [0.0, 0.3], [narrow / 2.0, 0.6], [0.0, 0.7],
            ]
            .map(Vector2::from);
            line.rotate_left(start);
            let found = without_slits(line.to_vec(), 1e-6);
            assert_relative_eq!(length(&found), 4.0, epsilon = 1e-5);
            assert_relative_eq!(signed_area(&found), 1.0, epsilon = 1e-5);
        }

        #[test]
        fn what_is_wider_stays(width in 1e-5..0.5_f64) {
            let line = [
                [0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5 + width / 2.0, 1.0],
                [0.5, 0.2], [0.5 - width / 2.0, 1.0], [0.0, 1.0],
            ]
            .map(Vector2::from);
            prop_assert_eq!(without_slits(line.to_vec(), 1e-6).len(), line.len());
        }
    }
}
