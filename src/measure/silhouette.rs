//! The border of what a closed mesh covers, seen from one side: of any shape, exactly.
//!
//! The triangles that are seen from in front cover it all, some places more than once. What is not an edge between two of them
//! is their border: closed lines, which go round each place as often as it is covered. So the border of the union of all
//! triangles is that of what these few lines go round, and this is left to the crate `i_overlay`, on integers of 64 bits.

use super::outline::signed_area;
use super::slits::without_slits;
use crate::predicates::orient2d;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;
use nalgebra::Vector2;

/// Triangles are seen edge-on that cover no larger share of the square over their longest side, and take no part: on flat walls
/// chance tells which of them are in front, and lines round thousands of slivers cross each other.
const EDGE_ON: f64 = 1e-7;

/// Slits of the border that are narrower go: coordinates of 32 bits are rounded to less, as far off as a hundred sizes.
const SLIT: f64 = 1e-5;

/// What a mesh covers.
pub(super) struct Silhouette {
    /// The outer border, counter-clockwise, without slits that are narrower than rounding leaves them.
    pub border: Vec<Vector2<f64>>,
    /// The area of the holes inside of it.
    pub holes: f64,
}

impl Silhouette {
    /// That of the triangles of a closed mesh over places of the square from -1 to 1, of which those that are wound counter-clockwise cover all; if
    /// several parts lie apart, of the largest. `None` if they cover nothing. All triangles must name places that exist.
    pub(super) fn new(places: &[Vector2<f64>], triangles: &[[u32; 3]]) -> Option<Self> {
        let mut lines = closed_lines(border_edges(places, triangles));
        let mut parts = covered(places, &lines);
        if parts.len() > 1 {
            // Walls seen edge-on, which are narrower than rounding, may lie between.
            lines.extend(edge_on(places, triangles));
            parts = covered(places, &lines);
        }
        let outer = |part: &Vec<Vec<_>>| part.first().map_or(0.0, |line| signed_area(line));
        let largest = parts
            .into_iter()
            .max_by(|one, other| outer(one).total_cmp(&outer(other)))?;
        let mut lines = largest.into_iter();
        Some(Self {
            border: without_slits(lines.next()?, SLIT),
            holes: -lines.map(|line| signed_area(&line)).sum::<f64>(),
        })
    }
}

/// What closed lines through places go round at least once: of each part the outer border, and those of its holes.
fn covered(places: &[Vector2<f64>], lines: &[Vec<u32>]) -> Vec<Vec<Vec<Vector2<f64>>>> {
    let line = |line: &Vec<u32>| -> Vec<[f64; 2]> {
        line.iter().map(|&at| places[at as usize].into()).collect()
    };
    let lines: Vec<_> = lines.iter().map(line).collect();
    let corners = |line: Vec<[f64; 2]>| line.into_iter().map(Vector2::from).collect();
    let part = |lines: Vec<_>| lines.into_iter().map(corners).collect();
    let parts = lines.simplify_shape_as::<i64>(FillRule::NonZero);
    parts.into_iter().map(part).collect()
}

/// Twice the area of a triangle, above zero where it is wound counter-clockwise, and what it must be beyond not to be edge-on.
fn seen(places: &[Vector2<f64>], corners: &[u32; 3]) -> [f64; 2] {
    let [a, b, c] = corners.map(|corner| places[corner as usize]);
    let sides = [b - a, c - b, a - c].map(|side| side.norm_squared());
    [
        orient2d([a, b, c]),
        EDGE_ON * sides.into_iter().fold(0.0, f64::max),
    ]
}

/// The triangles that are seen edge-on, counter-clockwise.
fn edge_on(places: &[Vector2<f64>], triangles: &[[u32; 3]]) -> impl Iterator<Item = Vec<u32>> {
    triangles.iter().filter_map(move |corners| {
        let [area, least] = seen(places, corners);
        let [a, b, c] = *corners;
        (area.abs() <= least).then(|| {
            if area < 0.0 {
                vec![a, c, b]
            } else {
                vec![a, b, c]
            }
        })
    })
}

/// The edges of the triangles that are wound counter-clockwise, from end to end, without those that two of them walk in
/// opposite senses: these are most, and those between corners that no other triangle has are not even looked at.
fn border_edges(places: &[Vector2<f64>], triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let is_in_front = |corners: &&[u32; 3]| {
        let [area, least] = seen(places, corners);
        area > least
    };
    let (in_front, behind): (Vec<&[u32; 3]>, Vec<&[u32; 3]>) =
        triangles.iter().partition(is_in_front);
    let mut is_border = vec![false; places.len()];
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
fn closed_lines(mut edges: Vec<[u32; 2]>) -> Vec<Vec<u32>> {
    edges.sort_unstable();
    let first = |from: u32| edges.partition_point(|edge| edge[0] < from);
    let mut is_walked = vec![false; edges.len()];
    let mut lines = Vec::new();
    for start in 0..edges.len() {
        let (mut line, mut at) = (Vec::new(), start);
        while !is_walked[at] {
            is_walked[at] = true;
            let [from, to] = edges[at];
            line.push(from);
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
