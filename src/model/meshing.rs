//! The grain as a mesh.

use super::{Frame, Grain};
use crate::mesh::Mesh;
use crate::sphere::cube_grid;
use rayon::prelude::*;

impl Grain {
    /// A closed, consistently oriented, manifold mesh with `resolution` cells along each edge of a
    /// cube of directions: 6 N^2 + 2 vertices, 12 N^2 triangles, in the scan's frame. Where the
    /// radius jumps between segments the triangles in between bridge the step.
    ///
    /// Not guaranteed: a radius below zero somewhere (no fit of a grain gives one) folds the mesh.
    pub fn mesh(&self, resolution: usize) -> Mesh {
        let (directions, triangles) = cube_grid(resolution);
        let Frame { centre, axes } = *self.frame();
        let vertices = directions
            .par_iter()
            .with_min_len(1024)
            .map(|local| {
                let segment = self.partition().segment_of(local);
                centre + axes * (local * self.segment_radius(segment, local))
            })
            .collect();
        Mesh {
            vertices,
            triangles,
        }
    }
}
