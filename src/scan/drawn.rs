//! A few of many points, the same whatever their order.

use crate::mesh::Bounds;
use nalgebra::Point3;
use std::cmp::Ordering;

/// Parts of space along the longest side of a cloud, ...
const PARTS: usize = 16;

/// ... and points of one over those of most from where on they are too dense.
const DENSE: usize = 8;

/// The distinct points or, of more than some number, about so many of them, drawn by a hash of their coordinates; sorted.
pub(crate) fn drawn(points: &[Point3<f64>], most: usize) -> Vec<Point3<f64>> {
    let drawn = indices_drawn(points, most).into_iter();
    drawn.map(|at| points[at]).collect()
}

/// The same, fewer of those that lie in parts of space with far more points than most.
pub(super) fn evenly_drawn(points: &[Point3<f64>], most: usize) -> Vec<Point3<f64>> {
    let parts = parts(points);
    let mut counts = vec![0_usize; PARTS.pow(3)];
    for &part in &parts {
        counts[part] += 1;
    }
    let mut sorted: Vec<usize> = counts.iter().copied().filter(|&count| count > 0).collect();
    sorted.sort_unstable();
    let Some(usual) = sorted.get(sorted.len() / 2) else {
        return Vec::new();
    };
    let dense = DENSE * usual;
    let even: usize = sorted.iter().map(|&count| count.min(dense)).sum();
    let step = even.div_ceil(most).max(1);
    let steps = parts
        .iter()
        .map(|&part| step * counts[part].div_ceil(dense));
    let drawn = indices_by_steps(points, steps).into_iter();
    drawn.map(|at| points[at]).collect()
}

/// The part of space that each point lies in, of cubes along the longest side of the box round all.
fn parts(points: &[Point3<f64>]) -> Vec<usize> {
    let [low, high] = Bounds::new(points.iter().copied(), 0.0).corners();
    let size = (high - low).max();
    let part = |point: &Point3<f64>| {
        let place = (point.coords - low) / size * PARTS as f64;
        let place = place.map(|c| (c as usize).min(PARTS - 1));
        (place.x * PARTS + place.y) * PARTS + place.z
    };
    points.iter().map(part).collect()
}

/// As [`drawn`], the indices of the points.
pub(crate) fn indices_drawn(points: &[Point3<f64>], most: usize) -> Vec<usize> {
    let step = points.len().div_ceil(most).max(1);
    indices_by_steps(points, points.iter().map(|_| step))
}

/// Of each point one in so many like it is drawn.
fn indices_by_steps(points: &[Point3<f64>], steps: impl Iterator<Item = usize>) -> Vec<usize> {
    let is_drawn = |(at, step): (usize, usize)| {
        let is_drawn = hash(&points[at]).is_multiple_of(step as u64);
        is_drawn.then_some(at)
    };
    let mut drawn: Vec<usize> = steps.enumerate().filter_map(is_drawn).collect();
    drawn.sort_unstable_by(|&one, &other| by_coordinates(&points[one], &points[other]));
    drawn.dedup_by(|one, other| points[*one] == points[*other]);
    drawn
}

/// By x, then y, then z.
pub(crate) fn by_coordinates(one: &Point3<f64>, other: &Point3<f64>) -> Ordering {
    let compare = |axis: usize| (one[axis] + 0.0).total_cmp(&(other[axis] + 0.0));
    compare(0).then_with(|| compare(1)).then_with(|| compare(2))
}

/// A number that coordinates decide, and that looks random.
pub(super) fn hash(point: &Point3<f64>) -> u64 {
    let mix = |hash: u64, c: &f64| {
        let mixed = (hash ^ (c + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 29)
    };
    let mixed = point.iter().fold(0, mix);
    mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    fn sphere(points: usize) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(points, 0).unwrap();
        directions.into_iter().map(Point3::from).collect()
    }

    #[test]
    fn of_a_patch_that_is_far_denser_few_more_points_are_drawn_than_elsewhere() {
        let is_within = |point: &Point3<f64>| point.z > 0.9;
        let mut points = sphere(2000);
        points.retain(|point| !is_within(point));
        points.extend(sphere(400_000).into_iter().filter(is_within));
        let share = |drawn: Vec<Point3<f64>>| {
            drawn.iter().filter(|point| is_within(point)).count() as f64 / drawn.len() as f64
        };
        assert!(share(drawn(&points, 4000)) > 0.9);
        let even = share(evenly_drawn(&points, 4000));
        assert!((0.05..0.4).contains(&even), "{even}");
    }

    #[test]
    fn of_even_points_the_same_are_drawn() {
        let points = sphere(9000);
        assert_eq!(evenly_drawn(&points, 4000), drawn(&points, 4000));
        assert!(evenly_drawn(&[], 4000).is_empty());
        let one = vec![Point3::new(1.0, 2.0, 3.0); 3];
        assert_eq!(evenly_drawn(&one, 4000), drawn(&one, 4000));
    }
}
