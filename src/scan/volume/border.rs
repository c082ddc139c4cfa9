//! What the border of an image cuts off a label: there the voxels end, and not the grain.

use super::{Extent, VolumeError};
use crate::digits::plural;
use crate::mesh::Grid;
use nalgebra::Matrix3;

/// Share of a label's boundary that may lie on one side of the image: of a ball that is merely cropped to its voxels it
/// is 3 % at a radius of 12 voxels.
const LARGEST_SHARE: f64 = 0.05;

/// Sides of an image.
const SIDES: usize = 6;

/// A label of which little lies on the border of the image is warned of. `steps` are those from a voxel to the next along each
/// axis, in the columns.
///
/// # Errors
/// [`VolumeError::CutOff`] where much does, [`VolumeError::Background`] where it does so on all sides.
pub(super) fn look(
    label: i64,
    grid: &Grid,
    Extent { low, high, .. }: &Extent,
    size: [usize; 3],
    steps: &Matrix3<f64>,
) -> Result<Option<String>, VolumeError> {
    let on_sides = (0..3).flat_map(|axis| {
        let first = (low[axis] == 0).then(|| grid.layer(axis, 0));
        let last = (high[axis] + 1 == size[axis]).then(|| grid.layer(axis, high[axis] - low[axis]));
        [first, last]
            .into_iter()
            .flatten()
            .map(move |faces| (axis, faces))
    });
    let on_sides: Vec<(usize, usize)> = on_sides.collect();
    if on_sides.is_empty() {
        return Ok(None);
    }
    let column = |axis: usize| steps.column(axis % 3);
    let of_face = |axis: usize| column(axis + 1).cross(&column(axis + 2)).norm();
    let area = |(axis, faces): (usize, usize)| faces as f64 * of_face(axis);
    let most = on_sides.iter().copied().map(area).fold(0.0, f64::max);
    let whole: f64 = grid.faces().into_iter().enumerate().map(area).sum();
    let share = most / whole;
    if share > LARGEST_SHARE {
        return Err(match on_sides.len() {
            SIDES => VolumeError::Background { label },
            _ => VolumeError::CutOff { label, share },
        });
    }
    let faces = plural(on_sides.iter().map(|(_, faces)| faces).sum(), "face");
    Ok(Some(format!(
        "The label {label} touches the border of the volume with {faces} of its voxels: if the grain goes on there, it \
         is larger than told."
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// What is told of a ball of radius 10 whose middle lies so far from a side of the image across the first axis.
    fn told(steps: [f64; 3], depth: f64) -> Result<Option<String>, VolumeError> {
        let steps = Vector3::from(steps);
        let sides: [usize; 3] = std::array::from_fn(|axis| (24.0 / steps[axis]) as usize);
        let mut grid = Grid::new(sides);
        let mut extent = Extent::default();
        for z in 0..sides[2] {
            for y in 0..sides[1] {
                for x in 0..sides[0] {
                    let at = Vector3::new(x as f64, y as f64, z as f64).component_mul(&steps);
                    if (at - Vector3::new(depth, 12.0, 12.0)).norm() < 10.0 {
                        grid.fill([x, y, z]);
                        extent.add([x, y, z], [x, y, z]);
                    }
                }
            }
        }
        extent.low[0] = 0;
        look(1, &grid, &extent, sides, &Matrix3::from_diagonal(&steps))
    }

    #[test]
    fn a_cut_is_told_by_its_area_whatever_the_voxels() {
        for steps in [
            [1.0; 3],
            [1.0, 0.25, 1.0],
            [0.25, 1.0, 1.0],
            [0.5, 0.5, 0.5],
        ] {
            // A disc of radius 9, beside a ball's voxels of about 530 pi.
            let refused = told(steps, 4.4).unwrap_err();
            let VolumeError::CutOff { share, .. } = refused else {
                panic!("{refused:?}");
            };
            assert!((share - 0.16).abs() < 0.02, "{share} of {steps:?}");
            assert!(told(steps, 9.6).unwrap().is_some(), "{steps:?}");
        }
    }
}
