//! Boxes that lie a little otherwise than the least one and are hardly larger: of the true surface one of them may be the least.

use super::extreme_points::{Candidate, ExtremePoints, HullPoints};
use super::{EXTREMES, is_in_half};
use crate::Mesh;
use crate::measure::OrientedBox;
use crate::sphere::cube_grid;
use nalgebra::{Matrix3, Vector3};

/// Directions that are tried: so many to each side of each axis of the least box, at these distances in radians. In the plane
/// across it the least rectangle is exact.
const TO_EACH_SIDE: i32 = 4;
const COARSE: f64 = 0.03;
const FINE: f64 = 0.005;

/// Sine of the angle to which extreme points count to the outline: beyond those directions by the spacing of the grid.
const OUTLINE: f64 = 0.3;

/// Local minima of the volume among them that are refined about each axis, and the size of the last simplex over that of the steps.
const REFINED: usize = 2;
const END: f64 = 0.05;

/// The boxes beside the least one of a hull: those close to it that are larger by some share of the volume at most, and those near
/// local minima that are larger by another.
pub(in crate::measure) fn boxes_beside(
    hull: &Mesh,
    least: &OrientedBox,
    [close, minima]: [f64; 2],
) -> Vec<OrientedBox> {
    let points = HullPoints::new(&hull.vertices);
    // Boxes round a few points are smaller than those round all.
    let whole = |found: &Candidate, larger: f64| {
        let largest = least.volume() * (1.0 + larger);
        let may_be = found.volume <= largest;
        let whole = may_be.then(|| points.box_along(&found.axes));
        whole.filter(|found| found.volume() <= largest)
    };
    let axes = [0, 1, 2].map(|at| {
        let turned = [at + 1, at + 2, at].map(|i| least.axes.column(i % 3).into_owned());
        Matrix3::from_columns(&turned)
    });
    let of_faces = axes.iter().flat_map(|axes| near(axes, COARSE));
    let of_faces = ExtremePoints::new(&points, of_faces.step_by(2));
    let grid = cube_grid(EXTREMES).0;
    let mut beside = Vec::new();
    for axes in &axes {
        let mut few = of_faces.clone();
        let round = grid.iter().filter(|n| is_in_half(n) && is_across(n, axes));
        few.add(&points, round.copied());
        for step in [COARSE, FINE] {
            let boxes: Vec<_> = near(axes, step).map(|n| few.least_box(&n)).collect();
            if step == FINE {
                let found = boxes.iter().flatten();
                beside.extend(found.filter_map(|found| whole(found, close)));
            }
            let mut lowest = lowest(&boxes);
            lowest.sort_by(|a, b| a.volume.total_cmp(&b.volume));
            let lowest = lowest.into_iter().take(REFINED);
            let refined = lowest.map(|start| few.refine(start, 0.5 * step, 1, END * step));
            beside.extend(refined.filter_map(|found| whole(&found, minima)));
        }
    }
    beside
}

/// Directions near the last axis, row by row of a square grid.
fn near(axes: &Matrix3<f64>, step: f64) -> impl Iterator<Item = Vector3<f64>> {
    let [u, v, w] = [0, 1, 2].map(|axis| axes.column(axis).into_owned());
    places().map(move |[i, j]| w + (u * f64::from(i) + v * f64::from(j)) * step)
}

/// Whether points that are extreme in a direction may be on the outline along some direction near the last axis.
fn is_across(n: &Vector3<f64>, axes: &Matrix3<f64>) -> bool {
    n.dot(&axes.column(2)).abs() < OUTLINE
}

/// The places of a square grid, row by row.
fn places() -> impl Iterator<Item = [i32; 2]> {
    let side = -TO_EACH_SIDE..=TO_EACH_SIDE;
    side.clone()
        .flat_map(move |i| side.clone().map(move |j| [i, j]))
}

/// Of boxes of such a grid, those that no neighbour is smaller than.
fn lowest(boxes: &[Option<Candidate>]) -> Vec<Candidate> {
    let all = || places().zip(boxes);
    let is_lowest = |place: [i32; 2], found: &Candidate| {
        let is_near = |other: [i32; 2]| (0..2).all(|i| (other[i] - place[i]).abs() <= 1);
        let is_smaller = |rival: &Option<Candidate>| rival.is_some_and(|r| r.volume < found.volume);
        !all().any(|(other, rival)| is_near(other) && is_smaller(rival))
    };
    let found = all().filter_map(|(place, found)| Some((place, (*found)?)));
    let lowest = found.filter(|(place, found)| is_lowest(*place, found));
    lowest.map(|(_, found)| found).collect()
}
