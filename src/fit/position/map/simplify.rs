//! Which vertices a mesh loses, one after the other, until a tetrahedron is left.
//!
//! Garland and Heckbert's quadrics say how far the surface moves; what is cheap is taken first. The cost also grows
//! with the length of the edge, with the slivers that are made, and with the valence of both ends: otherwise meshes
//! with many coincident vertices end in rings so long and thin that no number tells their kernel.

use super::half_edges::{HalfEdges, next, previous};
use crate::fit::context::{Cancelled, Context};
use nalgebra::{Matrix4, Vector3, Vector4};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Vertices with more neighbours wait until they have lost some.
const MOST_NEIGHBOURS: usize = 40;

/// Least squared length of an edge in the cost, for a mesh of diameter 1.
const LEAST_SQUARE: f64 = 1e-8;

/// Weight of the squared squared length beside the quadrics.
const LENGTH_WEIGHT: f64 = 1e-3;

/// Removals between looks at the cancel flag.
const PATIENCE: usize = 4096;

/// The neighbours of an ordinary vertex.
const ORDINARY_VALENCE: f64 = 6.0;

/// Takes vertices away until four are left, and gives the half-edges along which they went, in order. The mesh is some
/// 1 across.
pub(super) fn simplify(
    half_edges: &mut HalfEdges,
    points: &[Vector3<f64>],
    context: &Context<'_>,
) -> Result<Vec<u32>, Cancelled> {
    let mut queue = Queue::new(half_edges, points);
    let mut removed = Vec::with_capacity(points.len() - 4);
    while removed.len() + 4 < points.len() {
        if removed.len() % PATIENCE == 0 {
            context.check()?;
        }
        // A triangulated sphere of more than four vertices always has an edge that can go.
        let Some(h) = queue.pop(half_edges) else {
            break;
        };
        queue.collapse(half_edges, h);
        removed.push(h);
    }
    Ok(removed)
}

/// The vertices by cost. What is in the heap may be out of date: only the entry with a vertex' own stamp counts.
struct Queue<'a> {
    points: &'a [Vector3<f64>],
    quadrics: Vec<Matrix4<f64>>,
    heap: BinaryHeap<Reverse<Entry>>,
    stamps: Vec<u32>,
    /// Vertices that neighbour the one at hand hold the number of its visit.
    marks: Vec<u32>,
    visits: u32,
}

/// The cheapest way to lose a vertex.
#[derive(PartialEq)]
struct Entry {
    cost: f64,
    half_edge: u32,
    vertex: u32,
    stamp: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = self.cost.total_cmp(&other.cost);
        by_cost
            .then(self.vertex.cmp(&other.vertex))
            .then(self.stamp.cmp(&other.stamp))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<'a> Queue<'a> {
    fn new(half_edges: &HalfEdges, points: &'a [Vector3<f64>]) -> Self {
        let count = points.len();
        let mut queue = Self {
            points,
            quadrics: quadrics(half_edges, points),
            heap: BinaryHeap::with_capacity(2 * count),
            stamps: vec![0; count],
            marks: vec![0; count],
            visits: 0,
        };
        for v in 0..count as u32 {
            queue.push(half_edges, v);
        }
        queue
    }

    /// The half-edge of least cost that can be collapsed.
    fn pop(&mut self, half_edges: &HalfEdges) -> Option<u32> {
        while let Some(Reverse(entry)) = self.heap.pop() {
            if entry.stamp != self.stamps[entry.vertex as usize] {
                continue;
            }
            self.mark_ring(half_edges, entry.vertex);
            if self.is_free(half_edges, entry.half_edge) {
                return Some(entry.half_edge);
            }
            self.push(half_edges, entry.vertex);
        }
        None
    }

    fn collapse(&mut self, half_edges: &mut HalfEdges, h: u32) {
        let (v, u) = (half_edges.origin(h), half_edges.target(h));
        let ring: Vec<u32> = half_edges.around(v).map(|h| half_edges.target(h)).collect();
        half_edges.collapse(h);
        let gone = self.quadrics[v as usize];
        self.quadrics[u as usize] += gone;
        self.stamps[v as usize] += 1;
        for w in ring {
            self.push(half_edges, w);
        }
    }

    /// Finds the cheapest way to lose a vertex as things are now.
    fn push(&mut self, half_edges: &HalfEdges, v: u32) {
        let stamp = &mut self.stamps[v as usize];
        *stamp += 1;
        let stamp = *stamp;
        let valence = half_edges.valence(v);
        if valence > MOST_NEIGHBOURS {
            return;
        }
        self.mark_ring(half_edges, v);
        let mut best: Option<(f64, u32)> = None;
        for h in half_edges.around(v) {
            let cost = self.cost(half_edges, h, valence);
            // The link condition takes longer to look up.
            if best.is_none_or(|(least, _)| cost < least) && self.is_free(half_edges, h) {
                best = Some((cost, h));
            }
        }
        if let Some((cost, half_edge)) = best {
            self.heap.push(Reverse(Entry {
                cost,
                half_edge,
                vertex: v,
                stamp,
            }));
        }
    }

    fn mark_ring(&mut self, half_edges: &HalfEdges, v: u32) {
        self.visits += 1;
        for h in half_edges.around(v) {
            self.marks[half_edges.target(h) as usize] = self.visits;
        }
    }

    /// The link condition: the ends of a half-edge have exactly two common neighbours. The ring of its origin is
    /// marked.
    fn is_free(&self, half_edges: &HalfEdges, h: u32) -> bool {
        let (v, u) = (half_edges.origin(h), half_edges.target(h));
        let common = match half_edges.valence(u) <= MOST_NEIGHBOURS {
            true => {
                let is_common = |h: &u32| self.marks[half_edges.target(*h) as usize] == self.visits;
                half_edges.around(u).filter(is_common).count()
            }
            false => {
                let is_common = |h: &u32| half_edges.are_joined(half_edges.target(*h), u);
                half_edges.around(v).filter(is_common).count()
            }
        };
        common == 2
    }

    /// What it costs to lose the origin of a half-edge to its target.
    fn cost(&self, half_edges: &HalfEdges, h: u32, valence: usize) -> f64 {
        let (v, u) = (half_edges.origin(h), half_edges.target(h));
        let point = |v: u32| self.points[v as usize];
        let (from, to) = (point(v), point(u));
        let homogeneous = Vector4::new(to.x, to.y, to.z, 1.0);
        let quadric = self.quadrics[v as usize] + self.quadrics[u as usize];
        let moved = homogeneous.dot(&(quadric * homogeneous)).max(0.0);
        let square = (to - from).norm_squared() + LEAST_SQUARE;
        let valences = (valence * half_edges.valence(u)) as f64 / ORDINARY_VALENCE.powi(2);
        let length = LENGTH_WEIGHT * (square * valences).powi(2);
        // Of the triangles made, the thinnest: twice its area over the square of its longest edge.
        let mut thinnest: f64 = 1.0;
        for own in half_edges.around(v) {
            let [b, c] = [next(own), previous(own)].map(|h| half_edges.origin(h));
            if b == u || c == u {
                continue;
            }
            let (b, c) = (point(b), point(c));
            let longest = (b - to).norm_squared().max((c - to).norm_squared());
            let longest = longest.max((c - b).norm_squared());
            let area = (b - to).cross(&(c - to)).norm();
            thinnest = thinnest.min(area / (longest + f64::MIN_POSITIVE));
        }
        (moved + length) * (1.0 + 0.3 / (thinnest + 1e-3))
    }
}

/// Of every vertex the sum over its triangles of area times squared distance from their planes.
fn quadrics(half_edges: &HalfEdges, points: &[Vector3<f64>]) -> Vec<Matrix4<f64>> {
    let triangle = |h: u32| {
        let [a, b, c] = [h, next(h), previous(h)].map(|h| points[half_edges.origin(h) as usize]);
        let normal = (b - a).cross(&(c - a));
        let Some(unit) = normal.try_normalize(0.0) else {
            return Matrix4::zeros();
        };
        let plane = Vector4::new(unit.x, unit.y, unit.z, -unit.dot(&a));
        plane * plane.transpose() * normal.norm()
    };
    (0..points.len() as u32)
        .map(|v| half_edges.around(v).map(triangle).sum())
        .collect()
}
