//! Which medial balls make a clump: a greedy cover of the surface.

use crate::measure::{Ball, EvenPlace};
use rayon::prelude::*;
use std::collections::BinaryHeap;

/// Share of the surface that is covered; the rest is left to the fit of the spheres.
const COVERED: f64 = 0.995;

/// Steps of the search for how near a cover comes to the surface.
const HALVINGS: usize = 12;

/// The range of that, relative to the radius.
const NEAREST: f64 = 1e-4;
const FARTHEST: f64 = 0.4;

/// Candidates, and the distances of places from them.
pub(super) struct Cover {
    places: usize,
    candidates: Vec<Ball>,
    /// Of each candidate, the places that the largest tolerance takes in, and their distances, nearest first.
    near: Vec<Vec<(f32, u32)>>,
}

impl Cover {
    pub(super) fn new(places: &[EvenPlace], candidates: Vec<Ball>) -> Self {
        let near = |ball: &Ball| {
            let distance = |at: &EvenPlace| (at.place - ball.centre.coords).norm() - ball.radius;
            let distances = places.iter().map(distance).zip(0..);
            let mut near: Vec<(f32, u32)> = distances
                .filter(|(distance, _)| *distance <= FARTHEST)
                .map(|(distance, index)| (distance as f32, index))
                .collect();
            near.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            near
        };
        Self {
            places: places.len(),
            near: candidates.par_iter().map(near).collect(),
            candidates,
        }
    }

    /// The radius of the largest candidate.
    pub(super) fn largest(&self) -> f64 {
        let radii = self.candidates.iter().map(|ball| ball.radius);
        radii.fold(0.0, f64::max)
    }

    /// At most so many balls that come as near to the surface as so many can.
    pub(super) fn of_count(&self, count: usize) -> Vec<Ball> {
        let (mut low, mut high) = (NEAREST, FARTHEST);
        let mut best = self.greedy(high, count).0;
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            let (found, is_covered) = self.greedy(middle, count);
            match is_covered {
                true => (high, best) = (middle, found),
                false => low = middle,
            }
        }
        // Below some tolerance each ball covers its own foot only, and no number that is at hand is enough.
        match best.len() < count {
            true => self.greedy(low, count).0,
            false => best,
        }
    }

    /// Balls, each of which takes in most of what is left of the surface, until it is covered or there are so many;
    /// and whether it is covered. Radii are larger by half the tolerance, and a place is covered within half of it.
    fn greedy(&self, tolerance: f64, count: usize) -> (Vec<Ball>, bool) {
        let covered = |index: usize| {
            let near = &self.near[index];
            let within = near.partition_point(|(distance, _)| f64::from(*distance) <= tolerance);
            near[..within].iter().map(|(_, place)| *place as usize)
        };
        // What a ball takes in falls as others are taken, so an old figure that is beaten need not be renewed.
        let mut gains: BinaryHeap<(usize, usize)> = (0..self.near.len())
            .map(|index| (covered(index).len(), index))
            .collect();
        let mut is_left = vec![true; self.places];
        let most_left = ((1.0 - COVERED) * self.places as f64) as usize;
        let (mut left, mut chosen) = (self.places, Vec::new());
        while let Some((_, index)) = gains.pop() {
            let gain = covered(index).filter(|place| is_left[*place]).count();
            if gains.peek().is_some_and(|next| next.0 > gain) {
                gains.push((gain, index));
                continue;
            }
            if gain == 0 || left <= most_left || chosen.len() == count {
                break;
            }
            covered(index).for_each(|place| is_left[place] = false);
            left -= gain;
            chosen.push(Ball {
                radius: self.candidates[index].radius + tolerance / 2.0,
                ..self.candidates[index]
            });
        }
        (chosen, left <= most_left)
    }
}
