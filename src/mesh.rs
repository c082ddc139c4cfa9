//! A triangle mesh: what a scan may bring, what a fitted grain is exported as.

mod bounds_tree;
mod contour;
mod edges;
mod enclosing;
mod kept;
mod least_area;
mod parts;
#[cfg(test)]
mod refined;
mod relaxed;
mod winding;

pub(crate) use bounds_tree::{Bounds, BoundsTree};
pub(crate) use contour::{Grid, contour};
pub(crate) use edges::{edges, undirected};
pub(crate) use enclosing::Enclosing;
pub(crate) use kept::keep_vertices;
pub(crate) use least_area::{LEAST_AREA_CORNERS, least_area};
pub(crate) use parts::{part, parts};
#[cfg(test)]
pub(crate) use refined::{is_above, refined};
pub(crate) use relaxed::relaxed;
pub(crate) use winding::{polygon_winding_number, solid_angle, winding_number};

use crate::sphere::cube_grid;
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// Triangles over shared vertices, wound counter-clockwise when seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Corner positions, in the scan's unit and frame.
    pub vertices: Vec<Point3<f64>>,
    /// Three indices into `vertices` per triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// What keeps a mesh from being a closed, consistently oriented surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshDefect {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("a coordinate of vertex {vertex} is not finite")]
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// An edge is walked twice in the same direction: not manifold, or wound inconsistently.
    #[error("edge {from}-{to} is used twice in the same direction")]
    EdgeUsedTwice {
        /// First vertex of the edge.
        from: u32,
        /// Second vertex of the edge.
        to: u32,
    },
    /// An edge has a triangle on one side only: the surface is open there.
    #[error("edge {from}-{to} has a triangle on one side only")]
    OpenEdge {
        /// First vertex of the edge.
        from: u32,
        /// Second vertex of the edge.
        to: u32,
    },
    /// Vertices - edges + faces differs from 2: more than one body, or a handle.
    #[error("the Euler characteristic is {found}, not 2")]
    EulerCharacteristic {
        /// The number found.
        found: i64,
    },
}

impl Mesh {
    /// A closed mesh of a star-shaped surface about the origin, given by its radius in the direction of a
    /// unit vector: the directions of a cube with `resolution` cells per edge, 6 N² + 2 vertices and
    /// 12 N² triangles ([`cube_grid`], which tells the range of N).
    pub fn radial(resolution: usize, radius: impl Fn(&Vector3<f64>) -> f64) -> Self {
        let (directions, triangles) = cube_grid(resolution);
        let vertices = directions.iter().map(|n| Point3::from(n * radius(n)));
        Self {
            vertices: vertices.collect(),
            triangles,
        }
    }

    /// Unit normals at the vertices: of the triangles round each, by their areas. Zero where there are none.
    pub(crate) fn normals(&self) -> Vec<Vector3<f64>> {
        normals(&self.vertices, &self.triangles)
    }

    /// Checks that the mesh is one closed, consistently oriented, manifold surface of the topology
    /// of a sphere, with every vertex in use and finite.
    ///
    /// # Errors
    /// The first [`MeshDefect`] met.
    pub fn check_closed(&self) -> Result<(), MeshDefect> {
        let edges = self.check_edges()? as i64;
        let found = self.vertices.len() as i64 - edges + self.triangles.len() as i64;
        match found {
            2 => Ok(()),
            _ => Err(MeshDefect::EulerCharacteristic { found }),
        }
    }

    /// Checks all of that but the topology, and that every vertex is in use; gives the number of edges.
    pub(crate) fn check_edges(&self) -> Result<usize, MeshDefect> {
        let is_nowhere = |vertex: &Point3<f64>| !vertex.iter().all(|x| x.is_finite());
        if let Some(vertex) = self.vertices.iter().position(is_nowhere) {
            return Err(MeshDefect::NotFinite { vertex });
        }
        let mut directed = HashMap::with_capacity(3 * self.triangles.len());
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if corners.iter().any(|&c| c as usize >= self.vertices.len()) {
                return Err(MeshDefect::IndexOutOfRange { triangle });
            }
            for [from, to] in edges(corners) {
                if directed.insert((from, to), ()).is_some() {
                    return Err(MeshDefect::EdgeUsedTwice { from, to });
                }
            }
        }
        for corners in &self.triangles {
            for [from, to] in edges(corners) {
                if !directed.contains_key(&(to, from)) {
                    return Err(MeshDefect::OpenEdge { from, to });
                }
            }
        }
        Ok(directed.len() / 2)
    }
}

/// As [`Mesh::normals`], of some triangles between vertices.
pub(crate) fn normals(vertices: &[Point3<f64>], triangles: &[[u32; 3]]) -> Vec<Vector3<f64>> {
    let mut sums = vec![Vector3::zeros(); vertices.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
        let area = (b - a).cross(&(c - a));
        corners.iter().for_each(|&i| sums[i as usize] += area);
    }
    sums.iter()
        .map(|sum| sum.try_normalize(0.0).unwrap_or_default())
        .collect()
}
