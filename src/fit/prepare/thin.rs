//! A dense cloud's stand-in: one sample per small patch of directions.
//!
//! The triangulation of the directions, the centre, the axes and the held-out error do not need
//! millions of points. Directions are [binned](super::bin) on the faces of a cube turned by a fixed odd rotation
//! (so that no symmetry plane of a body runs along the bins), and each bin is represented by its
//! point of median radius, which also drops outliers.

use super::bin::{BINS, bin};
use super::islands::LARGEST;
use super::samples::{Sample, order};
use crate::buckets::Buckets;
use nalgebra::{Matrix3, Point3, Rotation3};

/// Clouds up to this size are used whole.
pub(crate) const WHOLE_CLOUD: usize = 16_384;

/// So many points of a bin, the representative and those near it, may be strays: an island of them.
const FEW: usize = LARGEST;

/// A representative of each bin that holds a point, and the points that stand apart from theirs.
pub(crate) struct Thinned {
    /// Indices of the representatives, by bin.
    pub(crate) representatives: Vec<u32>,
    /// Of each, the points of its bin that are near it and itself; none where they are not so [few](FEW) that they may be strays.
    pub(crate) may_be_strays: Vec<Vec<u32>>,
    /// Indices of points whose radius after the map differs from their bin's median by more than `apart`
    /// (relative), sorted.
    pub(crate) strays: Vec<u32>,
}

/// Thins `points` as seen from `centre` after a linear map.
pub(super) fn thin(
    points: &[Point3<f64>],
    centre: &Point3<f64>,
    map: &Matrix3<f64>,
    apart: f64,
) -> Thinned {
    let turn = Rotation3::from_euler_angles(0.37, 1.13, 2.71).matrix() * map;
    let bins: Vec<u32> = points
        .iter()
        .map(|p| bin(&(turn * (p - centre))) as u32)
        .collect();
    let sorted = Buckets::new(BINS, &bins);
    let mut thinned = Thinned {
        representatives: Vec::new(),
        may_be_strays: Vec::new(),
        strays: Vec::new(),
    };
    let mut keyed: Vec<(Sample, u32)> = Vec::new();
    for members in sorted.iter().filter(|members| !members.is_empty()) {
        keyed.clear();
        keyed.extend(members.iter().map(|&index| {
            let p = points[index as usize];
            ([p.x, p.y, p.z, (map * (p - centre)).norm()], index)
        }));
        // Ties in radius are broken by position, so that the order of the points does not matter.
        let middle = keyed.len() / 2;
        let (_, &mut ([.., median], index), _) =
            keyed.select_nth_unstable_by(middle, |a, b| order(&a.0, &b.0));
        let is_near = |([.., r], _): &&(Sample, u32)| (r - median).abs() <= apart * median;
        let strays = keyed.iter().filter(|member| !is_near(member));
        thinned.strays.extend(strays.map(|&(_, index)| index));
        let near = keyed.iter().filter(is_near).map(|&(_, index)| index);
        let near: Vec<u32> = near.take(FEW + 1).collect();
        let is_few = near.len() <= FEW;
        thinned.representatives.push(index);
        let few = if is_few { near } else { Vec::new() };
        thinned.may_be_strays.push(few);
    }
    thinned.strays.sort_unstable();
    thinned
}

/// The points of these indices.
pub(super) fn select(points: &[Point3<f64>], indices: &[u32]) -> Vec<Point3<f64>> {
    indices.iter().map(|&i| points[i as usize]).collect()
}
