//! The volume of a union of balls.

use crate::measure::Ball;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// The most rows across the shorter side, whose error is below 1e-5.
const MOST_ROWS: usize = 3000;

/// The most rows across the longer side that is cut, of those across the shorter one.
const MOST_TIMES: f64 = 100.0;

/// The volume of a union of balls, by rows along its longest principal axis, each of which is cut exactly; what several
/// balls hold counts once. `rows`, one at least and 3000 at most, is their number across the shorter of the two other
/// sides of the union; they are as near to each other along the longer one, and less and more are taken as these bounds. Zero of
/// no balls; those of no radius, or one below zero, hold nothing.
///
/// Error, relative to the volume: that of a sum over the rims of the balls, below 1e-4 from 300 rows on.
pub fn union_volume(balls: &[Ball], rows: usize) -> f64 {
    let balls = balls.iter().filter(|ball| ball.radius > 0.0);
    let balls = along_own_axes(&balls.copied().collect::<Vec<_>>());
    if balls.is_empty() {
        return 0.0;
    }
    let ends = |axis: usize| {
        let low = balls.iter().map(|ball| ball.centre[axis] - ball.radius);
        let high = balls.iter().map(|ball| ball.centre[axis] + ball.radius);
        let low = low.fold(f64::INFINITY, f64::min);
        (low, high.fold(f64::NEG_INFINITY, f64::max) - low)
    };
    let ((left, width), (front, depth)) = (ends(0), ends(1));
    let across = |side: f64| {
        let times = (side / width.min(depth)).min(MOST_TIMES);
        (times * rows.clamp(1, MOST_ROWS) as f64).ceil() as usize
    };
    let (slices, rows) = (across(width), across(depth));
    let (width, depth) = (width / slices as f64, depth / rows as f64);
    let slice = |i: usize| -> f64 {
        let x = left + (i as f64 + 0.5) * width;
        let discs: Vec<Disc> = balls.iter().filter_map(|ball| Disc::new(ball, x)).collect();
        let mut spans = Vec::with_capacity(discs.len());
        let length = |j: usize| {
            let y = front + (j as f64 + 0.5) * depth;
            spans.clear();
            spans.extend(discs.iter().filter_map(|disc| disc.span(y)));
            length(&mut spans)
        };
        (0..rows).map(length).sum()
    };
    let slices: Vec<f64> = (0..slices).into_par_iter().map(slice).collect();
    slices.iter().sum::<f64>() * width * depth
}

/// Balls in the frame of the principal axes of all of them, as if none overlapped: the longest along z, the shortest
/// along y.
fn along_own_axes(balls: &[Ball]) -> Vec<Ball> {
    let volume: f64 = balls.iter().map(|ball| ball.radius.powi(3)).sum();
    let weighted = balls
        .iter()
        .map(|ball| ball.centre.coords * ball.radius.powi(3));
    let centre = weighted.sum::<Vector3<f64>>() / volume;
    let moment = |ball: &Ball| {
        let from = ball.centre.coords - centre;
        from * from.transpose() * ball.radius.powi(3)
    };
    let moments = balls
        .iter()
        .map(moment)
        .sum::<Matrix3<f64>>()
        .symmetric_eigen();
    let axis = |index: usize| moments.eigenvectors.column(index).into_owned();
    let (longest, shortest) = (moments.eigenvalues.imax(), moments.eigenvalues.imin());
    let (z, y) = (axis(longest), axis(shortest));
    let x = y.cross(&z);
    let turned = |ball: &Ball| {
        let from = ball.centre.coords - centre;
        Ball {
            centre: Point3::new(from.dot(&x), from.dot(&y), from.dot(&z)),
            ..*ball
        }
    };
    balls.iter().map(turned).collect()
}

/// What a plane of equal x cuts out of a ball.
struct Disc {
    y: f64,
    z: f64,
    squared_radius: f64,
}

impl Disc {
    fn new(ball: &Ball, x: f64) -> Option<Self> {
        let squared_radius = ball.radius.powi(2) - (x - ball.centre.x).powi(2);
        (squared_radius > 0.0).then_some(Self {
            y: ball.centre.y,
            z: ball.centre.z,
            squared_radius,
        })
    }

    /// Where a row of equal y enters and leaves it.
    fn span(&self, y: f64) -> Option<[f64; 2]> {
        let square = self.squared_radius - (y - self.y).powi(2);
        let half = (square > 0.0).then(|| square.sqrt())?;
        Some([self.z - half, self.z + half])
    }
}

/// The length of a union of spans.
fn length(spans: &mut [[f64; 2]]) -> f64 {
    spans.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
    let (mut length, mut end) = (0.0, f64::NEG_INFINITY);
    for &[from, to] in spans.iter() {
        length += (to - from.max(end)).max(0.0);
        end = end.max(to);
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn overlapping_balls_have_the_volume_of_both_less_that_of_their_lens() {
        // Lens of radii R, r at the distance d: pi (R + r - d)² (d² + 2 d (R + r) - 3 (R - r)²) / (12 d).
        let (large, small, apart) = (1.3, 0.8, 1.1_f64);
        let lens = PI * (large + small - apart).powi(2) / (12.0 * apart)
            * (apart * apart + 2.0 * apart * (large + small) - 3.0 * (large - small).powi(2));
        let expected = 4.0 / 3.0 * PI * (large.powi(3) + small.powi(3)) - lens;
        let direction = Point3::new(0.48, 0.6, 0.64) * apart;
        let balls = [
            (Point3::origin(), large),
            (direction, small),
            (direction, 0.3),
        ]
        .map(|(centre, radius)| Ball { centre, radius });
        assert_relative_eq!(union_volume(&balls, 300), expected, max_relative = 1e-4);
        assert_relative_eq!(union_volume(&balls, 1200), expected, max_relative = 1.5e-5);
        let hollow = Ball {
            centre: Point3::new(50.0, 0.0, 0.0),
            radius: -2.0,
        };
        let with_hollow = [balls[0], balls[1], balls[2], hollow];
        assert_eq!(union_volume(&with_hollow, 300), union_volume(&balls, 300));
        assert_eq!(
            [union_volume(&[hollow], 300), union_volume(&[], 300)],
            [0.0; 2]
        );
    }

    #[test]
    fn more_rows_than_the_most_are_the_most() {
        let ball = Ball {
            centre: Point3::origin(),
            radius: 1.0,
        };
        assert_eq!(
            union_volume(&[ball], usize::MAX),
            union_volume(&[ball], MOST_ROWS)
        );
    }

    #[test]
    fn rows_and_layers_of_balls_have_the_volume_of_all_of_them() {
        let ball = |place: Vector3<f64>, radius: f64| Ball {
            centre: place.into(),
            radius,
        };
        let [x, y] = [Vector3::new(0.6, 0.48, 0.64), Vector3::new(0.0, 0.8, -0.6)];
        let row = (0..40).map(|i| ball(2.1 * f64::from(i) * x, 1.0 - 0.01 * f64::from(i)));
        let layer = (0..400).map(|i| {
            let across = x * f64::from(i / 20) + y * f64::from(i % 20);
            ball(2.1 * across, 1.0 - 0.0005 * f64::from(i))
        });
        for balls in [row.collect::<Vec<Ball>>(), layer.collect()] {
            let volume = |ball: &Ball| 4.0 / 3.0 * PI * ball.radius.powi(3);
            let expected: f64 = balls.iter().map(volume).sum();
            assert_relative_eq!(union_volume(&balls, 300), expected, max_relative = 1e-4);
        }
    }
}
