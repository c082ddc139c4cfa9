//! The grain as a mesh.

use super::{Frame, Grain};
use crate::mesh::Mesh;
use crate::sphere::cube_grid;

impl Grain {
    /// A closed, consistently oriented, manifold mesh with `resolution` cells along each edge of a
    /// cube of directions: 6 N^2 + 2 vertices, 12 N^2 triangles, in the scan's frame. Where the
    /// radius jumps between independent segments the triangles in between bridge the step.
    ///
    /// An even resolution puts vertices on the mirror planes of a mirrored surface, and so follows its
    /// edges.
    ///
    /// Not guaranteed: a radius below zero somewhere (no fit of a grain gives one) folds the mesh.
    pub fn mesh(&self, resolution: usize) -> Mesh {
        let (directions, triangles) = cube_grid(resolution);
        let Frame { centre, axes } = *self.frame();
        let vertices = directions
            .iter()
            .zip(self.local_radii(&directions))
            .map(|(local, radius)| centre + axes * (local * radius))
            .collect();
        Mesh {
            vertices,
            triangles,
        }
    }
}
