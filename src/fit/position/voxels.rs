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
//! reached at once. What 2 A(1/2) is more than A(1) is taken to be flat, or the [terrace] of the voxels themselves where that
//! is larger. It moves as a whole, with a variance of a twelfth of a layer's square, and may lean as far as it stays
//! between the two layers.

mod rounded;
mod terrace;

use super::functionals::{by_move_of, curvature};
use super::functions::Functions;
use crate::fit::outcome::figures::INTEGRALS;
use crate::mesh::Mesh;
use crate::model::{Position, area_normal};
use crate::sphere::{CubeCell, GaussLegendre};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use rayon::prelude::*;
use rounded::lacking;
use std::f64::consts::PI;
use terrace::Terrace;

/// Waves are summed up to so many times the shortest along the widest step.
const SHELLS: f64 = 8.0;

/// Places along the side of a cell at which a surface is looked at.
const NODES: usize = 16;

/// Cosine of the angle between the normals of a flat side and of a place that is on it, at least.
const ENDS: f64 = 0.9;

/// The lattice of a scan's voxels.
pub(super) struct Voxels {
    /// Normals of its layers: along the axes and the diagonals, over the distance from one layer to the next.
    layers: Vec<Vector3<f64>>,
    /// The variance of the volume of the voxels of a smooth body, over the body's area.
    miscount: f64,
    /// From one voxel to the next, in columns.
    steps: Matrix3<f64>,
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
            steps: *steps,
            width: steps.determinant().abs().cbrt(),
        })
    }

    /// What they hide of a surface, of so many functions that points decide, laid through their boundary.
    pub(super) fn hidden(
        &self,
        functions: &Functions,
        surface: &Position,
        told: f64,
        boundary: &Mesh,
    ) -> Hidden {
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
        let flats = self.layers.par_iter().filter_map(|layer| {
            let terrace = Terrace::largest(layer, boundary);
            Flat::of(layer, terrace.as_ref(), &places)
        });
        Hidden {
            flats: flats.collect(),
            scatter: places.iter().map(Place::square).sum::<SMatrix<_, _, _>>() * self.miscount,
            miscount: self.miscount,
            area: places.iter().map(|place| place.area.norm()).sum(),
            told,
            steps: self.steps,
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
#[derive(Debug)]
struct Flat {
    layer: Vector3<f64>,
    area: f64,
    /// Of its highest place, in layers.
    top: f64,
    /// Of the figures, if it moves by a layer, ...
    changes: SVector<f64, INTEGRALS>,
    /// ... and if it leans, about either of its axes, so that its ends move by a layer.
    leaning: [SVector<f64, INTEGRALS>; 2],
}

/// By so much, times the radius and the length, the area is less where an edge is rounded: 2 - pi / 2.
const ROUNDED: f64 = 0.43;

/// Mean square of a place that may be anywhere between two layers.
const ANYWHERE: f64 = 1.0 / 12.0;

/// Mean square of the move of the ends of a side that leans about two axes and stays between two layers, where all places and
/// slopes are alike likely.
const LEANING: f64 = 1.0 / 40.0;

impl Flat {
    /// The largest on the side of a surface that faces along a layer's normal, or the terrace of its voxels.
    fn of(layer: &Vector3<f64>, terrace: Option<&Terrace>, places: &[Place]) -> Option<Self> {
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
        let (mut flat, mut top) = terrace.map_or((0.0, 0.0), |it| (it.area, it.height));
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
        let all = below[side.len()];
        (flat > 0.0 && all > 0.0).then(|| {
            // As if all of this side moved, as far as it is flat: the sides next to it grow.
            let share = (flat / all).min(1.0) / layer.norm();
            let side: Vec<(f64, &Place)> =
                side.iter().map(|&(_, area, place)| (area, place)).collect();
            let moved_by = |height: &dyn Fn(&Vector3<f64>) -> f64| {
                let changes = (side.iter())
                    .map(|(area, place)| place.changes * (area * share * height(&place.point)));
                changes.sum::<SVector<f64, INTEGRALS>>()
            };
            let (middle, slopes) = leaning(&side, &along);
            Self {
                layer: *layer,
                area: flat,
                top,
                changes: moved_by(&|_| 1.0),
                leaning: slopes.map(|slope| moved_by(&|point| slope.dot(&(point - middle)))),
            }
        })
    }

    /// Covariance of the figures.
    fn covariance(&self) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        let leaning = self
            .leaning
            .iter()
            .map(|changes| changes * changes.transpose());
        self.changes * self.changes.transpose() * ANYWHERE
            + leaning.sum::<SMatrix<_, _, _>>() * LEANING
    }
}

/// The middle of a side that faces along a unit vector, of places with areas, and the slopes along its two axes that move its ends by
/// one, as those of a rectangle as wide.
fn leaning(side: &[(f64, &Place)], along: &Vector3<f64>) -> (Vector3<f64>, [Vector3<f64>; 2]) {
    let all: f64 = side.iter().map(|(area, _)| area).sum();
    let moments = side.iter().map(|(area, place)| place.point * *area);
    let middle = moments.sum::<Vector3<f64>>() / all;
    let spread = side.iter().map(|(area, place)| {
        let aside = place.point - middle;
        let across = aside - along * along.dot(&aside);
        across * across.transpose() * (area / all)
    });
    let axes = spread.sum::<Matrix3<f64>>().symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_unstable_by(|&i, &j| axes.eigenvalues[j].total_cmp(&axes.eigenvalues[i]));
    let slope = |i: usize| {
        let end = (3.0 * axes.eigenvalues[i]).sqrt().max(f64::MIN_POSITIVE);
        axes.eigenvectors.column(i) / end
    };
    (middle, [slope(order[0]), slope(order[1])])
}

/// What voxels hide of a surface.
#[derive(Debug)]
pub(super) struct Hidden {
    flats: Vec<Flat>,
    /// Covariance of the integrals by what is not flat.
    scatter: SMatrix<f64, INTEGRALS, INTEGRALS>,
    miscount: f64,
    /// Of the surface.
    area: f64,
    /// Functions that the points decide.
    told: f64,
    steps: Matrix3<f64>,
    /// Area that edges may lack.
    rounded: f64,
    width: f64,
}

impl Hidden {
    /// Covariance of area, volume and moments.
    pub(super) fn covariance(&self) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        let flats = self.flats.iter().map(Flat::covariance);
        flats.sum::<SMatrix<_, _, _>>() + self.scatter
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

    /// Mean square of the move of a place of the surface along its unit normal: of one that functions even out over little more
    /// than the terraces of a ball of its area, all of it may lie anywhere between two voxels.
    pub(super) fn square(&self, place: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
        let reach = self.area / self.told;
        let is_under = |flat: &&Flat| {
            let depth = flat.top - flat.layer.dot(place);
            depth.abs() < 0.5 && flat.layer.dot(normal) > ENDS * flat.layer.norm()
        };
        let flats = self.flats.iter().filter(is_under);
        let squares = flats.map(|flat| {
            let share = (flat.area / reach).min(1.0);
            share * ANYWHERE / flat.layer.norm_squared()
        });
        let height = self.steps.tr_mul(normal).amax();
        let terrace = height * (PI * self.area).sqrt();
        let share = (terrace / reach).min(1.0).powi(2);
        let of_terraces = share * ANYWHERE * height * height;
        (squares.sum::<f64>() + self.miscount / reach).max(of_terraces)
    }
}

#[cfg(test)]
mod tests;
