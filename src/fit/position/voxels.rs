//! By how much a body differs from the voxels whose centres it holds.
//!
//! Moved over the lattice at random, a body of volume V holds voxels of the volume V + e. The variance of e is the sum of
//! the body's squared spectrum over the points k of the dual lattice but 0, and that of a smooth body is to first order
//! 1 / (4 pi^2 |k|^4 K), summed over the two places with the normal k, K being the curvature of Gauss there (Kendall
//! 1948). On average over all turns of the body 1 / K is S / (4 pi), S being its area:
//!
//! ```text
//! var e = S / (8 pi^3)  sum over k != 0 of  |k|^-4
//! ```
//!
//! This is as if heights were off at random, independent of each other, with the same variance per area everywhere: where the surface is
//! less curved 1 / K is larger, and so is the area that faces one way. The covariance of all integrals follows from it: each place
//! adds the squares and products of the changes that it makes. Of moments the ends of a long grain add most.
//!
//! A flat side along a layer of voxels has no curvature: all of it may lie anywhere between two layers, so that of a disc of
//! six layers the volume is known to 7 %, and its edges are rounded, as [all](rounded) are. How much of a side is flat is told by
//! the area A(d) that is within d layers of its highest place: where the side is curved A grows with d, of one that is flat it is
//! reached at once. What 2 A(1/2) is more than A(1) is taken to be flat, and moves as a whole, with a standard deviation of a twelfth
//! of a layer's square.

mod rounded;

use super::functionals::{End, by_move_of, curvature};
use super::functions::Functions;
use crate::fit::figures::INTEGRALS;
use crate::model::{Position, area_normal};
use crate::sphere::{CubeCell, GaussLegendre};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use rayon::prelude::*;
use rounded::lacking;
use std::f64::consts::PI;

/// Waves are summed up to so many times the shortest along the widest step.
const SHELLS: f64 = 8.0;

/// Places along the side of a cell at which a surface is looked at.
const NODES: usize = 16;

/// Cosine of the angle between a flat side and the axis of a length that ends on it, at least.
const ENDS: f64 = 0.9;

/// The lattice of a scan's voxels.
pub(super) struct Voxels {
    /// Normals of its layers: along the axes and the diagonals, over the distance from one layer to the next.
    layers: Vec<Vector3<f64>>,
    /// The variance of the volume of the voxels of a smooth body, over the body's area.
    miscount: f64,
    /// The side of a cube as large as a voxel.
    width: f64,
}

impl Voxels {
    /// `steps` lead from one voxel to the next, in columns. `None` if they span no volume.
    pub(super) fn new(steps: &Matrix3<f64>) -> Option<Self> {
        let dual = steps.transpose().try_inverse()?;
        let lengths: Vec<f64> = steps.column_iter().map(|step| step.norm()).collect();
        let widest = lengths.iter().copied().fold(0.0, f64::max);
        let most = SHELLS / widest;
        // A wave's number along an axis is its product with the step.
        let reach = |axis: usize| {
            let most = (most * lengths[axis]) as i32;
            -most..=most
        };
        let mut sum = 4.0 * PI * steps.determinant().abs() / most;
        for i in reach(0) {
            for j in reach(1) {
                for k in reach(2) {
                    let wave = dual * Vector3::new(i, j, k).map(f64::from);
                    let squared = wave.norm_squared();
                    if squared > 0.0 && squared <= most * most {
                        sum += squared.powi(-2);
                    }
                }
            }
        }
        let numbers =
            (0..27).map(|at| Vector3::new(at % 3, at / 3 % 3, at / 9) - Vector3::repeat(1));
        let layers = numbers.filter(|numbers| *numbers != Vector3::zeros());
        Some(Self {
            layers: layers
                .map(|numbers| dual * numbers.map(f64::from))
                .collect(),
            miscount: sum / (8.0 * PI.powi(3)),
            width: steps.determinant().abs().cbrt(),
        })
    }

    /// What they hide of a surface of such an area.
    pub(super) fn hidden(&self, functions: &Functions, surface: &Position, area: f64) -> Hidden {
        let rule = GaussLegendre::new(NODES);
        let of_cell = |cell: &CubeCell| {
            let nodes = cell.rectangle().nodes(&rule).into_iter();
            let places = nodes.map(|(n, solid_angle)| {
                let at = surface.derivatives(&n);
                let area = area_normal(&n, &at.tangents) * solid_angle;
                let curvature = curvature(&n, &at);
                let [larger, _] = curvature.principal;
                Place {
                    point: at.point,
                    area,
                    lacking: lacking(larger * self.width) * area.norm(),
                    changes: by_move_of(&curvature, &at),
                }
            });
            places.collect::<Vec<_>>()
        };
        let cells = functions.cells();
        let places: Vec<Place> = cells.par_iter().flat_map_iter(of_cell).collect();
        let sides = self.layers.par_iter();
        Hidden {
            flats: sides.filter_map(|layer| Flat::of(layer, &places)).collect(),
            scatter: places.iter().map(Place::square).sum::<SMatrix<_, _, _>>() * self.miscount,
            miscount: self.miscount,
            area,
            rounded: places.iter().map(|place| place.lacking).sum(),
            width: self.width,
        }
    }
}

/// A place of a surface.
struct Place {
    point: Vector3<f64>,
    /// Of the surface about it, along the normal.
    area: Vector3<f64>,
    /// Area that it may lack.
    lacking: f64,
    /// Of the figures, per area and move along the normal.
    changes: SVector<f64, INTEGRALS>,
}

impl Place {
    /// Squares and products of the changes of the figures by heights of variance one per area.
    fn square(&self) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        self.changes * self.changes.transpose() * self.area.norm()
    }
}

/// A flat side along layers of voxels.
struct Flat {
    layer: Vector3<f64>,
    area: f64,
    /// Of its highest place, in layers.
    top: f64,
    /// Of the figures, if it moves by a layer.
    changes: SVector<f64, INTEGRALS>,
}

/// By so much, times the radius and the length, the area is less where an edge is rounded: 2 - pi / 2.
const ROUNDED: f64 = 0.43;

/// Mean square of a place that may be anywhere between two layers.
const ANYWHERE: f64 = 1.0 / 12.0;

impl Flat {
    /// The largest on the side of a surface that faces along a layer's normal.
    fn of(layer: &Vector3<f64>, places: &[Place]) -> Option<Self> {
        let along = layer.normalize();
        let mut side: Vec<(f64, f64, &Place)> = (places.iter())
            .map(|place| (layer.dot(&place.point), along.dot(&place.area), place))
            .filter(|(_, area, _)| *area > 0.0)
            .collect();
        side.sort_unstable_by(|(one, ..), (other, ..)| other.total_cmp(one));
        let mut below = vec![0.0];
        for (_, area, _) in &side {
            below.push(below[below.len() - 1] + area);
        }
        let mut ends = [0; 2];
        let (mut flat, mut top) = (0.0, 0.0);
        for (at, (height, ..)) in side.iter().enumerate() {
            let within = [0.5, 1.0].map(|depth| height - depth);
            for (end, least) in ends.iter_mut().zip(within) {
                while *end < side.len() && side[*end].0 > least {
                    *end += 1;
                }
            }
            let [half, whole] = ends.map(|end| below[end] - below[at]);
            if 2.0 * half - whole > flat {
                (flat, top) = (2.0 * half - whole, *height);
            }
        }
        (flat > 0.0).then(|| {
            // As if all of this side moved, as far as it is flat: the sides next to it grow.
            let share = flat / below[side.len()] / layer.norm();
            let changes = side.iter().map(|(_, area, place)| place.changes * *area);
            Self {
                layer: *layer,
                area: flat,
                top,
                changes: changes.sum::<SVector<f64, INTEGRALS>>() * share,
            }
        })
    }
}

/// What voxels hide of a surface.
pub(super) struct Hidden {
    flats: Vec<Flat>,
    /// Covariance of the integrals by what is not flat.
    scatter: SMatrix<f64, INTEGRALS, INTEGRALS>,
    miscount: f64,
    area: f64,
    /// Area that edges may lack.
    rounded: f64,
    width: f64,
}

impl Hidden {
    /// Covariance of area, volume and moments.
    pub(super) fn covariance(&self) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        let flats = self.flats.iter().map(|flat| &flat.changes);
        let squares = flats.map(|changes| changes * changes.transpose() * ANYWHERE);
        squares.sum::<SMatrix<_, _, _>>() + self.scatter
    }

    /// By how much the area is less if edges are [rounded], or those that flat sides share by a layer.
    pub(super) fn edges(&self) -> f64 {
        let outlines = self.flats.iter().map(|flat| flat.changes[0].abs());
        self.rounded.max(0.5 * ROUNDED * outlines.sum::<f64>())
    }

    /// The side of a cube as large as a voxel.
    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// Mean square of the move of an end of a length, of a surface of so many functions.
    pub(super) fn square(&self, end: &End, functions: f64) -> f64 {
        let reach = self.area / functions;
        let is_under = |flat: &&Flat| {
            let depth = flat.top - flat.layer.dot(&end.point);
            depth.abs() < 0.5 && flat.layer.dot(&end.along) > ENDS * flat.layer.norm()
        };
        let flats = self.flats.iter().filter(is_under);
        let squares = flats.map(|flat| {
            let share = (flat.area / reach).min(1.0);
            share * ANYWHERE / flat.layer.norm_squared()
        });
        squares.sum::<f64>() + self.miscount / reach
    }
}

#[cfg(test)]
mod tests;
