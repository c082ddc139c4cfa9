//! The grains of a segmented volume: what hangs together of each label.

use super::dust::by_size;
use super::{Split, SplitGrain, area, by_place, voxels_have_neck};
use crate::scan::volume::{LEAST_VOXELS, Volume, VolumeError, VoxelBody};

/// The grains of a segmented volume, or those of one of its labels, in the order of the labels: every body of voxels
/// that share faces. Bodies of few voxels are dust.
///
/// # Errors
/// [`VolumeError`] where there is no label, or not this one, or the values are none.
pub fn split_labels(volume: &Volume, label: Option<i64>) -> Result<Split, VolumeError> {
    let (mut grains, mut left_out) = (Vec::new(), Vec::new());
    let (mut dust, mut dust_points) = (0, 0);
    for (label, bodies) in volume.bodies(label)? {
        let is_large = |body: &VoxelBody| body.voxels() >= LEAST_VOXELS;
        let (large, specks): (Vec<_>, Vec<_>) = bodies.into_iter().partition(is_large);
        if large.is_empty() {
            left_out.push(too_small(label, &specks));
            continue;
        }
        dust += specks.len();
        dust_points += specks.iter().map(VoxelBody::voxels).sum::<usize>();
        let (own, reasons) = of_label(volume, label, large);
        grains.extend(own);
        left_out.extend(reasons);
    }
    let sorted = by_size(grains.into_iter(), 0.0, |grain| area(&grain.scan));
    dust += sorted.small.len();
    let voxels = sorted
        .small
        .iter()
        .filter_map(|grain| grain.voxels.as_ref());
    dust_points += voxels.map(VoxelBody::voxels).sum::<usize>();
    Ok(Split {
        distance: None,
        plane: None,
        plane_points: 0,
        dust,
        dust_points,
        small: sorted.small.len(),
        left_out,
        grains: sorted.grains,
    })
}

/// Why a label without a body of many voxels is no grain.
fn too_small(label: i64, specks: &[VoxelBody]) -> VolumeError {
    match specks {
        [speck] => VolumeError::TooFew {
            label,
            voxels: speck.voxels(),
        },
        _ => VolumeError::Specks {
            label,
            specks: specks.len(),
            most: LEAST_VOXELS,
        },
    }
}

/// The bodies of a label as grains by their places, and why others are none.
fn of_label(
    volume: &Volume,
    label: i64,
    bodies: Vec<VoxelBody>,
) -> (Vec<SplitGrain>, Vec<VolumeError>) {
    let all = bodies.len();
    let (mut grains, mut reasons, mut cut_off) = (Vec::new(), Vec::new(), Vec::new());
    for body in bodies {
        match volume.alone(&body).scan(None) {
            Ok(scan) => grains.push(SplitGrain {
                may_touch: voxels_have_neck(&scan.points, scan.voxel_lattice()),
                scan,
                indices: Vec::new(),
                label: Some(label),
                voxels: Some(body),
                cut: None,
            }),
            Err(reason @ VolumeError::CutOff { .. }) => cut_off.push(reason),
            Err(reason) => reasons.push(reason),
        }
    }
    match all {
        1 => reasons.append(&mut cut_off),
        _ if cut_off.is_empty() => {}
        _ => reasons.push(VolumeError::BodiesCutOff {
            label,
            bodies: cut_off.len(),
        }),
    }
    grains.sort_by(|one, other| by_place(&one.scan, &other.scan));
    (grains, reasons)
}
