//! The area that triangles in the plane cover together, however they overlap.

use nalgebra::Vector2;

/// Cells along the longer side of the grid whose middles are counted. Of a disc the area is off by 0.1 %.
const CELLS: usize = 400;

/// The area that triangles over these places cover, by counting: those wound counter-clockwise, which of a
/// closed surface cover all.
pub(super) fn covered_area(places: &[Vector2<f64>], triangles: &[[u32; 3]]) -> f64 {
    let mut low = Vector2::repeat(f64::INFINITY);
    let mut high = -low;
    for place in places {
        (low, high) = (low.inf(place), high.sup(place));
    }
    let cell = (high - low).amax() / CELLS as f64;
    if !(cell > 0.0 && cell.is_finite()) {
        return 0.0;
    }
    let count = |side: f64| ((side / cell).ceil() as usize).clamp(1, CELLS);
    let [columns, rows] = [count(high.x - low.x), count(high.y - low.y)];
    let mut covered = vec![false; columns * rows];
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| (places[corner as usize] - low) / cell);
        if (b - a).perp(&(c - a)) <= 0.0 {
            continue;
        }
        let (least, largest) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
        // Middles from the first to the last that are within.
        let from = |place: f64| (place - 0.5).ceil().max(0.0) as usize;
        let to = |place: f64, count: usize| {
            ((place - 0.5).floor() as isize + 1).clamp(0, count as isize)
        };
        for row in from(least.y)..to(largest.y, rows) as usize {
            for column in from(least.x)..to(largest.x, columns) as usize {
                let middle = Vector2::new(column as f64 + 0.5, row as f64 + 0.5);
                let is_left =
                    |p: &Vector2<f64>, q: &Vector2<f64>| (q - p).perp(&(middle - p)) >= 0.0;
                if is_left(&a, &b) && is_left(&b, &c) && is_left(&c, &a) {
                    covered[row * columns + column] = true;
                }
            }
        }
    }
    covered.iter().filter(|covered| **covered).count() as f64 * cell * cell
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn what_overlaps_is_counted_once() {
        let mut places = vec![Vector2::zeros()];
        places.extend((0..200).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 200.0).sin_cos();
            Vector2::new(2.0 * cos, sin)
        }));
        let fan = |i: u32| [0, 1 + i, 1 + (i + 1) % 200];
        let once: Vec<_> = (0..200).map(fan).collect();
        let twice: Vec<_> = once.iter().chain(&once).copied().collect();
        for triangles in [once, twice] {
            assert_relative_eq!(covered_area(&places, &triangles), TAU, max_relative = 3e-3);
        }
        let half: Vec<_> = (0..100).map(fan).collect();
        assert_relative_eq!(covered_area(&places, &half), PI, max_relative = 5e-3);
        assert_eq!(covered_area(&places, &[[0, 2, 1]]), 0.0);
        assert_eq!(covered_area(&[], &[]), 0.0);
    }
}
