//! What the border of an image cuts off a label: there the voxels end, and not the grain.

use super::{Extent, VolumeError};
use crate::digits::plural;
use crate::mesh::Grid;

/// Share of a label's boundary that may lie on one side of the image: of a ball that is merely cropped to its voxels it
/// is 3 % at a radius of 12 voxels.
const LARGEST_SHARE: f64 = 0.05;

/// A label of which little lies on the border of the image is warned of.
///
/// # Errors
/// [`VolumeError::CutOff`] where much does.
pub(super) fn look(
    label: i64,
    grid: &Grid,
    Extent { low, high, .. }: &Extent,
    size: [usize; 3],
) -> Result<Option<String>, VolumeError> {
    let on_sides = (0..3).flat_map(|axis| {
        let first = (low[axis] == 0).then(|| grid.layer(axis, 0));
        let last = (high[axis] + 1 == size[axis]).then(|| grid.layer(axis, high[axis] - low[axis]));
        [first, last].into_iter().flatten()
    });
    let on_sides: Vec<usize> = on_sides.collect();
    let Some(&most) = on_sides.iter().max() else {
        return Ok(None);
    };
    let share = most as f64 / grid.faces() as f64;
    if share > LARGEST_SHARE {
        return Err(VolumeError::CutOff { label, share });
    }
    let faces = plural(on_sides.iter().sum(), "face");
    Ok(Some(format!(
        "The label {label} touches the border of the volume with {faces} of its voxels: if the grain goes on there, it \
         is larger than told."
    )))
}
