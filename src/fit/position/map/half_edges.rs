//! The triangles of a closed surface of genus 0, each edge as two half-edges, with vertices that can be taken away and
//! put back.
//!
//! Half-edge 3t + i of triangle t runs from its corner i to the next. Taking vertex v away along v -> u kills the two
//! triangles of the edge, joins their outer neighbours and renames v to u. What dead triangles hold is left as it is:
//! so collapses are undone in the opposite order from nothing but their half-edges.

use super::error::MapError;
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Mesh, MeshDefect};

/// The connectivity.
#[derive(Clone)]
pub(super) struct HalfEdges {
    /// The vertex from which each half-edge runs.
    origin: Vec<u32>,
    /// The half-edge of the same edge that runs the other way.
    twin: Vec<u32>,
    /// One of the living half-edges that run from each vertex.
    out: Vec<u32>,
    valence: Vec<u32>,
}

/// The next half-edge in the triangle.
pub(super) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before in the triangle.
pub(super) fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl HalfEdges {
    /// The half-edges of a mesh.
    ///
    /// # Errors
    /// [`MapError`] unless it is one closed, consistently wound manifold without handles, all of whose vertices are in
    /// use.
    pub(super) fn new(mesh: &Mesh) -> Result<Self, MapError> {
        let vertices = mesh.vertices.len();
        let is_known = |corner: &u32| (*corner as usize) < vertices;
        if let Some(triangle) = mesh.triangles.iter().position(|t| !t.iter().all(is_known)) {
            return Err(MeshDefect::IndexOutOfRange { triangle }.into());
        }
        let origin = mesh.triangles.as_flattened().to_vec();
        let twin = twins(&origin)?;
        let mut half_edges = Self {
            out: vec![u32::MAX; vertices],
            valence: vec![0; vertices],
            origin,
            twin,
        };
        let mut sets = DisjointSets::new(vertices);
        for h in 0..half_edges.origin.len() as u32 {
            let v = half_edges.origin(h);
            half_edges.out[v as usize] = h;
            half_edges.valence[v as usize] += 1;
            sets.join(v, half_edges.target(h));
        }
        for v in 0..vertices as u32 {
            match half_edges.valence(v) {
                0 => return Err(MapError::UnusedVertex { vertex: v }),
                valence if half_edges.around(v).count() != valence => {
                    return Err(MapError::PinchedVertex { vertex: v });
                }
                _ => {}
            }
        }
        let bodies = (0..vertices as u32).filter(|&v| sets.of(v) == v).count();
        if bodies > 1 {
            return Err(MapError::SeveralBodies { bodies });
        }
        let euler = vertices as i64 - mesh.triangles.len() as i64 / 2;
        match euler {
            _ if vertices < 4 => Err(MapError::NoBody),
            2 => Ok(half_edges),
            _ => Err(MapError::Handles {
                genus: ((2 - euler) / 2) as usize,
            }),
        }
    }

    pub(super) fn origin(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }

    pub(super) fn target(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The number of triangles, dead ones too.
    pub(super) fn triangles(&self) -> usize {
        self.origin.len() / 3
    }

    /// The number of neighbours.
    pub(super) fn valence(&self, v: u32) -> usize {
        self.valence[v as usize] as usize
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: u32) -> [u32; 3] {
        [0, 1, 2].map(|i| self.origin(3 * triangle + i))
    }

    /// The half-edges that run from a vertex, clockwise as seen from outside.
    pub(super) fn around(&self, v: u32) -> impl Iterator<Item = u32> {
        let first = self.out[v as usize];
        let mut at = Some(first);
        std::iter::from_fn(move || {
            let h = at?;
            let following = next(self.twin[h as usize]);
            at = (following != first).then_some(following);
            Some(h)
        })
    }

    /// Whether two vertices have an edge.
    pub(super) fn are_joined(&self, a: u32, b: u32) -> bool {
        let (few, many) = match self.valence(a) < self.valence(b) {
            true => (a, b),
            false => (b, a),
        };
        self.around(few).any(|h| self.target(h) == many)
    }

    /// Takes the origin of a half-edge away: its triangles become its target's. The two must have exactly two common
    /// neighbours.
    pub(super) fn collapse(&mut self, h: u32) {
        let (v, u) = (self.origin(h), self.target(h));
        let ring: Vec<u32> = self.around(v).collect();
        for own in ring {
            self.origin[own as usize] = u;
        }
        for side in [h, self.twin[h as usize]] {
            // Of the dying triangle, the neighbours across its other two edges become twins.
            let (one, other) = (
                self.twin[next(side) as usize],
                self.twin[previous(side) as usize],
            );
            self.twin[one as usize] = other;
            self.twin[other as usize] = one;
            let apex = self.origin(previous(side));
            let lives = match self.origin(one) == apex {
                true => one,
                false => other,
            };
            self.out[apex as usize] = lives;
            self.out[u as usize] = self.twin[lives as usize];
            self.valence[apex as usize] -= 1;
        }
        self.valence[u as usize] += self.valence[v as usize];
        self.valence[u as usize] -= 4;
        // The dead triangles keep what they held.
        self.origin[h as usize] = v;
        self.origin[next(self.twin[h as usize]) as usize] = v;
    }

    /// Puts the origin of a half-edge back: the opposite of the last [collapse](Self::collapse).
    pub(super) fn split(&mut self, h: u32) {
        let (v, u) = (self.origin(h), self.target(h));
        for side in [h, self.twin[h as usize]] {
            for inner in [next(side), previous(side)] {
                let outer = self.twin[inner as usize];
                self.twin[outer as usize] = inner;
            }
            let apex = self.origin(previous(side));
            self.valence[apex as usize] += 1;
        }
        self.out[v as usize] = h;
        self.out[u as usize] = self.twin[h as usize];
        let ring: Vec<u32> = self.around(v).collect();
        for own in &ring {
            self.origin[*own as usize] = v;
        }
        self.valence[v as usize] = ring.len() as u32;
        self.valence[u as usize] += 4;
        self.valence[u as usize] -= ring.len() as u32;
    }
}

/// For every half-edge the one that runs the other way.
fn twins(origin: &[u32]) -> Result<Vec<u32>, MeshDefect> {
    let ends = |h: u32| (origin[h as usize], origin[next(h) as usize]);
    let mut sorted: Vec<(u32, u32, u32)> = (0..origin.len() as u32)
        .map(|h| {
            let (from, to) = ends(h);
            (from.min(to), from.max(to), h)
        })
        .collect();
    sorted.sort_unstable();
    let mut twin = vec![0; origin.len()];
    for edge in sorted.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (from, to) = ends(edge[0].2);
        match edge {
            [_] => return Err(MeshDefect::OpenEdge { from, to }),
            &[(.., one), (.., other)] if ends(one) != ends(other) && from != to => {
                twin[one as usize] = other;
                twin[other as usize] = one;
            }
            _ => return Err(MeshDefect::EdgeUsedTwice { from, to }),
        }
    }
    Ok(twin)
}
