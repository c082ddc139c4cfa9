//! Whether points that stand apart from their neighbours are outliers, or a surface of their own: the table under a grain, the
//! wall of a hole, a second body.
//!
//! Outliers lie anywhere, and so far from each other; the points of a surface have others of it about them.

use crate::fit::neighbours::Neighbours;
use crate::spread::median;
use nalgebra::{Point3, Vector3};

/// A point is in company where so many others that stand apart are near it: of outliers strewn about a grain, a tenth as many as
/// its points, one in two hundred.
const COMPANY: usize = 5;

/// Near is within so many times the typical distance of a point's sixth neighbour.
const NEAR: f64 = 2.0;

/// The neighbour whose distance tells how densely points lie.
const NEIGHBOUR: usize = 6;

/// Points whose neighbours are asked for.
const ASKED: usize = 1000;

/// The number of points of a cloud, other than those that were kept, that are in company of each other.
pub(super) fn together(points: &[Point3<f64>], kept: &[Point3<f64>]) -> usize {
    let key = |point: &Point3<f64>| [point.x, point.y, point.z].map(f64::to_bits);
    let mut known: Vec<_> = kept.iter().map(key).collect();
    known.sort_unstable();
    let is_apart = |point: &&Point3<f64>| known.binary_search(&key(point)).is_err();
    let all = Places::new(points.iter());
    let apart = Places::new(points.iter().filter(is_apart));

    let asked = all.places.iter().step_by(all.places.len().div_ceil(ASKED));
    let mut spacings: Vec<f64> = asked.map(|own| all.distance(own, NEIGHBOUR)).collect();
    let near = NEAR * median(&mut spacings).unwrap_or(0.0);
    let is_in_company = |own: &&Vector3<f64>| apart.distance(own, COMPANY) <= near;
    apart.places.iter().filter(is_in_company).count()
}

struct Places {
    places: Vec<Vector3<f64>>,
    neighbours: Neighbours,
}

impl Places {
    fn new<'a>(points: impl Iterator<Item = &'a Point3<f64>>) -> Self {
        let places: Vec<_> = points.map(|point| point.coords).collect();
        Self {
            neighbours: Neighbours::new(&places),
            places,
        }
    }

    /// How far one of the places is from so distant a neighbour; infinite if there are fewer.
    fn distance(&self, own: &Vector3<f64>, neighbour: usize) -> f64 {
        let near = self.neighbours.nearest(own, neighbour + 1);
        let last = near.get(neighbour).map(|&at| self.places[at]);
        last.map_or(f64::INFINITY, |place| (place - own).norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, Uniform};

    fn ellipsoid(points: usize) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(points, 0).unwrap();
        let scaled = directions
            .iter()
            .map(|n| n.component_mul(&Vector3::new(3.0, 2.0, 1.5)));
        scaled.map(Point3::from).collect()
    }

    #[test]
    fn outliers_strewn_about_a_grain_are_not_together() {
        let shift = Uniform::new(1.1, 1.6).unwrap();
        for points in [600, 1538, 6146] {
            let mut cloud = ellipsoid(points);
            let mut random = ChaCha8Rng::seed_from_u64(2);
            for point in cloud.iter_mut().step_by(10) {
                *point *= shift.sample(&mut random);
            }
            let kept: Vec<_> = (0..points)
                .filter(|i| i % 10 > 0)
                .map(|i| cloud[i])
                .collect();
            let found = together(&cloud, &kept);
            assert!((found as f64) < 0.004 * points as f64, "{points}: {found}");
        }
    }

    #[test]
    fn points_of_a_table_are_together() {
        let mut cloud = ellipsoid(3000);
        let kept = cloud.clone();
        let across = |i: i32| f64::from(i) * 0.2 - 4.0;
        let table =
            (0..40).flat_map(|i| (0..40).map(move |j| Point3::new(across(i), across(j), -1.5)));
        cloud.extend(table);
        assert!(together(&cloud, &kept) > 1500);
        assert_eq!(together(&kept, &kept), 0);
    }
}
