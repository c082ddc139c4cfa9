//! Whether points that stand apart from their neighbours are outliers, or a surface of their own: the table under a grain, the
//! wall of a hole, a second body.
//!
//! Outliers lie anywhere, and so far from each other; the points of a surface have others of it about them.

use super::islands::LARGEST;
use crate::fit::points::neighbours::Neighbours;
use crate::spread::upper_median;
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

/// The most points that may be a tip, and the share of a cloud that is as many.
const TIP: usize = 6;
const TIP_SHARE: f64 = 0.005;

/// A tip is within so many times what is near of the others; and of a surface more points are within it of each other than an island
/// has.
const BEYOND: f64 = 2.0;

/// Points lie in one direction within this angle, in radians.
const ONE_DIRECTION: f64 = 0.15;

/// The same of what is between two of them: in a group they lie in any direction from each other.
const ALONG: f64 = 0.3;

/// Number of points that do so by chance, below which they belong together.
const BY_CHANCE: f64 = 0.05;

/// The number of points of a cloud, other than those that were kept, that are in company of each other.
pub(super) fn together(points: &[Point3<f64>], kept: &[Point3<f64>]) -> usize {
    let near = Places::new(points.iter()).near();
    let apart = Places::new(not_kept(points, kept));
    let is_in_company = |own: &&Vector3<f64>| {
        apart.distance(own, COMPANY) <= near && apart.distance(own, LARGEST) <= BEYOND * near
    };
    apart.places.iter().filter(is_in_company).count()
}

/// Of a few points that were not kept, those that are near another of them and not far from the others: they may be a tip of the grain.
pub(super) fn neighbouring(points: &[Point3<f64>], kept: &[Point3<f64>]) -> Vec<Point3<f64>> {
    if !may_be_tip(points, kept) {
        return Vec::new();
    }
    let apart = Places::new(not_kept(points, kept));
    let kept = Places::new(kept.iter());
    let near = kept.near();
    let is_near_one = |own: &&Vector3<f64>| apart.distance(own, 1) <= near;
    let is_of_tip = |own: &&Vector3<f64>| kept.distance(own, 0) <= BEYOND * near;
    let found = apart.places.iter().filter(is_near_one).filter(is_of_tip);
    found.map(|place| Point3::from(*place)).collect()
}

/// Whether so few points were not kept that some of them may be a tip.
fn may_be_tip(points: &[Point3<f64>], kept: &[Point3<f64>]) -> bool {
    let most = TIP.max((TIP_SHARE * points.len() as f64) as usize);
    points.len() - kept.len() <= most
}

/// Of a few points that were not kept, those that lie in one direction from a centre with others of them that are not near, as points
/// strewn about a grain do by chance one time in twenty: they may be an awn.
pub(super) fn in_one_direction(
    points: &[Point3<f64>],
    kept: &[Point3<f64>],
    centre: &Point3<f64>,
) -> Vec<Point3<f64>> {
    if !may_be_tip(points, kept) {
        return Vec::new();
    }
    let near = Places::new(kept.iter()).near();
    let apart: Vec<&Point3<f64>> = not_kept(points, kept).collect();
    let rays = apart.iter().map(|&point| point - centre);
    let directions: Vec<_> = rays.map(|ray| ray.try_normalize(0.0)).collect();
    // Of others that lie anywhere, so many are expected within the angle.
    let expected = apart.len() as f64 * (1.0 - ONE_DIRECTION.cos()) / 2.0;
    let is_of_several = |(own, direction): &(&&Point3<f64>, &Option<Vector3<f64>>)| {
        let Some(direction) = direction else {
            return false;
        };
        let others = apart.iter().zip(&directions);
        let beside = others.filter(|&(other, towards)| {
            let is_in_line = |towards: &Vector3<f64>| direction.dot(towards) > ONE_DIRECTION.cos();
            let between = *other - **own;
            let is_beyond = between.norm() > near
                && between.dot(direction).abs() > ALONG.cos() * between.norm();
            is_beyond && towards.as_ref().is_some_and(is_in_line)
        });
        let beside = beside.count();
        let as_many: f64 = (1..=beside).map(|k| expected / k as f64).product();
        beside > 0 && apart.len() as f64 * as_many < BY_CHANCE
    };
    let found = apart.iter().zip(&directions).filter(is_of_several);
    found.map(|(point, _)| **point).collect()
}

fn not_kept<'a>(
    points: &'a [Point3<f64>],
    kept: &[Point3<f64>],
) -> impl Iterator<Item = &'a Point3<f64>> {
    let key = |point: &Point3<f64>| [point.x, point.y, point.z].map(f64::to_bits);
    let mut known: Vec<_> = kept.iter().map(key).collect();
    known.sort_unstable();
    let is_apart = move |point: &&Point3<f64>| known.binary_search(&key(point)).is_err();
    points.iter().filter(is_apart)
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

    /// What is near in a cloud of these places.
    fn near(&self) -> f64 {
        let asked = self.places.iter();
        let asked = asked.step_by(self.places.len().div_ceil(ASKED));
        let mut spacings: Vec<f64> = asked.map(|own| self.distance(own, NEIGHBOUR)).collect();
        NEAR * upper_median(&mut spacings).unwrap_or(0.0)
    }

    /// How far a place is from so distant a neighbour, of which the first, if it is one of these, is itself; infinite if there are fewer.
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
    fn a_few_points_near_each_other_may_be_a_tip() {
        let kept = ellipsoid(1000);
        let tip = [[3.3, 0.0, 0.0], [3.2, 0.05, 0.0]].map(Point3::from);
        let alone = Point3::new(0.0, 4.0, 0.0);
        let mut cloud = kept.clone();
        cloud.extend(tip);
        cloud.push(alone);
        assert_eq!(neighbouring(&cloud, &kept), tip);
        let group = [[0.0, 0.0, 4.0], [0.05, 0.0, 4.0]].map(Point3::from);
        cloud.extend(group);
        assert_eq!(neighbouring(&cloud, &kept), tip);
        cloud.truncate(cloud.len() - 2);
        let table = (0..50).map(|i| Point3::new(0.01 * f64::from(i), 0.0, -2.0));
        cloud.extend(table);
        assert_eq!(neighbouring(&cloud, &kept), []);
    }

    #[test]
    fn few_points_in_one_direction_are_an_awn_and_strewn_ones_are_none() {
        let kept = ellipsoid(6000);
        let centre = Point3::origin();
        let awn = [[4.0, 0.0, 0.1], [5.0, 0.2, 0.0], [6.5, 0.0, -0.2]].map(Point3::from);
        let strewn = [[0.0, 4.0, 0.0], [-5.0, 0.0, 1.0], [0.0, 0.0, -3.0]].map(Point3::from);
        let cloud = [kept.as_slice(), &strewn[..1], &awn, &strewn[1..]].concat();
        assert_eq!(in_one_direction(&cloud, &kept, &centre), awn);
        let group = [[4.0, 0.0, 0.0], [4.2, 0.3, 0.0], [4.0, -0.3, 0.1]].map(Point3::from);
        let grouped = [kept.as_slice(), &group].concat();
        assert_eq!(in_one_direction(&grouped, &kept, &centre), []);
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let far = Uniform::new(-9.0, 9.0).unwrap();
        let strewn = (0..30).map(|_| Point3::from([(); 3].map(|()| far.sample(&mut random))));
        let many = [kept.as_slice(), &strewn.collect::<Vec<_>>()].concat();
        assert_eq!(in_one_direction(&many, &kept, &centre), []);
        assert_eq!(in_one_direction(&kept, &kept, &centre), []);
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
