//! The volume of a union of balls.

use crate::measure::Ball;
use rayon::prelude::*;

/// The volume of a union of balls, by rows: each row along z of a grid of `rows` x `rows`, one at least, is cut exactly, and what
/// several balls hold counts once. Zero of no balls; those of no radius, or one below zero, hold nothing.
///
/// Error, relative to the volume: that of a sum over the rims of the balls, below 1e-4 from 300 rows on.
pub fn union_volume(balls: &[Ball], rows: usize) -> f64 {
    let balls = balls.iter().filter(|ball| ball.radius > 0.0);
    let balls: Vec<&Ball> = balls.collect();
    if balls.is_empty() {
        return 0.0;
    }
    let rows = rows.max(1);
    let grid = |axis: usize| {
        let low = balls.iter().map(|ball| ball.centre[axis] - ball.radius);
        let high = balls.iter().map(|ball| ball.centre[axis] + ball.radius);
        let low = low.fold(f64::INFINITY, f64::min);
        let step = (high.fold(f64::NEG_INFINITY, f64::max) - low) / rows as f64;
        (low, step)
    };
    let ((left, width), (front, depth)) = (grid(0), grid(1));
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
    let slices: Vec<f64> = (0..rows).into_par_iter().map(slice).collect();
    slices.iter().sum::<f64>() * width * depth
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
    use nalgebra::Point3;
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
}
