//! Which points are near: the distance at which points of one surface are neighbours, and what hangs together by it.

use crate::disjoint_sets::DisjointSets;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::Point3;
use rayon::prelude::*;
use std::collections::HashMap;
use std::num::NonZero;

/// Side of the cells whose points are linked, as a share of the distance: its diagonal is below half of that.
const CELL: f64 = 0.25;

/// Nearest cells that each is linked to.
const LINKS: usize = 12;

/// The neighbour by whose distance the spacing of the points is told.
const SIXTH: usize = 6;

/// Points by which it is told.
const MOST_COMPARED: usize = 20_000;

/// Quantile of these distances ...
const SPARSE: f64 = 0.9;

/// ... that the points of a surface are apart at most, so many times.
const REACH: f64 = 1.8;

/// Points that are linked to their neighbours. No two of them are at the same place.
pub(super) struct Links {
    places: Vec<[f64; 3]>,
    /// How far neighbours are apart at most.
    pub(super) distance: f64,
}

impl Links {
    /// Finds the distance of distinct points; `None` of too few.
    pub(super) fn new(points: &[Point3<f64>]) -> Option<Self> {
        let places: Vec<[f64; 3]> = points.iter().map(|&point| point.into()).collect();
        if places.len() <= SIXTH {
            return None;
        }
        let tree = ImmutableKdTree::new_from_slice(&places).ok()?;
        let mut sixth = sixth_distances(&tree, &places, MOST_COMPARED);
        let at = (SPARSE * (sixth.len() - 1) as f64) as usize;
        let (_, sparse, _) = sixth.select_nth_unstable_by(at, f64::total_cmp);
        let distance = REACH * *sparse;
        Some(Self { places, distance })
    }

    /// The heaps that hang together by links of at most the distance, each in order.
    ///
    /// Points in one small cell are linked, and then the first points of the cells with their nearest ones: where points
    /// are dense along a line, the nearest ones of each point would all be on that line.
    pub(super) fn heaps(&self) -> Vec<Vec<u32>> {
        let mut sets = DisjointSets::new(self.places.len());
        let mut firsts = HashMap::new();
        let origin = self.places[0];
        for (own, place) in (0..).zip(&self.places) {
            let cell = [0, 1, 2].map(|axis| {
                let steps = (place[axis] - origin[axis]) / (CELL * self.distance);
                steps.floor() as i64
            });
            sets.join(*firsts.entry(cell).or_insert(own), own);
        }
        let mut firsts: Vec<u32> = firsts.into_values().collect();
        firsts.sort_unstable();
        let places: Vec<[f64; 3]> = firsts.iter().map(|&i| self.places[i as usize]).collect();
        let Ok(tree) = ImmutableKdTree::new_from_slice(&places) else {
            return sets.members();
        };
        let near: Vec<Vec<u32>> = places
            .par_iter()
            .map(|place| nearest(&tree, place, LINKS + 1, self.distance))
            .collect();
        for (&own, others) in firsts.iter().zip(near) {
            for other in others {
                sets.join(own, firsts[other as usize]);
            }
        }
        sets.members()
    }
}

/// The distances of the sixth nearest from some of the places of a tree, so many at most.
pub(super) fn sixth_distances(
    tree: &ImmutableKdTree<f64, 3>,
    places: &[[f64; 3]],
    most: usize,
) -> Vec<f64> {
    let step = places.len().div_ceil(most).max(1);
    let drawn: Vec<&[f64; 3]> = places.iter().step_by(step).collect();
    let drawn = drawn.par_iter();
    drawn.map(|place| sixth_distance(tree, place)).collect()
}

fn sixth_distance(tree: &ImmutableKdTree<f64, 3>, place: &[f64; 3]) -> f64 {
    const COUNT: NonZero<usize> = NonZero::new(SIXTH + 1).expect("above zero");
    let found = tree
        .query(place)
        .nearest_n::<SquaredEuclidean<f64>>(COUNT)
        .execute();
    found
        .iter()
        .fold(0.0_f64, |far, hit| far.max(hit.distance))
        .sqrt()
}

/// The nearest points within a distance, nearest first.
pub(super) fn nearest<const K: usize>(
    tree: &ImmutableKdTree<f64, K>,
    place: &[f64; K],
    count: usize,
    distance: f64,
) -> Vec<u32> {
    let Some(count) = NonZero::new(count) else {
        return Vec::new();
    };
    tree.query(place)
        .nearest_n::<SquaredEuclidean<f64>>(count)
        .within(distance * distance)
        .execute()
        .into_iter()
        .map(|hit| hit.item)
        .collect()
}

/// The distance of the nearest point.
pub(super) fn nearest_distance<const K: usize>(
    tree: &ImmutableKdTree<f64, K>,
    place: &[f64; K],
) -> f64 {
    let hit = tree
        .query(place)
        .nearest_one::<SquaredEuclidean<f64>>()
        .execute();
    hit.distance.sqrt()
}
