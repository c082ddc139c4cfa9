//! How far the points between voxels are off the surface.

use super::voxel_lattice::between;
use crate::mesh::{Mesh, relaxed};
use nalgebra::Matrix3;

/// Rounds of smoothing after which the steps between voxels no longer turn the normals.
const ROUNDS: usize = 10;

/// Standard deviation of the points of a contour from the surface, along its normals. Such a point lies half-way
/// between two voxels, and the surface anywhere on the step between them: it is off by the 12th part of the squared
/// step, as seen along the normal. `contour` has steps of length 1 along the axes, and `steps` are the true ones.
pub(super) fn scatter(contour: &Mesh, steps: &Matrix3<f64>) -> f64 {
    let mut smooth = relaxed(contour, ROUNDS);
    for vertex in &mut smooth.vertices {
        *vertex = steps * *vertex;
    }
    let normals = smooth.normals();
    let squares = contour
        .vertices
        .iter()
        .zip(&normals)
        .map(|(vertex, normal)| {
            let (axis, _) = between(&vertex.coords);
            steps.column(axis).dot(normal).powi(2) / 12.0
        });
    (squares.sum::<f64>() / contour.vertices.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grid, contour};
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    /// Of an ellipsoid in its voxels, as scattered as it is told to be.
    #[test]
    fn points_are_as_far_off_as_they_are_told_to_be() {
        let steps = Vector3::new(2.0, 1.0, 0.5);
        let middle = Vector3::new(20.3, 20.1, 19.8);
        for semi_axes in [Vector3::repeat(15.0), Vector3::new(7.0, 16.0, 16.0)] {
            let size = steps.map(|step| (40.0 / step) as usize + 1);
            let mut grid = Grid::new(size.into());
            for index in 0..size.product() {
                let voxel = [
                    index % size.x,
                    index / size.x % size.y,
                    index / (size.x * size.y),
                ];
                let at = Vector3::from(voxel.map(|i| i as f64)).component_mul(&steps);
                if (at - middle).component_div(&semi_axes).norm() < 1.0 {
                    grid.fill(voxel);
                }
            }
            let mesh = contour(&grid, |_, _| 0.5);
            let off = |vertex: &nalgebra::Point3<f64>| {
                let at = vertex.coords.component_mul(&steps) - middle;
                let level = at.component_div(&semi_axes).norm();
                let slope = at
                    .component_div(&semi_axes.component_mul(&semi_axes))
                    .norm()
                    / level;
                ((level - 1.0) / slope).powi(2)
            };
            let squares: f64 = mesh.vertices.iter().map(off).sum();
            let found = (squares / mesh.vertices.len() as f64).sqrt();
            let told = scatter(&mesh, &Matrix3::from_diagonal(&steps));
            assert_relative_eq!(told, found, max_relative = 0.05);
        }
    }
}
