//! How far a scan is from a surface, between its points too.

use crate::measure::feet;
use crate::model::Surface;
use crate::scan::Scan;
use crate::spread::upper_median;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::num::NonZero;

/// Points that a value between them rests on, and one more that no longer counts.
const NEAR: NonZero<usize> = NonZero::new(7).unwrap();

/// The most points of a scan that are taken: then every second, every third, and so on.
const MOST_POINTS: usize = 100_000;

/// The most points, those within faces included.
const MOST_WITH_FACES: usize = 4 * MOST_POINTS;

/// Faces are large from this angle on, seen from the centre, in radians: then a fit takes points all over them too.
const LARGE: f64 = 0.25;

/// Large faces are given points at so many steps along the longest side of the scan.
const STEPS: f64 = 40.0;

/// Beyond so many typical distances from the nearest point, and so large a share of the scan's size, nothing is known.
const FAR: f64 = 2.0;
const FAR_SHARE: f64 = 0.05;

/// Signed distances of a scan's points from a surface: positive outside, so scan minus surface.
#[derive(Debug)]
pub struct ScanDeviation {
    points: Vec<Point3<f64>>,
    distances: Vec<f64>,
    tree: Option<ImmutableKdTree<f64, 3>>,
    reach: f64,
}

impl ScanDeviation {
    /// Of the points of a scan, and of points all over its faces where these are large. Of more than 100 000 points
    /// every second, every third ... is taken.
    pub fn new(grain: &(impl Surface + ?Sized), scan: &Scan) -> Self {
        let (size, centre) = (size(scan.points()), grain.frame().centre);
        let all = scan.points().len() + scan.triangles().len();
        let stride = all.div_ceil(MOST_POINTS).max(1);
        let mut points: Vec<Point3<f64>> = scan.points().iter().copied().step_by(stride).collect();
        for corners in scan.triangles().iter().step_by(stride) {
            let corners = corners.map(|corner| scan.points()[corner as usize]);
            if points.len() > MOST_WITH_FACES {
                break;
            }
            if is_large(&corners.map(|corner| corner - centre)) {
                add_within(&corners, size / STEPS, &mut points);
            }
        }
        let feet = feet(grain, &points);
        let places: Vec<[f64; 3]> = points.iter().map(|point| point.coords.into()).collect();
        let mut found = Self {
            points,
            distances: feet.iter().map(|foot| foot.distance).collect(),
            tree: ImmutableKdTree::new_from_slice(&places).ok(),
            reach: f64::INFINITY,
        };
        found.reach = (FAR * found.typical_distance()).max(FAR_SHARE * size);
        found
    }

    /// The points and their distances.
    pub fn points(&self) -> impl Iterator<Item = (&Point3<f64>, f64)> {
        self.points.iter().zip(self.distances.iter().copied())
    }

    /// The distance of the scan at a place of the surface: interpolated between the six nearest points by their inverse
    /// distances (Franke, Nielson 1980). Not a number where the scan has no points near by.
    pub fn at(&self, place: &Point3<f64>) -> f64 {
        let near = self.near(place);
        let last = near.last().map_or(0.0, |(_, distance)| *distance);
        let Some((nearest, distance)) = near.first().copied() else {
            return f64::NAN;
        };
        if distance > self.reach {
            return f64::NAN;
        }
        let (mut sum, mut weights) = (0.0, 0.0);
        for (at, distance) in &near {
            let weight = ((last - distance) / (last * distance)).powi(2);
            sum += weight * self.distances[*at];
            weights += weight;
        }
        match sum.is_finite() && weights > 0.0 && weights.is_finite() {
            true => sum / weights,
            // On a point, or all as far.
            false => self.distances[nearest],
        }
    }

    /// The points nearest to a place, and how far they are.
    fn near(&self, place: &Point3<f64>) -> Vec<(usize, f64)> {
        let query: [f64; 3] = place.coords.into();
        let found = self.tree.as_ref().map(|tree| {
            let hits = tree
                .query(&query)
                .nearest_n::<SquaredEuclidean<f64>>(NEAR)
                .execute();
            let near = hits
                .into_iter()
                .map(|hit| (hit.item as usize, hit.distance.sqrt()));
            let mut near: Vec<(usize, f64)> = near.collect();
            near.sort_by(|one, other| one.1.total_cmp(&other.1));
            near
        });
        found.unwrap_or_default()
    }

    /// The median distance of a point from the sixth nearest other one.
    fn typical_distance(&self) -> f64 {
        let last = |point: &Point3<f64>| self.near(point).last().map_or(0.0, |(_, far)| *far);
        let mut distances: Vec<f64> = self.points.par_iter().map(last).collect();
        upper_median(&mut distances).unwrap_or(0.0)
    }
}

/// The longest side of the box round some points.
fn size(points: &[Point3<f64>]) -> f64 {
    let side = |axis: usize| {
        let along = points.iter().map(|point| point[axis]);
        let (low, high) = along.fold((f64::MAX, f64::MIN), |(low, high), at| {
            (low.min(at), high.max(at))
        });
        high - low
    };
    side(0).max(side(1)).max(side(2)).max(0.0)
}

/// Whether two of three corners, seen from the centre, are far apart.
fn is_large([a, b, c]: &[Vector3<f64>; 3]) -> bool {
    a.angle(b).max(b.angle(c)).max(c.angle(a)) > LARGE
}

/// Adds points within a triangle, so that none is much farther than a step from the next.
fn add_within([a, b, c]: &[Point3<f64>; 3], step: f64, points: &mut Vec<Point3<f64>>) {
    let longest = (b - a).norm().max((c - a).norm()).max((c - b).norm());
    let parts = match step > 0.0 {
        true => (longest / step).min(STEPS).round() as usize,
        false => 0,
    };
    for i in 1..parts {
        for j in 1..parts - i {
            let (s, t) = (i as f64 / parts as f64, j as f64 / parts as f64);
            points.push(a + (b - a) * s + (c - a) * t);
        }
    }
}
