//! Flat sides as voxels show them: terraces that lie in one layer.

use crate::mesh::Mesh;
use nalgebra::Vector3;

/// Corners of a triangle lie in one layer if their heights differ by less than this share of the distance between layers.
const LEVEL: f64 = 1e-3;

/// Layers that are farther apart than this are no neighbours.
const NEXT: f64 = 1.5;

/// A side in one layer, with more than twice the area that lies in the layer above or below.
pub(super) struct Terrace {
    /// By what it is larger than twice the larger of its neighbours: curved sides step down in terraces that are alike.
    pub(super) area: f64,
    /// In layers.
    pub(super) height: f64,
}

impl Terrace {
    /// The largest that faces along the normal of layers, given over the distance between them. `None` where none stands out.
    pub(super) fn largest(layer: &Vector3<f64>, mesh: &Mesh) -> Option<Self> {
        let along = layer.normalize();
        let level = mesh.triangles.iter().filter_map(|triangle| {
            let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize].coords);
            let heights = [a, b, c].map(|corner| layer.dot(&corner));
            let off = heights.map(|height| (height - heights[0]).abs());
            let area = 0.5 * along.dot(&(b - a).cross(&(c - a)));
            (area > 0.0 && off[1].max(off[2]) < LEVEL).then_some((heights[0], area))
        });
        let mut level: Vec<(f64, f64)> = level.collect();
        level.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let is_same = |one: &(f64, f64), other: &(f64, f64)| other.0 - one.0 < LEVEL;
        let sides: Vec<Self> = (level.chunk_by(is_same))
            .map(|side| Self {
                area: side.iter().map(|(_, area)| area).sum(),
                height: side[0].0,
            })
            .collect();
        let beside = |at: Option<usize>, height: f64| {
            let side = at.and_then(|at| sides.get(at));
            side.filter(|side| (side.height - height).abs() < NEXT)
                .map_or(0.0, |side| side.area)
        };
        let more = sides.iter().enumerate().map(|(at, side)| {
            let [below, above] =
                [at.checked_sub(1), Some(at + 1)].map(|at| beside(at, side.height));
            Self {
                area: side.area - 2.0 * below.max(above),
                height: side.height,
            }
        });
        more.max_by(|one, other| one.area.total_cmp(&other.area))
            .filter(|terrace| terrace.area > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grid, contour};
    use approx::assert_relative_eq;

    /// The largest terrace that faces along z of the voxels of a body, and how far its height is from the first voxel's middle.
    fn largest(is_inside: impl Fn([f64; 3]) -> bool) -> Option<(f64, f64)> {
        let mut grid = Grid::new([40; 3]);
        for z in 0..40 {
            for y in 0..40 {
                for x in 0..40 {
                    if is_inside([x, y, z].map(|i| i as f64 - 19.5)) {
                        grid.fill([x, y, z]);
                    }
                }
            }
        }
        let mesh = contour(&grid, |_, _| 0.5);
        Terrace::largest(&Vector3::z(), &mesh).map(|it| (it.area, it.height))
    }

    #[test]
    fn a_flat_side_is_a_terrace_and_a_round_one_is_none() {
        let (area, height) = largest(|[x, y, z]| x.hypot(y) < 14.8 && z.abs() < 5.7).unwrap();
        assert_relative_eq!(area, 14.8 * 14.8 * std::f64::consts::PI, max_relative = 0.1);
        assert_relative_eq!(height, 25.5);
        for radius in [9.9, 12.2, 15.5, 17.3] {
            let found = largest(|[x, y, z]| x * x + y * y + (z - 0.3).powi(2) < radius * radius);
            assert!(
                found.is_none_or(|(area, _)| area < 0.01 * 12.6 * radius * radius),
                "{found:?}"
            );
        }
        // It leans by half a layer, or by three.
        let leaning = |slope: f64| {
            largest(move |[x, y, z]| x.abs().max(y.abs()) < 15.0 && (z - slope * x).abs() < 5.0)
        };
        let square = 29.0 * 29.0;
        assert!(leaning(0.5 / 30.0).is_some_and(|(area, _)| area > 0.9 * square));
        assert!(leaning(3.0 / 30.0).is_none_or(|(area, _)| area < 0.1 * square));
    }
}
