//! The lattice of an image's voxels, in which those within a surface are counted.

use crate::digits::significant;
use nalgebra::{Matrix3, Point3, Vector3};

/// Points this near to the middle between two voxels, in steps, are there.
const HALF_WAY: f64 = 0.01;

/// Where the voxels of an image lie.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct VoxelLattice {
    /// The middle of a voxel.
    pub first: Point3<f64>,
    /// From one voxel to the next along each axis of the image, in columns.
    pub steps: Matrix3<f64>,
}

/// The voxels that a surface lies between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Voxels {
    /// Where they lie.
    pub(crate) lattice: VoxelLattice,
    /// See [`Scan::scatter`](crate::scan::Scan::scatter).
    pub(crate) scatter: f64,
}

impl VoxelLattice {
    /// The lengths of the steps, as text.
    pub(crate) fn sides(&self) -> String {
        let sides = self
            .steps
            .column_iter()
            .map(|step| significant(step.norm(), 4));
        sides.collect::<Vec<_>>().join(" x ")
    }

    /// Where points lie, counted in voxels along the axes of the image. `None` if voxels have no volume.
    pub(crate) fn places(&self, points: &[Point3<f64>]) -> Option<Vec<Point3<f64>>> {
        let inverse = self.steps.try_inverse()?;
        let place = |point: &Point3<f64>| Point3::from(inverse * (point - self.first));
        Some(points.iter().map(place).collect())
    }

    /// The axis along which each of some points lies half-way between two voxels; `None` of those that do along none.
    pub(crate) fn axes(&self, points: &[Point3<f64>]) -> Vec<Option<usize>> {
        let Some(places) = self.places(points) else {
            return vec![None; points.len()];
        };
        let axis = |place: &Point3<f64>| {
            let (axis, off) = between(&place.coords);
            (off < HALF_WAY).then_some(axis)
        };
        places.iter().map(axis).collect()
    }

    /// The volume of the voxels within a closed surface between voxels, of which these are the vertices: exact, where the
    /// surface's own cuts off the corners of voxels.
    ///
    /// Along each row of voxels the surface is entered and left in turn, at vertices that lie between two of the row.
    pub(crate) fn volume(&self, vertices: &[Point3<f64>]) -> f64 {
        let places = self.places(vertices).unwrap_or_default();
        let mut crossings: Vec<[i64; 3]> = places
            .iter()
            .filter(|place| between(&place.coords).0 == 0)
            .map(|place| {
                [
                    place.z.round() as i64,
                    place.y.round() as i64,
                    place.x.floor() as i64,
                ]
            })
            .collect();
        crossings.sort_unstable();
        let voxels: i64 = crossings
            .chunks_exact(2)
            .map(|pair| pair[1][2] - pair[0][2])
            .sum();
        voxels as f64 * self.steps.determinant().abs()
    }
}

/// The axis along which a place, in steps, is nearest to the middle between two voxels, and how far from it.
pub(super) fn between(place: &Vector3<f64>) -> (usize, f64) {
    let off = place.map(|x| (x - x.floor() - 0.5).abs());
    let axis = off.imin();
    (axis, off[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grid, contour};
    use approx::assert_relative_eq;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Bernoulli, Distribution};

    /// Whatever they are, on a lattice that is askew.
    #[test]
    fn voxels_at_random_are_counted() {
        let steps = Matrix3::new(-2.0, 0.3, 0.0, 0.1, 1.0, -0.2, 0.4, 0.0, 0.5);
        let first = Point3::new(3.0, -7.0, 100.0);
        for share in [0.1, 0.5, 0.9] {
            let mut random = ChaCha8Rng::seed_from_u64(7);
            let (mut grid, mut count) = (Grid::new([6, 7, 8]), 0);
            for index in 0..6 * 7 * 8 {
                if Bernoulli::new(share).unwrap().sample(&mut random) {
                    grid.fill([index % 6, index / 6 % 7, index / 42]);
                    count += 1;
                }
            }
            let vertices: Vec<_> = contour(&grid, |_, _| 0.5)
                .vertices
                .iter()
                .map(|vertex| first + steps * vertex.coords)
                .collect();
            let volume = VoxelLattice { first, steps }.volume(&vertices);
            let expected = f64::from(count) * steps.determinant().abs();
            assert_relative_eq!(volume, expected, max_relative = 1e-12);
        }
    }
}
