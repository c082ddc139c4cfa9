//! Grains that touch, cut apart.

use super::dust::LEAST_POINTS;
use super::neck::{Neck, settle};
use super::one_body::has_neck;
use super::outline::Outline;
use crate::sphere::cube_grid;
use crate::spread::covariance;
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// Cuts of one heap, at most so many one after the other.
const MOST_CUTS: usize = 12;

/// RMS distance of the points of a grain from its outline over its radius, at most. Of kernels it is below .06, of bodies
/// with edges below .04, of three balls or more that touch above .1, as of bent bodies.
const FOLLOWED: f64 = 0.1;

/// The same of smooth grains at most, among which no broad neck is looked for: of two that touch it is above .028.
const SMOOTH: f64 = 0.015;

/// Points of a part over those of the largest of its heap, at most, where it is no grain. Of pairs on trays it is .42 and more.
const SLIVER: f64 = 0.1;

/// Directions from the middle of a grain in which no points lie this near, in radians: of half a ball there are some of 63 degrees.
const UNSEEN: f64 = 45.0 * PI / 180.0;

/// Cells along an edge of the cube of these directions.
const LOOKED_AT: usize = 4;

/// What is done at the necks of heaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Necks {
    Cut,
    Keep,
}

/// Points of one grain.
pub(super) struct Part {
    pub(super) points: Vec<u32>,
    pub(super) may_touch: bool,
}

/// What a heap was cut into, and how wide the widest of the necks was beside the narrower of its sides.
pub(super) struct Parts {
    pub(super) parts: Vec<Part>,
    pub(super) neck: f64,
}

/// Cuts a heap at its necks, one after the other.
pub(super) fn cut(places: &[Point3<f64>], heap: Vec<u32>, distance: f64, necks: Necks) -> Parts {
    let of = |points: &[u32]| -> Vec<Point3<f64>> {
        points.iter().map(|&i| places[i as usize]).collect()
    };
    let most_cuts = match necks {
        Necks::Cut => MOST_CUTS,
        Necks::Keep => 0,
    };
    let (mut whole, mut waists, mut cuts) = (Vec::new(), Vec::new(), Vec::new());
    let mut left = vec![heap];
    while let Some(points) = left.pop() {
        let own = of(&points);
        let neck = Neck::find(&own, distance).filter(Neck::is_waist);
        let has_waist = neck.is_some();
        let is_last = whole.len() + left.len() >= most_cuts;
        let cut = neck.filter(|_| !is_last).and_then(|neck| {
            let sides = grains(&points, &neck.cut(&own)?)?;
            Some((neck, sides))
        });
        match cut {
            Some((neck, sides)) => {
                cuts.push(neck);
                left.extend(sides);
            }
            None => {
                whole.push(points);
                waists.push(has_waist);
            }
        }
    }
    // The first of several cuts was made by outlines of grains that still touched.
    if cuts.len() > 1 {
        settle(places, &mut whole, &cuts);
    }
    let narrow = cuts.len();
    let mut parts = Vec::with_capacity(whole.len());
    let mut left: Vec<(Vec<u32>, bool)> = whole.into_iter().zip(waists).collect();
    while let Some((points, has_waist)) = left.pop() {
        let own = of(&points);
        let missed = Outline::misses(&own);
        let neck = (missed > SMOOTH)
            .then(|| Neck::by_outlines(&own, distance))
            .flatten();
        let may_cut = narrow == 0 && cuts.len() < most_cuts;
        let cut = neck.as_ref().filter(|_| may_cut && is_seen_round(&own));
        let sides = cut.and_then(|neck| grains(&points, &neck.beyond(&own)));
        match (neck, sides) {
            (Some(neck), Some(sides)) => {
                cuts.push(neck);
                left.extend(sides.map(|side| (side, false)));
            }
            (neck, _) => parts.push(Part {
                may_touch: has_waist || neck.is_some() || missed > FOLLOWED || has_neck(&own),
                points,
            }),
        }
    }
    if narrow > 0 && !are_likely(&parts) {
        let mut points: Vec<u32> = parts.into_iter().flat_map(|part| part.points).collect();
        points.sort_unstable();
        let uncut = Part {
            points,
            may_touch: true,
        };
        return Parts {
            parts: vec![uncut],
            neck: 0.0,
        };
    }
    Parts {
        parts,
        neck: cuts.iter().map(Neck::width).fold(0.0, f64::max),
    }
}

/// Whether parts may be grains, and not those of one that is bent: its arms end in slivers where they are cut, and look bent
/// themselves.
fn are_likely(parts: &[Part]) -> bool {
    let sizes = || parts.iter().map(|part| part.points.len());
    let [least, most] = [sizes().min(), sizes().max()].map(Option::unwrap_or_default);
    let doubtful = parts.iter().filter(|part| part.may_touch).count();
    parts.len() == 1 || (least as f64 > SLIVER * most as f64 && 2 * doubtful < parts.len())
}

/// Whether points lie all round their middle: an outline follows half of a bent grain, or of one with a waist, as well as a grain.
fn is_seen_round(points: &[Point3<f64>]) -> bool {
    let Some(first) = points.first() else {
        return false;
    };
    let (middle, _) = covariance(points.iter().map(|point| point - first));
    let rays = points
        .iter()
        .filter_map(|point| (point - first - middle).try_normalize(0.0));
    let rays: Vec<Vector3<f64>> = rays.collect();
    let is_seen = |n: &Vector3<f64>| rays.iter().any(|ray| ray.dot(n) > UNSEEN.cos());
    cube_grid(LOOKED_AT).0.iter().all(is_seen)
}

/// The points before and beyond a neck, if they are enough for grains.
fn grains(points: &[u32], beyond: &[bool]) -> Option<[Vec<u32>; 2]> {
    let sides = [false, true].map(|side| {
        let own = points
            .iter()
            .zip(beyond)
            .filter(|(_, other)| **other == side);
        own.map(|(point, _)| *point).collect::<Vec<u32>>()
    });
    let are_grains = sides.iter().all(|side| side.len() >= LEAST_POINTS);
    are_grains.then_some(sides)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn half_a_grain_is_not_seen_all_round() {
        let directions = Sampling::Fibonacci.directions(2000, 0).unwrap();
        for semi_axes in [[1.0, 1.0, 1.0], [20.0, 12.0, 3.0], [2.0, 9.0, 2.0]] {
            let places = directions
                .iter()
                .map(|n| n.component_mul(&Vector3::from(semi_axes)));
            let mut points: Vec<Point3<f64>> = places.map(Point3::from).collect();
            assert!(is_seen_round(&points), "{semi_axes:?}");
            points.retain(|point| point.z > 0.0);
            assert!(!is_seen_round(&points), "{semi_axes:?}");
        }
    }
}
