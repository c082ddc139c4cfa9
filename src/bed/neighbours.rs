//! Which grains and walls may touch before anything has moved by half a skin.

use super::body::Body;
use super::grain::GrainKind;
use super::link::{Key, Link};
use super::wall::Wall;
use nalgebra::Point3;
use rayon::prelude::*;
use std::collections::HashMap;

/// How much farther than touching pairs are listed, as a share of the mean radius of the grains.
const SKIN: f64 = 0.25;

/// Grains that a thread takes at least.
const LEAST_GRAINS: usize = 64;

/// What the list is made of.
pub(super) struct Neighbourhood<'a> {
    pub(super) kinds: &'a [GrainKind],
    pub(super) walls: &'a [Wall],
    pub(super) bodies: &'a [Body],
    pub(super) skin: f64,
}

/// The skin of a bed of these grains, in metres.
pub(super) fn skin(kinds: &[GrainKind], bodies: &[Body]) -> f64 {
    let sum: f64 = bodies.iter().map(|body| kinds[body.kind].radius).sum();
    SKIN * sum / bodies.len().max(1) as f64
}

type Cell = [i64; 3];

impl Neighbourhood<'_> {
    /// The links of grains, in order of their keys; what `old` links know is kept.
    pub(super) fn grain_links(&self, old: &[Link]) -> Vec<Link> {
        let reach = self.bodies.iter().map(|body| self.kinds[body.kind].reach);
        let size = 2.0 * reach.fold(0.0, f64::max) + self.skin;
        let cell = |point: &Point3<f64>| -> Cell {
            [0, 1, 2].map(|axis| (point[axis] / size).floor() as i64)
        };
        let mut cells: HashMap<Cell, Vec<usize>> = HashMap::new();
        for (number, body) in self.bodies.iter().enumerate() {
            cells.entry(cell(&body.position)).or_default().push(number);
        }
        let keys: Vec<Vec<Key>> = (0..self.bodies.len())
            .into_par_iter()
            .with_min_len(LEAST_GRAINS)
            .map(|first| {
                let own = cell(&self.bodies[first].position);
                let mut others: Vec<usize> = Vec::new();
                for at in 0..27_i64 {
                    let beside = [at % 3 - 1, at / 3 % 3 - 1, at / 9 - 1];
                    let near = [0, 1, 2].map(|axis| own[axis].saturating_add(beside[axis]));
                    let found = cells.get(&near).into_iter().flatten();
                    others.extend(found.filter(|&&other| self.is_near(first, other)));
                }
                others.sort_unstable();
                let keys = others.iter().flat_map(|&other| self.parts(first, other));
                keys.collect()
            })
            .collect();
        with_memory(keys.concat(), old)
    }

    /// The links of grains and walls, likewise.
    pub(super) fn wall_links(&self, old: &[Link]) -> Vec<Link> {
        let keys: Vec<Vec<Key>> = (0..self.bodies.len())
            .into_par_iter()
            .with_min_len(LEAST_GRAINS)
            .map(|first| {
                let body = &self.bodies[first];
                let kind = &self.kinds[body.kind];
                let mut keys = Vec::new();
                for (other, wall) in self.walls.iter().enumerate() {
                    if !wall.is_near(&body.position, kind.reach + self.skin) {
                        continue;
                    }
                    for part in 0..kind.parts.len() {
                        keys.extend((0..wall.places()).map(|other_part| Key {
                            first: first as u32,
                            other: other as u32,
                            part: part as u16,
                            other_part,
                        }));
                    }
                }
                keys
            })
            .collect();
        with_memory(keys.concat(), old)
    }

    /// Whether two grains may come to touch; the first has the smaller number.
    fn is_near(&self, first: usize, other: usize) -> bool {
        let [one, two] = [first, other].map(|number| &self.bodies[number]);
        let reach = self.kinds[one.kind].reach + self.kinds[two.kind].reach + self.skin;
        first < other && (one.position - two.position).norm_squared() < reach * reach
    }

    /// The parts of two grains that may come to touch.
    fn parts(&self, first: usize, other: usize) -> Vec<Key> {
        let placed = [first, other].map(|number| {
            let body = &self.bodies[number];
            let kind = &self.kinds[body.kind];
            let frames = kind.placed(body.position, body.axes());
            let parts = frames.zip(&kind.parts);
            let parts = parts.map(|(frame, part)| (frame.centre, part.reach));
            parts.collect::<Vec<_>>()
        });
        let mut keys = Vec::new();
        for (part, (here, reach)) in placed[0].iter().enumerate() {
            for (other_part, (there, other_reach)) in placed[1].iter().enumerate() {
                if (here - there).norm() < reach + other_reach + self.skin {
                    keys.push(Key {
                        first: first as u32,
                        other: other as u32,
                        part: part as u16,
                        other_part: other_part as u16,
                    });
                }
            }
        }
        keys
    }
}

/// Links of these keys, with what old links of the same keys know; both are in order.
fn with_memory(keys: Vec<Key>, old: &[Link]) -> Vec<Link> {
    let mut old = old.iter().peekable();
    let link = |key: Key| {
        while old.next_if(|link| link.key < key).is_some() {}
        let known = old.next_if(|link| link.key == key);
        known.cloned().unwrap_or_else(|| Link::new(key))
    };
    keys.into_iter().map(link).collect()
}
