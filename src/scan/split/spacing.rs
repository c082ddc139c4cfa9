//! How far apart the points of a cloud are where they are not even: of rings and lines that of the rows.

use nalgebra::Point3;
use std::collections::HashSet;

/// Cubes of twice the width that hold points are a quarter as many where points cover a surface, and half as many where
/// they lie on lines: covered is what has so many times as many.
const COVERED: f64 = 2.7;

/// Fewer cubes do not tell.
const FEWEST: usize = 40;

/// From one width to the next.
const STEP: f64 = 1.5;

/// The width, `distance` at least, from which on cubes that hold points cover a surface; `distance` where none does.
pub(super) fn covering(points: &[Point3<f64>], distance: f64) -> f64 {
    let cubes = |width: f64| {
        let cube = |point: &Point3<f64>| point.coords.map(|x| (x / width).floor() as i64);
        points.iter().map(cube).collect::<HashSet<_>>().len()
    };
    let mut width = distance;
    loop {
        let [fine, coarse] = [width, 2.0 * width].map(cubes);
        if coarse < FEWEST {
            return distance;
        }
        if fine as f64 >= COVERED * coarse as f64 {
            return width;
        }
        width *= STEP;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn rows_are_farther_apart_than_their_points() {
        let even = Sampling::Fibonacci.directions(2000, 0).unwrap();
        let even: Vec<Point3<f64>> = even.into_iter().map(Point3::from).collect();
        assert_eq!(covering(&even, 0.15), 0.15);
        let rings = (0..12).flat_map(|ring| {
            let (sin, cos) = (PI * (f64::from(ring) + 0.5) / 12.0).sin_cos();
            (0..300).map(move |at| {
                let azimuth = TAU * f64::from(at) / 300.0;
                Point3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos)
            })
        });
        let rings: Vec<Point3<f64>> = rings.collect();
        let found = covering(&rings, 0.05);
        assert!((0.15..0.4).contains(&found), "{found}");
    }
}
