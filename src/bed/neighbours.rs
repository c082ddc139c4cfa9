//! Which grains and walls may touch before anything has moved by half a skin.

use super::body::Body;
use super::encounter::Encounter;
use super::grain::GrainKind;
use super::link::Key;
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

/// A part where the bed has it: its centre, and how far its points are from there.
type Place = (Point3<f64>, f64);

/// The bodies of an encounter, and which links it is to have.
type Listed = ((u32, Option<u32>), Vec<Key>);

impl Neighbourhood<'_> {
    /// All encounters, in order of the grains, those with walls first; what `earlier` ones know is kept.
    pub(super) fn encounters(&self, earlier: Vec<Encounter>) -> Vec<Encounter> {
        let reach = self.bodies.iter().map(|body| self.kinds[body.kind].reach);
        let size = 2.0 * reach.fold(0.0, f64::max) + self.skin;
        let cell = |point: &Point3<f64>| -> Cell {
            [0, 1, 2].map(|axis| (point[axis] / size).floor() as i64)
        };
        let mut cells: HashMap<Cell, Vec<usize>> = HashMap::new();
        for (number, body) in self.bodies.iter().enumerate() {
            cells.entry(cell(&body.position)).or_default().push(number);
        }
        let places: Vec<Vec<Place>> = self.bodies.iter().map(|body| self.places(body)).collect();
        let found: Vec<Vec<Listed>> = (0..self.bodies.len())
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
                let grains = others.into_iter().map(|other| {
                    let keys = self.between(&places[first], &places[other]);
                    ((first as u32, Some(other as u32)), keys)
                });
                let walls = self.on_walls(&self.bodies[first]);
                std::iter::once(((first as u32, None), walls))
                    .chain(grains)
                    .filter(|(_, keys)| !keys.is_empty())
                    .collect()
            })
            .collect();
        let mut earlier = earlier.into_iter().peekable();
        let encounters = found.into_iter().flatten().map(|(bodies, keys)| {
            while earlier.next_if(|old| old.bodies() < bodies).is_some() {}
            match earlier.next_if(|old| old.bodies() == bodies) {
                Some(old) => old.relisted(&keys),
                None => Encounter::new(bodies.0, bodies.1, &keys),
            }
        });
        encounters.collect()
    }

    fn places(&self, body: &Body) -> Vec<Place> {
        let kind = &self.kinds[body.kind];
        let frames = kind.placed(body.position, body.axes());
        let parts = frames.zip(&kind.parts);
        parts
            .map(|(frame, part)| (frame.centre, part.reach))
            .collect()
    }

    /// Whether two grains may come to touch; the first has the smaller number.
    fn is_near(&self, first: usize, other: usize) -> bool {
        let [one, two] = [first, other].map(|number| &self.bodies[number]);
        let reach = self.kinds[one.kind].reach + self.kinds[two.kind].reach + self.skin;
        first < other && (one.position - two.position).norm_squared() < reach * reach
    }

    /// The parts of two grains that may come to touch.
    fn between(&self, first: &[Place], other: &[Place]) -> Vec<Key> {
        let mut keys = Vec::new();
        for (part, (here, reach)) in first.iter().enumerate() {
            for (other, (there, other_reach)) in other.iter().enumerate() {
                let reach = reach + other_reach + self.skin;
                if (here - there).norm_squared() < reach * reach {
                    keys.push(Key {
                        part: part as u16,
                        other: other as u32,
                        place: 0,
                    });
                }
            }
        }
        keys
    }

    /// The parts of a grain and the walls that may come to touch.
    fn on_walls(&self, body: &Body) -> Vec<Key> {
        let kind = &self.kinds[body.kind];
        let walls = self.walls.iter().enumerate();
        let near: Vec<_> = walls
            .filter(|(_, wall)| wall.is_near(&body.position, kind.reach + self.skin))
            .collect();
        let mut keys = Vec::new();
        for part in 0..kind.parts.len() {
            for (other, wall) in &near {
                keys.extend((0..wall.places()).map(|place| Key {
                    part: part as u16,
                    other: *other as u32,
                    place,
                }));
            }
        }
        keys
    }
}
