//! Points that stand at one place over and over, as scanners write for all that they do not see.

use super::drawn::{by_coordinates, hash};
use nalgebra::Point3;
use std::collections::BTreeMap;

/// Clouds up to this size are sorted, so that all repeats are found; of larger ones those of places that stand there often.
const FEW: usize = 1 << 16;

/// Buckets that the points of larger clouds are counted in.
const BUCKETS: usize = 1 << 16;

/// A bucket of so many points more than twice the mean may hold a place that stands there often.
const OFTEN: u32 = 32;

/// More such buckets are those of coordinates that were rounded to a grid.
const MOST_BUCKETS: usize = 16;

/// Points without repeats.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Distinct {
    pub(crate) points: Vec<Point3<f64>>,
    /// The place that was repeated most, and how often it stood there.
    pub(crate) most: (Point3<f64>, usize),
}

/// Each place once; `None` if none is repeated.
pub(crate) fn distinct(points: &[Point3<f64>]) -> Option<Distinct> {
    match points.len() <= FEW {
        true => of_few(points.to_vec()),
        false => of_many(points),
    }
}

fn of_few(mut points: Vec<Point3<f64>>) -> Option<Distinct> {
    let given = points.len();
    points.sort_unstable_by(by_coordinates);
    let places = points.chunk_by(|one, other| one == other);
    let most = places.map(|own| (own[0], own.len())).rev();
    let most = most.max_by_key(|(_, times)| *times)?;
    points.dedup();
    (points.len() < given).then_some(Distinct { points, most })
}

fn of_many(points: &[Point3<f64>]) -> Option<Distinct> {
    let bucket = |point: &Point3<f64>| hash(point) as usize % BUCKETS;
    let mut counts = vec![0_u32; BUCKETS];
    for point in points {
        counts[bucket(point)] += 1;
    }
    let often = OFTEN + 2 * (points.len() / BUCKETS) as u32;
    let full = counts.iter().filter(|&&count| count > often).count();
    if full == 0 || full > MOST_BUCKETS {
        return None;
    }
    let is_full = |point: &Point3<f64>| counts[bucket(point)] > often;
    let key = |point: &Point3<f64>| <[f64; 3]>::from(*point).map(|c| (c + 0.0).to_bits());
    let mut times: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    for point in points.iter().filter(|point| is_full(point)) {
        *times.entry(key(point)).or_default() += 1;
    }
    let (place, &most) = times.iter().max_by_key(|(_, times)| **times)?;
    let place = Point3::from(place.map(f64::from_bits));
    let mut seen = BTreeMap::new();
    let is_first = |point: &&Point3<f64>| !is_full(point) || seen.insert(key(point), ()).is_none();
    let kept: Vec<Point3<f64>> = points.iter().filter(is_first).copied().collect();
    (kept.len() < points.len()).then_some(Distinct {
        points: kept,
        most: (place, most),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(count: usize) -> Vec<Point3<f64>> {
        let at = |i: usize| Point3::new(i as f64, (i as f64).sin(), 1.0 - i as f64);
        (0..count).map(at).collect()
    }

    #[test]
    fn a_place_of_many_rows_counts_once_and_is_told() {
        for (count, times) in [(100, 2), (100, 70), (FEW + 1, 1000)] {
            assert_eq!(distinct(&grid(count)), None);
            let mut points = grid(count);
            points.splice(7..7, vec![Point3::origin(); times]);
            // Zeros of either sign are one place.
            points[7] = Point3::new(-0.0, 0.0, -0.0);
            let found = distinct(&points).unwrap();
            assert_eq!(found.points.len(), count + 1);
            assert_eq!(found.most, (Point3::origin(), times));
        }
    }

    #[test]
    fn many_points_on_a_grid_are_let_be() {
        let twice = [grid(FEW), grid(FEW)].concat();
        assert_eq!(distinct(&twice), None);
    }
}
