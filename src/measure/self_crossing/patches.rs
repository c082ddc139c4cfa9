//! The patches of a surface between the curves in which it goes through itself.
//!
//! On each patch the surface winds round the places below so many times, and round those above once less: one and none on
//! the outside of a body. All other patches are false: their triangles add to the area what is no outside, and to the volume
//! what is counted twice, or the wrong way round. The triangles that cross are false in part.

use super::{SelfCrossing, cone};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, winding_number};
use crate::scan::each_edge;
use nalgebra::{Point3, Vector3};
use std::cmp::Reverse;
use std::collections::HashMap;

/// Figures are told to six digits: what moves them less is not told.
const TOLD: f64 = 5e-7;

/// Patches that are looked at, the largest first.
const MOST_PROBED: usize = 32;

/// How far above and below a triangle a place is looked at, as a share of the length of a square of its area; and, at most,
/// of half the longest side of the body, which is about one.
const ASIDE: f64 = 1e-3;
const FARTHEST_ASIDE: f64 = 1e-6;

/// What a triangle adds to sums over the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Standing {
    /// What it should.
    Sound,
    /// Nothing that belongs there.
    False,
    /// Either, or parts of both.
    Unclear,
}

/// How the triangles of a surface stand.
pub(super) struct Patches<'a> {
    mesh: &'a Mesh,
    standing: Vec<Standing>,
    /// Triangles that cross or touch.
    pairs: Vec<[usize; 2]>,
}

/// Triangles that are not sound and hang together, as far as they move the figures.
struct Place {
    middle: Point3<f64>,
    area: f64,
    volume: f64,
}

impl<'a> Patches<'a> {
    /// Of a surface wound outwards, whose pairs of triangles that cross, and of those that only touch, are known.
    pub(super) fn new(mesh: &'a Mesh, crossed: &[[usize; 2]], touching: &[[usize; 2]]) -> Self {
        let pairs = [crossed, touching].concat();
        let mut coarse = joined(mesh, crossed);
        let mut patches = match touching.is_empty() {
            true => coarse.clone().members(),
            false => joined(mesh, &pairs).members(),
        };
        let mut standing = vec![Standing::Sound; mesh.triangles.len()];
        if patches.len() > 1 {
            let area = |patch: &Vec<u32>| -> f64 { patch.iter().map(|&at| area(mesh, at)).sum() };
            patches.sort_by_cached_key(|patch| Reverse(area(patch).to_bits()));
            let (large, small) = patches.split_at(patches.len().min(MOST_PROBED));
            let mut known: HashMap<u32, Standing> = HashMap::new();
            for patch in large {
                let own = of_patch(mesh, patch);
                let of_all = known.entry(coarse.of(patch[0])).or_insert(own);
                if *of_all != own {
                    *of_all = Standing::Unclear;
                }
                patch.iter().for_each(|&at| standing[at as usize] = own);
            }
            // What only touches stands as all round it.
            for patch in small {
                let own = known.get(&coarse.of(patch[0]));
                let own = own.copied().unwrap_or(Standing::Unclear);
                patch.iter().for_each(|&at| standing[at as usize] = own);
            }
        }
        for &triangle in crossed.as_flattened() {
            standing[triangle] = Standing::Unclear;
        }
        Self {
            mesh,
            standing,
            pairs,
        }
    }

    /// What that makes of the figures, where the sum over all triangles is `solid`; `None` if all is sound.
    pub(super) fn off(&self, solid: f64) -> Option<SelfCrossing> {
        let places = self.places();
        let all = 0..self.mesh.triangles.len() as u32;
        let whole: f64 = all.map(|at| area(self.mesh, at)).sum();
        let off = |place: &Place| place.area / whole + place.volume / solid;
        let worst = places.iter().max_by(|a, b| off(a).total_cmp(&off(b)))?;
        let area: f64 = places.iter().map(|place| place.area).sum();
        let volume: f64 = places.iter().map(|place| place.volume).sum();
        let found = SelfCrossing {
            place: worst.middle,
            places: places.len(),
            area: area / (whole - area).max(0.0),
            volume: volume / solid,
        };
        // Written so that NaN, of a body without a volume, is told.
        (!(found.area < TOLD && found.volume < TOLD)).then_some(found)
    }

    fn places(&self) -> Vec<Place> {
        let is_off = |at: usize| self.standing[at] != Standing::Sound;
        let off: Vec<u32> = (0..self.standing.len())
            .filter(|&at| is_off(at))
            .map(|at| at as u32)
            .collect();
        let mut sets = DisjointSets::new(self.mesh.vertices.len());
        let first = |at: u32| self.mesh.triangles[at as usize][0];
        for &at in &off {
            let [a, b, c] = self.mesh.triangles[at as usize];
            sets.join(a, b);
            sets.join(a, c);
        }
        for &[one, other] in &self.pairs {
            if is_off(one) && is_off(other) {
                sets.join(first(one as u32), first(other as u32));
            }
        }
        let mut by_set: Vec<(u32, u32)> = off.iter().map(|&at| (sets.of(first(at)), at)).collect();
        by_set.sort_unstable();
        by_set
            .chunk_by(|one, other| one.0 == other.0)
            .map(|set| self.place(set.iter().map(|(_, at)| *at)))
            .collect()
    }

    fn place(&self, triangles: impl ExactSizeIterator<Item = u32> + Clone) -> Place {
        let count = triangles.len() as f64;
        let middles = triangles.clone().map(|at| middle(self.mesh, at));
        let from = middles.sum::<Vector3<f64>>() / count;
        let (mut off, mut unclear, mut sum) = (0.0_f64, 0.0, 0.0);
        for at in triangles {
            let cone = self.cone(at, &from);
            match self.standing[at as usize] {
                Standing::Unclear => unclear += cone.abs(),
                _ => off += cone,
            }
            sum += area(self.mesh, at);
        }
        Place {
            middle: Point3::from(from),
            area: sum,
            volume: off.abs() + unclear,
        }
    }

    fn cone(&self, triangle: u32, from: &Vector3<f64>) -> f64 {
        let [a, b, c] = corners(self.mesh, triangle).map(|corner| corner - from);
        cone(a, b, c)
    }
}

fn corners(mesh: &Mesh, triangle: u32) -> [Vector3<f64>; 3] {
    mesh.triangles[triangle as usize].map(|corner| mesh.vertices[corner as usize].coords)
}

fn middle(mesh: &Mesh, triangle: u32) -> Vector3<f64> {
    let [a, b, c] = corners(mesh, triangle);
    (a + b + c) / 3.0
}

/// Twice the area of a triangle, along its normal.
fn normal(mesh: &Mesh, triangle: u32) -> Vector3<f64> {
    let [a, b, c] = corners(mesh, triangle);
    (b - a).cross(&(c - a))
}

fn area(mesh: &Mesh, triangle: u32) -> f64 {
    normal(mesh, triangle).norm() / 2.0
}

/// How a patch stands, by the places beside its largest triangle. One of both sides will do, for where a body touches itself
/// there is nothing on the other.
fn of_patch(mesh: &Mesh, patch: &[u32]) -> Standing {
    let by_area = |one: &&u32, other: &&u32| area(mesh, **one).total_cmp(&area(mesh, **other));
    let largest = *patch.iter().max_by(by_area).unwrap_or(&patch[0]);
    let size = area(mesh, largest).sqrt();
    let Some(out) = normal(mesh, largest).try_normalize(0.0) else {
        return Standing::Unclear;
    };
    let aside = out * (ASIDE * size).min(FARTHEST_ASIDE);
    let times = |place: Vector3<f64>| winding_number(mesh, &Point3::from(place)).round();
    let middle = middle(mesh, largest);
    match times(middle - aside) == 1.0 || times(middle + aside) == 0.0 {
        true => Standing::Sound,
        false => Standing::False,
    }
}

/// Triangles that are joined over edges of two triangles, but those that are cut, which are alone.
fn joined(mesh: &Mesh, cut: &[[usize; 2]]) -> DisjointSets {
    let mut is_cut = vec![false; mesh.triangles.len()];
    for &triangle in cut.as_flattened() {
        is_cut[triangle] = true;
    }
    let mut sets = DisjointSets::new(mesh.triangles.len());
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        if let Some([one, other]) = edge.pair()
            && !is_cut[one]
            && !is_cut[other]
        {
            sets.join(one as u32, other as u32);
        }
    });
    sets
}
