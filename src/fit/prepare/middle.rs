//! Where the middle of a body is of which points are known, before its surface is.
//!
//! The mean of the points lies where there are most of them: of a body whose one half is seen a hundred times more densely halfway to
//! that half, so that other parts are seen aslant, and their points seem to stand apart. There each part of space that
//! holds points counts once, however many they are.

use nalgebra::{Point3, Vector3};

/// Parts of space along the mean distance of the points from their mean, ...
const PARTS: f64 = 2.0;

/// ... and to each side of it: what lies beyond does not count.
const REACH: usize = 8;

/// How far apart both middles may be, in mean distances, for points that are no denser on one side than on the other.
const UNEVEN: f64 = 0.2;

/// The mean of the points; where they are far denser on one side, that of the parts of space that hold them.
pub(super) fn middle(points: &[Point3<f64>]) -> Point3<f64> {
    let mean = mean(points);
    let distances = points.chunks(1024).map(|chunk| {
        let distances = chunk.iter().map(|p| (p - mean).norm());
        distances.sum::<f64>()
    });
    let distance = distances.sum::<f64>() / points.len().max(1) as f64;
    let even = mean + mean_of_parts(points, &mean, distance / PARTS);
    match (even - mean).norm() > UNEVEN * distance {
        true => even,
        false => mean,
    }
}

/// From sums that do not lose digits to a far-off origin.
fn mean(points: &[Point3<f64>]) -> Point3<f64> {
    let origin = points.first().copied().unwrap_or_else(Point3::origin);
    let sum: Vector3<f64> = points
        .chunks(1024)
        .map(|chunk| chunk.iter().map(|p| p - origin).sum::<Vector3<f64>>())
        .sum();
    origin + sum / points.len().max(1) as f64
}

/// The mean of the means of the points in cubes of this width about a place, from there; zero without any.
fn mean_of_parts(points: &[Point3<f64>], about: &Point3<f64>, width: f64) -> Vector3<f64> {
    let side = 2 * REACH;
    let mut parts = vec![(Vector3::zeros(), 0_u32); side.pow(3)];
    for point in points {
        let away = point - about;
        let place = (away / width).map(|c| (c + REACH as f64).floor());
        if place.iter().all(|c| (0.0..side as f64).contains(c)) {
            let [x, y, z] = [place.x, place.y, place.z].map(|c| c as usize);
            let (sum, count) = &mut parts[(x * side + y) * side + z];
            *sum += away;
            *count += 1;
        }
    }
    let held = parts.iter().filter(|(_, count)| *count > 0);
    let means = held.map(|(sum, count)| sum / f64::from(*count));
    let (sum, all) = means.fold((Vector3::zeros(), 0.0), |(sum, all), mean: Vector3<f64>| {
        (sum + mean, all + 1.0)
    });
    sum / f64::max(all, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    fn sphere(is_seen: impl Fn(usize, &Vector3<f64>) -> bool) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(20_000, 0).unwrap();
        let seen = directions.iter().enumerate();
        let seen = seen.filter(|(at, n)| is_seen(*at, n));
        let centre = Point3::new(1000.0, 0.0, -3.0);
        seen.map(|(_, n)| centre + n).collect()
    }

    fn off(points: &[Point3<f64>]) -> f64 {
        (middle(points) - Point3::new(1000.0, 0.0, -3.0)).norm()
    }

    #[test]
    fn points_that_are_far_denser_on_one_side_have_the_middle_of_the_body() {
        for times in [20, 100] {
            let points = sphere(|at, n| n.z > 0.0 || at % times == 0);
            assert!((mean(&points) - middle(&points)).norm() > 0.2);
            assert!(off(&points) < 0.2, "{}", off(&points));
        }
    }

    #[test]
    fn points_that_are_even_have_their_mean() {
        let points = sphere(|_, _| true);
        assert_eq!(middle(&points), mean(&points));
        assert!(off(&points) < 1e-3);
    }

    /// A stray is far from all, and counts no more than any other part.
    #[test]
    fn few_points_far_off_do_not_move_it() {
        let mut points = sphere(|at, n| n.z > 0.0 || at % 20 == 0);
        let before = middle(&points);
        points.extend([3.0, 30.0, 50.0].map(|x| Point3::new(1000.0 + x, 0.0, 0.0)));
        assert!((middle(&points) - before).norm() < 0.1);
    }

    #[test]
    fn one_point_is_its_own_middle() {
        let point = Point3::new(1.0, 2.0, 3.0);
        assert_eq!(middle(&[point]), point);
        assert_eq!(middle(&[]), Point3::origin());
    }
}
