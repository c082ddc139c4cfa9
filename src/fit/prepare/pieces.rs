//! The pieces that a cloud of points falls into, and which of them are bodies.
//!
//! Each point is linked to its nearest ones, however far these are, so that thin and uneven scans hang
//! together. What still falls apart may be one surface all the same (slices of a tomograph, two caps without
//! the band between them): none of its pieces surrounds its own middle. Bodies do, and what stands before or
//! behind one of them is none of it. A row of points that bends round is no body wherever it stands: the outermost rows of a
//! scan by lines are far from the next ones, where the surface runs along the lines' plane. A straight row is a needle.

use super::rows::is_row;
use super::strays::LEAST_STRAY;
use crate::disjoint_sets::DisjointSets;
use crate::fit::holes::largest_gap;
use crate::fit::points::neighbours::Neighbours;
use crate::scan::drawn;
use nalgebra::{Point3, Vector3};
use std::cmp::Reverse;
use std::f64::consts::PI;

/// Nearest points that each point is linked to.
const LINKS: usize = 5;

/// Points that are linked; of larger clouds, so many are drawn by a hash of their coordinates.
const MOST_LINKED: usize = 16_384;

/// Points of the smallest body ...
const LEAST_BODY: usize = 30;

/// ... and its share of all; less is dust.
const LEAST_SHARE: f64 = 0.01;

/// Half-angle, in radians, of the largest cap without points as seen from the middle of a piece that surrounds it. Of
/// one half of a ball it is 63 degrees, and of less of it more.
const OPEN: f64 = 0.8;

/// Share of the points of a piece that stand before or behind those of a body that it is no part of.
const STANDING_OFF: f64 = 0.5;

/// Share of the points of a closed surface whose neighbour in direction may be as far from it.
const LARGEST_SCATTER: f64 = 0.3;

/// Share of all points that may be dust; where more seems to be, the cloud hangs together by what is too thin to tell.
const MOST_DUST: f64 = 0.05;

/// Points of a piece.
type Cloud = Vec<Point3<f64>>;

/// The bodies of a cloud.
pub(super) struct Pieces {
    /// The points of the largest body, or a sample of them, and then those of all else.
    linked: Vec<Point3<f64>>,
    largest: usize,
    /// Number of bodies.
    pub(super) bodies: usize,
    /// Whether there is dust beside the bodies.
    pub(super) is_dusty: bool,
}

impl Pieces {
    /// Looks for bodies in a cloud.
    pub(super) fn new(points: &[Point3<f64>]) -> Self {
        let points = drawn(points, MOST_LINKED);
        let (mut large, small) = pieces(&points);
        if large.len() == 1 && small.is_empty() {
            let linked = large.remove(0);
            return Self {
                largest: linked.len(),
                linked,
                bodies: 1,
                is_dusty: false,
            };
        }
        let mut large: Vec<Piece> = large.into_iter().map(Piece::new).collect();
        large.sort_by_key(|piece| Reverse((piece.is_closed, piece.points.len())));
        let (own, others) = match large.split_first() {
            Some((first, _)) if first.is_closed => {
                let other = |piece: &Piece| {
                    first.misses(&piece.points) && !is_row(&coordinates(&piece.points))
                };
                large.iter().partition(|piece| !other(piece))
            }
            _ => (large.iter().collect(), Vec::new()),
        };
        let all_of = |pieces: Vec<&Piece>| -> Vec<Point3<f64>> {
            pieces
                .into_iter()
                .flat_map(|piece| piece.points.clone())
                .collect()
        };
        let bodies = 1 + others.len();
        let (own, mut others) = (all_of(own), all_of(others));
        let largest = Piece::new(own);
        let (dust, rest): (Vec<_>, Vec<_>) =
            small.into_iter().partition(|piece| largest.misses(piece));
        let dusty: usize = dust.iter().map(Vec::len).sum();
        let is_dusty = dusty > 0 && dusty as f64 <= MOST_DUST * points.len() as f64;
        others.extend(dust.concat());
        let mut linked = largest.points;
        linked.extend(rest.concat());
        let largest = linked.len();
        linked.extend(others);
        Self {
            linked,
            largest,
            bodies,
            is_dusty,
        }
    }

    /// The points of the largest body, in their order.
    pub(super) fn largest(&self, points: &[Point3<f64>]) -> Vec<Point3<f64>> {
        let neighbours = Neighbours::new(&coordinates(&self.linked));
        let is_of_largest = |point: &&Point3<f64>| {
            let nearest = neighbours.nearest(&point.coords, 1);
            nearest.first().is_some_and(|&at| at < self.largest)
        };
        points.iter().filter(is_of_largest).copied().collect()
    }
}

/// Points that hang together, as seen from their middle.
struct Piece {
    points: Vec<Point3<f64>>,
    middle: Point3<f64>,
    directions: Vec<Vector3<f64>>,
    neighbours: Neighbours,
    /// Whether it is a surface that surrounds its middle.
    is_closed: bool,
}

impl Piece {
    fn new(points: Vec<Point3<f64>>) -> Self {
        let first = points.first().copied().unwrap_or_default();
        let sum: Vector3<f64> = points.iter().map(|point| point - first).sum();
        let middle = first + sum / points.len().max(1) as f64;
        let directions: Vec<Vector3<f64>> = points
            .iter()
            .map(|point| direction(&(point - middle)))
            .collect();
        let mut piece = Self {
            neighbours: Neighbours::new(&directions),
            points,
            middle,
            directions,
            is_closed: false,
        };
        piece.is_closed =
            largest_gap(&piece.directions) < OPEN && piece.scatter() < LARGEST_SCATTER;
        piece
    }

    fn radius(&self, at: usize) -> f64 {
        (self.points[at] - self.middle).norm()
    }

    /// Share of the points whose neighbour in direction is much farther out or in.
    fn scatter(&self) -> f64 {
        let is_off = |own: &usize| {
            let near = self.neighbours.nearest(&self.directions[*own], 2);
            let other = near.into_iter().find(|other| other != own);
            let radius = self.radius(*own);
            other.is_some_and(|other| (self.radius(other) - radius).abs() > LEAST_STRAY * radius)
        };
        let count = self.points.len();
        (0..count).filter(is_off).count() as f64 / count as f64
    }

    /// Whether other points stand before or behind this piece, and so are none of it.
    fn misses(&self, others: &[Point3<f64>]) -> bool {
        let spacing = (4.0 * PI / self.points.len() as f64).sqrt();
        let stands_off = |other: &&Point3<f64>| {
            let ray = *other - self.middle;
            let towards = direction(&ray);
            let Some(&at) = self.neighbours.nearest(&towards, 1).first() else {
                return false;
            };
            let radius = self.radius(at);
            (self.directions[at] - towards).norm() < spacing
                && (ray.norm() - radius).abs() > LEAST_STRAY * radius
        };
        let off = others.iter().filter(stands_off).count();
        off as f64 > STANDING_OFF * others.len() as f64
    }
}

/// The pieces that are large enough for bodies, and the others.
fn pieces(points: &[Point3<f64>]) -> (Vec<Cloud>, Vec<Cloud>) {
    let places = coordinates(points);
    let neighbours = Neighbours::new(&places);
    let mut sets = DisjointSets::new(points.len());
    for (own, place) in places.iter().enumerate() {
        for other in neighbours.nearest(place, LINKS + 1) {
            sets.join(own as u32, other as u32);
        }
    }
    let mut members = vec![Vec::new(); points.len()];
    for (own, point) in points.iter().enumerate() {
        members[sets.of(own as u32) as usize].push(*point);
    }
    members.retain(|piece| !piece.is_empty());
    let least = (LEAST_SHARE * points.len() as f64).max(LEAST_BODY as f64);
    members
        .into_iter()
        .partition(|piece| piece.len() as f64 >= least)
}

/// A ray's direction; of a point at the middle, none.
fn direction(ray: &Vector3<f64>) -> Vector3<f64> {
    ray.try_normalize(0.0).unwrap_or_default()
}

fn coordinates(points: &[Point3<f64>]) -> Vec<Vector3<f64>> {
    points.iter().map(|point| point.coords).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn what_stands_before_a_body_is_another_one_but_a_row_is_none() {
        let sphere = |count: usize, radius: f64, middle: Vector3<f64>| {
            let directions = Sampling::Fibonacci.directions(count, 0).unwrap();
            let place = move |n: Vector3<f64>| Point3::from(middle + n * radius);
            directions.into_iter().map(place)
        };
        let bodies = |others: Vec<Point3<f64>>| {
            let ball = sphere(2000, 1.0, Vector3::zeros());
            Pieces::new(&ball.chain(others).collect::<Vec<_>>()).bodies
        };
        let above = Vector3::z() * 1.5;
        assert_eq!(bodies(sphere(60, 0.2, above).collect()), 2);
        let row = (0..60).map(|at| {
            let (sin, cos) = (0.1 * f64::from(at)).sin_cos();
            Point3::from(above + Vector3::new(cos, sin, 0.0) * 0.3)
        });
        assert_eq!(bodies(row.collect()), 1);
        let needle = (0..60).map(|at| Point3::from(above + Vector3::x() * 0.01 * f64::from(at)));
        assert_eq!(bodies(needle.collect()), 2);
    }
}
