//! Where two surfaces are farthest in each other, by the triangles round what they share.
//!
//! Surfaces with bumps have many pairs of points whose line is normal to both. The depth is the largest distance of a point
//! of one in the other from that, so pairs are looked for from the corners that have it. Where bodies lie deep in each other
//! a point may be farther from the one opposite it than from another side: there the pair is the one between the ends of
//! what they share.

use super::clip::Crossing;
use super::deepest::{DeepestPair, Placed};
use super::patch::Patch;
use crate::mesh::normals;
use crate::scan::by_coordinates;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::{Point3, Vector3};
use std::collections::BTreeSet;

/// Places that are looked at, at most, and how far they are apart, as a share of the size of what is shared.
const PLACES: usize = 12;
const APART: f64 = 0.08;

/// Share of the largest distance that a place has at least.
const FAR: f64 = 0.85;

/// The depth of a pair may differ from the distance that its place has by so large a share, over the number of corners that
/// lie inside, and by [`LEAST_SLACK`] at least: a pair that differs by more is one of another place, or slants through both
/// bodies.
const SLACK: f64 = 8.0;
const LEAST_SLACK: f64 = 0.02;

/// The depth of a pair between the ends of what is shared may exceed the distance of the corners there by so large a share.
const OF_ENDS: f64 = 0.1;

/// The places where two surfaces are farthest in each other.
pub(super) struct Farthest {
    /// Of any corner of one in the other.
    pub(super) distance: f64,
    /// By how much that may be off, as a share.
    slack: f64,
    /// That of the farthest first.
    places: Vec<Place>,
    /// Corners of each surface in the other body, with their directions.
    inside: [Vec<(Point3<f64>, Vector3<f64>)>; 2],
}

/// A corner of one surface in the other, and the corner of that which is nearest to it.
struct Place {
    distance: f64,
    at: Point3<f64>,
    directions: [Vector3<f64>; 2],
}

impl Farthest {
    /// Of some triangles of both surfaces, moved.
    pub(super) fn new(
        patches: &[Patch; 2],
        triangles: &[Vec<u32>; 2],
        crossing: &Crossing,
        placed: &[Vec<Point3<f64>>; 2],
    ) -> Self {
        let sides = [0, 1].map(|side| Side::new(&patches[side], &triangles[side], &placed[side]));
        let mut places = Vec::new();
        let mut inside = [Vec::new(), Vec::new()];
        for side in 0..2 {
            let is_inside = |corner: &&Corner| crossing.inside[side][corner.number as usize];
            for corner in sides[side].corners.iter().filter(is_inside) {
                inside[side].push((corner.point, corner.direction));
                let Some(nearest) = sides[1 - side].nearest(&corner.point) else {
                    continue;
                };
                let mut directions = [corner.direction, nearest.direction];
                directions.rotate_left(side);
                places.push(Place {
                    distance: nearest.normal.dot(&(nearest.point - corner.point)),
                    at: corner.point,
                    directions,
                });
            }
        }
        places.sort_by(|one, other| {
            let by_distance = other.distance.total_cmp(&one.distance);
            by_distance.then_with(|| by_coordinates(&one.at, &other.at))
        });
        Self {
            distance: places.first().map_or(0.0, |place| place.distance),
            slack: (SLACK / places.len() as f64).max(LEAST_SLACK),
            places: apart(places),
            inside,
        }
    }

    /// Of the pairs of points near these places whose line is normal to both surfaces, and from which the surfaces part in
    /// all directions, the deepest. `area`: of the first body's surface in the second.
    pub(super) fn deepest(
        &self,
        bodies: &[Placed<'_>; 2],
        area: &Vector3<f64>,
    ) -> Option<DeepestPair> {
        let mut deepest: Option<DeepestPair> = None;
        for place in &self.places {
            let most = (1.0 + self.slack) * place.distance;
            let best = deepest.as_ref().map_or(0.0, DeepestPair::depth);
            if best >= most {
                break;
            }
            let known = best.max((1.0 - self.slack) * place.distance)..most;
            let pair = DeepestPair::settled(bodies, place.directions)
                .filter(|pair| pair.normal.dot(area) > 0.0 && known.contains(&pair.depth()))
                .filter(DeepestPair::parts);
            deepest = pair.or(deepest);
        }
        deepest.or_else(|| self.between_ends(bodies, area))
    }

    /// The pair between the ends of what is shared, along its own normal.
    fn between_ends(&self, bodies: &[Placed<'_>; 2], area: &Vector3<f64>) -> Option<DeepestPair> {
        let ends = |along: &Vector3<f64>| {
            let end = |side: usize, along: Vector3<f64>| {
                let height = |corner: &&(Point3<f64>, Vector3<f64>)| along.dot(&corner.0.coords);
                let corners = self.inside[side].iter();
                corners.max_by(|one, other| height(one).total_cmp(&height(other)))
            };
            Some([end(0, *along)?, end(1, -along)?])
        };
        let starts = ends(area)?.map(|(_, direction)| *direction);
        let pair = DeepestPair::settled(bodies, starts).filter(DeepestPair::parts)?;
        let [(first, _), (second, _)] = ends(&pair.normal)?;
        let distance = (first - second).dot(&pair.normal);
        let is_between = (1.0 - LEAST_SLACK..1.0 + OF_ENDS).contains(&(pair.depth() / distance));
        (is_between && pair.normal.dot(area) > 0.0).then_some(pair)
    }
}

/// The farthest of some places, in their order, that are apart.
fn apart(places: Vec<Place>) -> Vec<Place> {
    let Some(first) = places.first() else {
        return places;
    };
    let (least, start) = (FAR * first.distance, (first.at, first.at));
    let (low, high) = places.iter().fold(start, |(low, high), place| {
        (low.inf(&place.at), high.sup(&place.at))
    });
    let reach = APART * (high - low).norm();
    let mut kept: Vec<Place> = Vec::new();
    for place in places {
        if kept.len() == PLACES || place.distance < least {
            break;
        }
        if kept
            .iter()
            .all(|other| (other.at - place.at).norm() > reach)
        {
            kept.push(place);
        }
    }
    kept
}

/// A corner and the surface's outward unit normal there.
struct Corner {
    number: u32,
    direction: Vector3<f64>,
    point: Point3<f64>,
    normal: Vector3<f64>,
}

/// The corners of one surface's triangles.
struct Side {
    corners: Vec<Corner>,
    tree: Option<ImmutableKdTree<f64, 3>>,
}

impl Side {
    fn new(patch: &Patch, triangles: &[u32], placed: &[Point3<f64>]) -> Self {
        let own = triangles.iter().map(|&at| patch.triangles[at as usize]);
        let own: Vec<[u32; 3]> = own.collect();
        let normals = normals(placed, &own);
        let numbers: BTreeSet<u32> = own.as_flattened().iter().copied().collect();
        let corner = |number: u32| Corner {
            number,
            direction: patch.directions[number as usize],
            point: placed[number as usize],
            normal: normals[number as usize],
        };
        let corners: Vec<Corner> = numbers.into_iter().map(corner).collect();
        let places: Vec<[f64; 3]> = corners.iter().map(|corner| corner.point.into()).collect();
        Self {
            tree: ImmutableKdTree::new_from_slice(&places)
                .ok()
                .filter(|_| !places.is_empty()),
            corners,
        }
    }

    fn nearest(&self, point: &Point3<f64>) -> Option<&Corner> {
        let query: [f64; 3] = (*point).into();
        let nearest = self.tree.as_ref()?.query(&query);
        let hit = nearest.nearest_one::<SquaredEuclidean<f64>>().execute();
        self.corners.get(hit.item as usize)
    }
}
