//! The border of what a closed mesh covers, seen from one side: of any shape, exactly.
//!
//! The triangles that are seen from in front cover it all, some places more than once. What is not an edge between two of them
//! is their border: closed lines, which go round each place as often as it is covered. So the border of the union of all
//! triangles is that of what these few lines go round, and this is left to the crate `i_overlay`, on integers of 64 bits.
//!
//! On straight walls chance tells which of many steep triangles are in front, and lines round thousands of slivers cross each
//! other. These are united two by two, and so on, of which each step leaves only the outermost.

use super::slits::without_slits;
use crate::measure::outline::signed_area;
use crate::predicates::orient2d;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;
use nalgebra::{Vector2, Vector3};

/// Triangles are seen edge-on that show no larger share of their area, and take no part as long as what is left hangs together.
const EDGE_ON: f64 = 1e-7;

/// So few border edges are united at once, ...
const FEW: usize = 10_000;

/// ... as are those which are no more than so many times those of what is not a sliver.
const MOSTLY_SLIVERS: usize = 2;

/// Of a sliver less than this share of its area is seen, and more of what is no sliver: both hold those between, lest rounding part them.
const SLIVER: f64 = 0.5;
const BROAD: f64 = 0.3;

/// Parts that lie apart are specks, by rounding, where they cover no more than this share of the largest.
const SPECK: f64 = 1e-9;

/// Slits of the border that are narrower go: coordinates of 32 bits are rounded to less, as far off as a hundred sizes.
const SLIT: f64 = 1e-5;

/// Corners from end to end.
type Line = Vec<[f64; 2]>;

/// What a mesh covers.
pub(super) struct Silhouette {
    /// The outer border, counter-clockwise, without slits that are narrower than rounding leaves them.
    pub border: Vec<Vector2<f64>>,
    /// The area of the holes inside of it.
    pub holes: f64,
}

impl Silhouette {
    /// That of the triangles of a closed mesh, seen along the third of the coordinates, which are from -1 to 1: those that are wound
    /// counter-clockwise cover all. If several parts lie apart, of the largest; `None` if they cover nothing. All triangles must name
    /// places that exist.
    pub(super) fn new(places: &[Vector3<f64>], triangles: &[[u32; 3]]) -> Option<Self> {
        let shown: Vec<f64> = triangles.iter().map(|t| share_shown(places, t)).collect();
        let edges_of = |least| border_edges(places.len(), triangles, &shown, least);
        let lines_of = |edges| closed_lines(places, edges);
        let edges = edges_of(EDGE_ON);
        let broad = (edges.len() > FEW).then(|| edges_of(BROAD));
        let of_slivers = broad.filter(|broad| edges.len() > MOSTLY_SLIVERS * broad.len());
        let mut parts = covered(&match of_slivers {
            Some(broad) => [lines_of(broad), united(&slivers(places, triangles, &shown))].concat(),
            None => lines_of(edges),
        });
        // Walls seen edge-on, which are narrower than rounding, may lie between parts.
        if !hang_together(&parts) {
            parts = covered(&lines_of(edges_of(0.0)));
        }
        let outer = |part: &Vec<Line>| part.first().map_or(0.0, area);
        let parts = parts.into_iter();
        let largest = parts.max_by(|one, other| outer(one).total_cmp(&outer(other)))?;
        let mut lines = largest.into_iter();
        Some(Self {
            border: without_slits(corners(&lines.next()?), SLIT),
            holes: -lines.map(|line| area(&line)).sum::<f64>(),
        })
    }
}

/// What closed lines go round at least once: of each part the outer border, and those of its holes.
fn covered(lines: &[Line]) -> Vec<Vec<Line>> {
    lines.simplify_shape_as::<i64>(FillRule::NonZero)
}

fn corners(line: &Line) -> Vec<Vector2<f64>> {
    line.iter().map(|&corner| corner.into()).collect()
}

fn area(line: &Line) -> f64 {
    signed_area(&corners(line))
}

/// Whether all parts but one are specks.
fn hang_together(parts: &[Vec<Line>]) -> bool {
    let areas = parts.iter().filter_map(|part| part.first()).map(area);
    let (largest, sum) = areas.fold((0.0_f64, 0.0), |(largest, sum), area| {
        (largest.max(area), sum + area)
    });
    sum - largest <= SPECK * largest
}

/// The slivers in front, by where they lie round the origin.
fn slivers(places: &[Vector3<f64>], triangles: &[[u32; 3]], shown: &[f64]) -> Vec<[[f64; 2]; 3]> {
    let mut slivers: Vec<(f64, [[f64; 2]; 3])> = triangles
        .iter()
        .zip(shown)
        .filter(|(_, shown)| (f64::MIN_POSITIVE..SLIVER).contains(*shown))
        .map(|(corners, _)| {
            let corners = corners.map(|corner| places[corner as usize].xy());
            let middle: Vector2<f64> = corners.iter().sum();
            (middle.y.atan2(middle.x), corners.map(Into::into))
        })
        .collect();
    slivers.sort_by(|one, other| one.0.total_cmp(&other.0));
    slivers.into_iter().map(|(_, corners)| corners).collect()
}

/// The border of what triangles cover, each wound counter-clockwise.
fn united(triangles: &[[[f64; 2]; 3]]) -> Vec<Line> {
    if triangles.len() < 2 {
        return triangles.iter().map(|corners| corners.to_vec()).collect();
    }
    let (some, others) = triangles.split_at(triangles.len() / 2);
    let (some, others) = rayon::join(|| united(some), || united(others));
    let parts = covered(&[some, others].concat());
    parts.into_iter().flatten().collect()
}

/// The share of its area that a triangle shows: above zero where it is seen to be wound counter-clockwise.
fn share_shown(places: &[Vector3<f64>], corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| places[corner as usize]);
    let twice_its_area = (b - a).cross(&(c - a)).norm();
    orient2d([a, b, c].map(|corner| corner.xy())) / twice_its_area.max(f64::MIN_POSITIVE)
}

/// The edges of the triangles that are in front, from end to end, without those that two of them walk in opposite senses: these
/// are most, and those between corners that no other triangle has are not even looked at. In front is what shows more than this
/// share of its area.
fn border_edges(places: usize, triangles: &[[u32; 3]], shown: &[f64], least: f64) -> Vec<[u32; 2]> {
    let (mut in_front, mut behind) = (Vec::new(), Vec::new());
    for (corners, shown) in triangles.iter().zip(shown) {
        let side = if *shown > least {
            &mut in_front
        } else {
            &mut behind
        };
        side.push(corners);
    }
    let mut is_border = vec![false; places];
    for corner in behind.into_iter().flatten() {
        is_border[*corner as usize] = true;
    }
    // The ends in order, and whether they are walked that way.
    let mut walked: Vec<(u32, u32, bool)> = in_front
        .into_iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .filter(|ends| ends.iter().all(|&end| is_border[end as usize]))
        .map(|[from, to]| (from.min(to), from.max(to), from < to))
        .collect();
    walked.sort_unstable();
    let same =
        |one: &(u32, u32, bool), other: &(u32, u32, bool)| (one.0, one.1) == (other.0, other.1);
    let mut edges = Vec::new();
    for walks in walked.chunk_by(same) {
        let back = walks.partition_point(|walk| !walk.2);
        let forth = walks.len() - back;
        let (low, high, _) = walks[0];
        let (times, edge) = match forth > back {
            true => (forth - back, [low, high]),
            false => (back - forth, [high, low]),
        };
        edges.extend(std::iter::repeat_n(edge, times));
    }
    edges
}

/// Closed lines through edges, each of which is walked once: at every place as many end as begin.
fn closed_lines(places: &[Vector3<f64>], mut edges: Vec<[u32; 2]>) -> Vec<Line> {
    edges.sort_unstable();
    let first = |from: u32| edges.partition_point(|edge| edge[0] < from);
    let mut is_walked = vec![false; edges.len()];
    let mut lines = Vec::new();
    for start in 0..edges.len() {
        let (mut line, mut at) = (Vec::new(), start);
        while !is_walked[at] {
            is_walked[at] = true;
            let [from, to] = edges[at];
            line.push(places[from as usize].xy().into());
            let onward = (first(to)..edges.len()).take_while(|&next| edges[next][0] == to);
            at = onward
                .into_iter()
                .find(|&next| !is_walked[next])
                .unwrap_or(start);
        }
        if line.len() > 2 {
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;

    /// Seen along its axis, a cylinder whose corners lie at other angles in each of its rings: its walls are chords of one
    /// circle, all within each other's sagitta.
    #[test]
    fn slivers_of_walls_are_united_to_what_all_triangles_cover() {
        let (rings, corners) = (80_u32, 100_u32);
        let place = |ring: u32, corner: u32| {
            let angle = TAU * (f64::from(corner) + 0.37 * f64::from(ring)) / f64::from(corners);
            Vector3::new(angle.cos(), angle.sin(), 0.1 * f64::from(ring))
        };
        let mut places: Vec<Vector3<f64>> = (0..rings)
            .flat_map(|ring| (0..corners).map(move |corner| place(ring, corner)))
            .collect();
        let [bottom, top] = [0, rings - 1];
        places.push(Vector3::zeros());
        places.push(Vector3::new(0.0, 0.0, 0.1 * f64::from(top)));
        let at = |ring: u32, corner: u32| ring * corners + corner % corners;
        let middle = rings * corners;
        let wall = |ring: u32, corner: u32| {
            let [a, b] = [at(ring, corner), at(ring, corner + 1)];
            let [c, d] = [at(ring + 1, corner), at(ring + 1, corner + 1)];
            [[a, b, d], [a, d, c]]
        };
        let walls = (bottom..top).flat_map(|ring| (0..corners).flat_map(move |n| wall(ring, n)));
        let lids = (0..corners).flat_map(|n| {
            let [under, over] = [bottom, top].map(|ring| [at(ring, n), at(ring, n + 1)]);
            [[under[1], under[0], middle], [over[0], over[1], middle + 1]]
        });
        let triangles: Vec<[u32; 3]> = walls.chain(lids).collect();
        let shown: Vec<f64> = triangles.iter().map(|t| share_shown(&places, t)).collect();
        let edges_of = |least| border_edges(places.len(), &triangles, &shown, least);
        let (edges, broad) = (edges_of(EDGE_ON), edges_of(BROAD));
        assert!(edges.len() > FEW && edges.len() > MOSTLY_SLIVERS * broad.len());
        let all = covered(&closed_lines(&places, edges));
        let all: f64 = all.iter().flatten().map(area).sum();
        let found = Silhouette::new(&places, &triangles).unwrap();
        assert_relative_eq!(signed_area(&found.border), all, max_relative = 1e-9);
        assert!(found.holes.abs() < 1e-12);
        // More than any of the polygons of 100 corners, of which it is made.
        assert!(all > 1.0002 * 50.0 * (TAU / 100.0).sin(), "{all}");
    }
}
