//! Points that a scan holds twice, a little apart: of copies that were rounded differently, or brought together by
//! registration. They share their noise, and a fit would take what is left between them for the noise of all.

use crate::disjoint_sets::DisjointSets;
use crate::fit::points::neighbours::Neighbours;
use crate::scan::drawn;
use nalgebra::{Point3, Vector3};

/// Points are twins when one is this much nearer to the other than to its [`OTHERS`]th neighbour. Of points at random every
/// 150th is.
const TWINS: f64 = 0.03;

/// The neighbour that tells how far apart points lie: there may be four copies.
const OTHERS: usize = 7;

/// A scan holds points twice where more than this share of them have twins: some do of any, and of contours of voxels more.
const MANY: f64 = 0.2;

/// Points that are looked at first.
const LOOKED_AT: usize = 500;

/// The means of twins, and all other points; `None` where few points have twins. Exact copies count once.
pub(super) fn merged(points: &[Point3<f64>]) -> Option<Vec<Point3<f64>>> {
    let points = drawn(points, points.len());
    let places: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
    let neighbours = Neighbours::new(&places);
    let twins = |place: &Vector3<f64>| -> Vec<u32> {
        let near = neighbours.nearest(place, OTHERS + 1);
        let distance = |at: usize| (places[at] - place).norm();
        let far = near.last().map_or(0.0, |&at| distance(at));
        let is_twin = |&at: &usize| distance(at) < TWINS * far && places[at] != *place;
        near.into_iter()
            .filter(is_twin)
            .map(|at| at as u32)
            .collect()
    };
    let some = drawn(&points, LOOKED_AT);
    let found = some.iter().filter(|point| !twins(&point.coords).is_empty());
    if found.count() as f64 <= MANY * some.len() as f64 {
        return None;
    }
    let mut sets = DisjointSets::new(points.len());
    for (own, place) in (0..).zip(&places) {
        twins(place)
            .into_iter()
            .for_each(|twin| sets.join(own, twin));
    }
    let mean = |set: Vec<u32>| {
        let sum: Vector3<f64> = set.iter().map(|&at| places[at as usize]).sum();
        Point3::from(sum / set.len() as f64)
    };
    Some(sets.members().into_iter().map(mean).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};

    fn bean(sampling: Sampling) -> Vec<Point3<f64>> {
        let options = SynthOptions {
            points: 1500,
            sampling,
            ..SynthOptions::clean(Body::Bean)
        };
        synthesize(&options).unwrap().points
    }

    #[test]
    fn copies_that_are_a_little_apart_are_merged_and_nothing_else() {
        for sampling in [Sampling::Random, Sampling::Fibonacci, Sampling::Rings] {
            let points = bean(sampling);
            assert_eq!(merged(&points), None);
            for copies in [2, 4] {
                let moved = |copy: usize| {
                    let by = Vector3::new(1e-4, -2e-4, 1e-4) * copy as f64;
                    points.iter().map(move |point| point + by)
                };
                let all: Vec<Point3<f64>> = (0..copies).flat_map(moved).collect();
                let found = merged(&all).unwrap();
                assert!(found.len().abs_diff(points.len()) < 30, "{}", found.len());
            }
            // A tenth of them twice.
            let again = points
                .iter()
                .step_by(10)
                .map(|point| point.map(|x| x + 1e-4));
            let all: Vec<Point3<f64>> = points.iter().copied().chain(again).collect();
            assert_eq!(merged(&all), None);
        }
    }
}
