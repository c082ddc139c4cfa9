//! How far a tip that tapers evenly reaches beyond what voxels show of it.
//!
//! What is thinner than a voxel lies in none, or in some that no other touches. Of a cone the distance of the points from its axis
//! grows evenly with the depth, so that the line through these distances tells where it ends. Of a round end it grows as the root of
//! the depth, and the end is where it is seen: over depths from a fifth to all of a range, the middle of that curve lies above the
//! line between its ends by a tenth of its rise.

use nalgebra::{DMatrix, DVector, Vector2, Vector3};

/// Depths that are looked at, in voxels; the deepest also as a share of the length.
const DEPTHS: [f64; 2] = [2.0, 10.0];
const DEEPEST: f64 = 0.3;

/// Fewer voxels, and fewer points, do not tell.
const LEAST_RANGE: f64 = 3.0;
const LEAST_POINTS: usize = 20;

/// The height of the middle above the line between the ends, as a share of the rise, up to which a tip is a cone, and from which on it
/// is round.
const ROUND: [f64; 2] = [0.03, 0.07];

/// How thick a tip is where voxels end, in voxels from its axis, at most: one that is thicker ends there, from the second on surely.
const THICK: [f64; 2] = [1.0, 2.0];

/// By how much a body of such a length may reach beyond the height `end` along a unit vector, by its points between voxels of this
/// width.
pub(super) fn beyond(
    points: impl Iterator<Item = Vector3<f64>>,
    end: f64,
    along: &Vector3<f64>,
    [width, length]: [f64; 2],
) -> f64 {
    let [from, to] = DEPTHS.map(|depth| depth * width);
    let range = to.min(DEEPEST * length) - from;
    let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
    let other = along.cross(&across);
    let seen = points.filter_map(|point| {
        let share = (end - point.dot(along) - from) / range;
        let aside = Vector2::new(point.dot(&across), point.dot(&other));
        (0.0..1.0).contains(&share).then_some((share, aside))
    });
    let (depths, asides): (Vec<f64>, Vec<Vector2<f64>>) = seen.unzip();
    if range < LEAST_RANGE * width || depths.len() < LEAST_POINTS {
        return 0.0;
    }
    let axis = [0, 1].map(|i| {
        let [at, by] = polynomial(&depths, asides.iter().map(|aside| aside[i]));
        move |depth: f64| at + by * depth
    });
    let from_axis = depths.iter().zip(&asides).map(|(&depth, aside)| {
        let [x, y] = axis.each_ref().map(|axis| axis(depth));
        (aside - Vector2::new(x, y)).norm()
    });
    let [_, first, second] = polynomial(&depths, from_axis.clone());
    let rise = first + second;
    let bulge = -0.25 * second / rise;
    let [at, slope] = polynomial(&depths, from_axis);
    let thickness = (at - slope * from / range) / width;
    let share =
        |value: f64, [sure, none]: [f64; 2]| ((none - value) / (none - sure)).clamp(0.0, 1.0);
    match rise > 0.0 && slope > 0.0 {
        true => {
            let share = share(bulge, ROUND) * share(thickness, THICK);
            share * (at / slope * range - from).clamp(0.0, to)
        }
        false => 0.0,
    }
}

/// The polynomial nearest to values at some depths, the lowest coefficient first.
fn polynomial<const N: usize>(depths: &[f64], values: impl Iterator<Item = f64>) -> [f64; N] {
    let row = |depth: &f64| std::array::from_fn::<f64, N, _>(|power| depth.powi(power as i32));
    let rows: Vec<f64> = depths.iter().flat_map(row).collect();
    let (basis, triangle) = DMatrix::from_row_slice(depths.len(), N, &rows)
        .qr()
        .unpack();
    let values = DVector::from_iterator(depths.len(), values);
    let found = triangle.solve_upper_triangular(&basis.tr_mul(&values));
    found.map_or([0.0; N], |found| std::array::from_fn(|power| found[power]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// What is told of a body as thick as a function of the depth, seen between voxels of side 1 as far as it is thicker than that,
    /// leaning from the axis of its length.
    fn told(radius: impl Fn(f64) -> f64) -> f64 {
        let lean = 0.1;
        let point = |depth: f64, angle: f64| {
            let r = radius(depth);
            Vector3::new(
                r * angle.cos() + lean * depth,
                r * angle.sin(),
                50.0 - depth,
            )
        };
        let all = (1..200).flat_map(|i| {
            let depth = 0.1 * f64::from(i);
            (0..12).map(move |j| (depth, 2.0 * PI * f64::from(j) / 12.0 + f64::from(i)))
        });
        let seen = all.filter(|&(depth, _)| radius(depth) > 0.5);
        let points: Vec<_> = seen.map(|(depth, angle)| point(depth, angle)).collect();
        let end = points.iter().map(|point| point.z).fold(0.0, f64::max);
        beyond(points.into_iter(), end, &Vector3::z(), [1.0, 100.0])
    }

    #[test]
    fn a_cone_reaches_beyond_its_voxels_and_a_round_end_does_not() {
        for slope in [0.25, 0.5] {
            let (told, cut_off) = (told(|depth| slope * depth), 0.5 / slope);
            assert!((told - cut_off).abs() < 0.2 * cut_off, "{told} {cut_off}");
        }
        for radius in [1.5_f64, 6.0, 30.0] {
            let told = told(|depth| (2.0 * radius * depth).sqrt());
            assert!(told < 0.05, "{radius}: {told}");
        }
    }

    /// A cone without its tip, or the end of a block whose sides are not quite parallel.
    #[test]
    fn a_blunt_end_does_not_reach_beyond_its_voxels() {
        for slope in [0.02, 0.2] {
            assert_eq!(told(|depth| 3.0 + slope * depth), 0.0);
        }
    }
}
