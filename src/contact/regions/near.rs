//! Where two bodies that are apart come near each other.

use super::deepest::{DeepestPair, Placed};
use super::patch::Patch;
use crate::mesh::BoundsTree;
use nalgebra::{Point3, Unit, Vector3};
use std::collections::HashMap;

/// Places nearer than this in directions are one.
const SAME: f64 = 1e-6;

/// All pairs of points that are apart by less than `margin` and nearer than those beside them, as far as triangles of the
/// whole surfaces tell them from each other.
pub(super) fn near_places(
    bodies: &[Placed<'_>; 2],
    wholes: [&Patch; 2],
    margin: f64,
) -> Vec<DeepestPair> {
    let placed = [0, 1].map(|side| wholes[side].placed(bodies[side].pose));
    let trees = [0, 1].map(|side| {
        let bounds = wholes[side].bounds(&placed[side], 0.5 * margin);
        BoundsTree::new(bounds)
    });
    let (pairs, _) = trees[0].pairs(&trees[1]);
    let facets = [0, 1].map(|side| {
        let corners = wholes[side].triangles.iter();
        corners
            .map(|corners| Facet::new(corners.map(|i| placed[side][i as usize])))
            .collect::<Vec<_>>()
    });
    let mut found: Vec<DeepestPair> = Vec::new();
    for side in 0..2 {
        let pairs = pairs.iter().map(|pair| [pair[side], pair[1 - side]]);
        let nearest = Nearest::new(pairs, [&facets[side], &facets[1 - side]]);
        for [own, other] in nearest.least(&wholes[side].triangles) {
            let mut starts = [Vector3::zeros(); 2];
            starts[side] = wholes[side].direction(own);
            starts[1 - side] = wholes[1 - side].direction(other);
            let pair = DeepestPair::settled(bodies, starts)
                .filter(|pair| (-margin..0.0).contains(&pair.depth()))
                .filter(|pair| found.iter().all(|known| !known.is_same(pair)));
            found.extend(pair);
        }
    }
    found
}

impl DeepestPair {
    fn is_same(&self, other: &Self) -> bool {
        let off = |i: usize| (self.directions[i] - other.directions[i]).norm();
        off(0).max(off(1)) < SAME
    }
}

/// A triangle's middle and normal.
struct Facet {
    middle: Point3<f64>,
    normal: Unit<Vector3<f64>>,
}

impl Facet {
    fn new([a, b, c]: [Point3<f64>; 3]) -> Self {
        Self {
            middle: Point3::from((a.coords + b.coords + c.coords) / 3.0),
            normal: Unit::new_normalize((b - a).cross(&(c - a))),
        }
    }
}

/// Of each triangle of one surface, the nearest of the other that faces it, and how far that is above it.
struct Nearest(HashMap<u32, (f64, f64, u32)>);

impl Nearest {
    fn new(pairs: impl Iterator<Item = [u32; 2]>, [own, other]: [&[Facet]; 2]) -> Self {
        let mut nearest = HashMap::new();
        for [i, j] in pairs {
            let (one, two) = (&own[i as usize], &other[j as usize]);
            if one.normal.dot(&two.normal) >= 0.0 {
                continue;
            }
            let apart = two.middle - one.middle;
            let entry = (apart.norm_squared(), apart.dot(&one.normal), j);
            let known = nearest.entry(i).or_insert(entry);
            if entry.0 < known.0 {
                *known = entry;
            }
        }
        Self(nearest)
    }

    /// The triangles above which the other surface is lower than above all that share a corner, with its nearest.
    fn least(&self, triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
        let mut lowest: HashMap<u32, f64> = HashMap::new();
        for (&own, &(_, height, _)) in &self.0 {
            for corner in triangles[own as usize] {
                let least = lowest.entry(corner).or_insert(height);
                *least = least.min(height);
            }
        }
        let is_least = |own: u32, height: f64| {
            let corners = triangles[own as usize].iter();
            corners
                .map(|corner| lowest[corner])
                .all(|least| height <= least)
        };
        let all = self.0.iter();
        let mut least: Vec<_> = all
            .filter(|&(&own, &(_, height, _))| is_least(own, height))
            .map(|(&own, &(_, _, other))| [own, other])
            .collect();
        least.sort_unstable();
        least
    }
}
