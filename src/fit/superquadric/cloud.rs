//! The points about their mean, in units of their mean distance from it.

use super::error::SuperquadricFitError;
use crate::scan::VoxelLattice;
use crate::sphere::{cube_place, part};
use crate::spread::{covariance, principal};
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::BTreeMap;

/// Cells of directions along an edge of the cube from which points are taken to begin with.
const CELLS: usize = 12;

/// Points that fits begin with.
const FEW: usize = 6 * CELLS * CELLS;

/// Flatter than this, as a ratio of standard deviations, points lie in a plane.
const LEAST_THICKNESS: f64 = 1e-6;

/// Points in a frame of their own, so that neither place nor size of the scan matters.
#[derive(Debug, Clone)]
pub(super) struct Cloud {
    /// The mean of the points.
    pub(super) centre: Point3<f64>,
    /// The mean distance from it.
    pub(super) size: f64,
    /// The points about the mean, over the mean distance.
    pub(super) points: Vec<Vector3<f64>>,
    /// Principal axes in the columns, the standard deviations along them ascending; the points reach farther along
    /// the positive than along the negative first and second.
    pub(super) axes: Matrix3<f64>,
    /// Standard deviations along the axes.
    pub(super) deviations: Vector3<f64>,
    /// The voxels that the points lie between.
    pub(super) voxels: Option<Voxels>,
}

/// Voxels in the unit of a cloud.
#[derive(Debug, Clone)]
pub(super) struct Voxels {
    /// From one to the next along each axis of the image, in columns.
    pub(super) steps: Matrix3<f64>,
    /// The axis along which each point lies between two.
    pub(super) axes: Vec<Option<usize>>,
}

impl Cloud {
    pub(super) fn new(
        points: &[Point3<f64>],
        lattice: Option<&VoxelLattice>,
        parameters: usize,
    ) -> Result<Self, SuperquadricFitError> {
        let least = 3 * parameters;
        if points.len() < least {
            return Err(SuperquadricFitError::TooFewPoints {
                points: points.len(),
                parameters,
                least,
            });
        }
        let is_finite = |point: &Point3<f64>| point.iter().all(|x| x.is_finite());
        if let Some(index) = points.iter().position(|point| !is_finite(point)) {
            return Err(SuperquadricFitError::NotFinite { index });
        }
        let count = points.len() as f64;
        let centre = points[0]
            + points
                .iter()
                .map(|p| (p - points[0]) / count)
                .sum::<Vector3<f64>>();
        let size = points
            .iter()
            .map(|p| (p - centre).norm() / count)
            .sum::<f64>();
        if !(size.is_normal() && (1e-100..1e100).contains(&size)) {
            return Err(SuperquadricFitError::NoVolume);
        }
        let voxels = lattice.map(|lattice| Voxels {
            steps: lattice.steps / size,
            axes: lattice.axes(points),
        });
        let points: Vec<_> = points.iter().map(|p| (p - centre) / size).collect();
        let (axes, deviations) = principal_axes(&points).ok_or(SuperquadricFitError::NoVolume)?;
        Ok(Self {
            centre,
            size,
            points,
            axes,
            deviations,
            voxels,
        })
    }

    /// Without some of its points, about the same centre.
    pub(super) fn without(&self, left_out: &[bool]) -> Self {
        let kept = |at: &usize| !left_out[*at];
        let kept: Vec<usize> = (0..self.points.len()).filter(kept).collect();
        let voxels = self.voxels.as_ref().map(|voxels| Voxels {
            axes: kept.iter().map(|&at| voxels.axes[at]).collect(),
            ..voxels.clone()
        });
        Self {
            points: kept.iter().map(|&at| self.points[at]).collect(),
            voxels,
            ..self.clone()
        }
    }

    /// The cell of directions that a point is seen in: face of the cube, row and column.
    pub(super) fn cell(&self, point: &Vector3<f64>, cells: usize) -> [usize; 3] {
        let (face, place) = cube_place(&self.axes.tr_mul(point));
        let [row, column] = place.map(|tangent| part(tangent, cells));
        [face, row, column]
    }

    /// Some [`FEW`] points, as dense everywhere as all are, whatever their order: every so many of them, cell by cell of
    /// directions and by their distance in each. Of few points all.
    pub(super) fn thinned(&self) -> Vec<Vector3<f64>> {
        let mut cells: BTreeMap<[usize; 3], Vec<Vector3<f64>>> = BTreeMap::new();
        for point in &self.points {
            cells
                .entry(self.cell(point, CELLS))
                .or_default()
                .push(*point);
        }
        for points in cells.values_mut() {
            points.sort_by(|p, q| p.norm_squared().total_cmp(&q.norm_squared()));
        }
        let every = ((self.points.len() + FEW / 2) / FEW).max(1);
        let ordered = cells.into_values().flatten();
        ordered.skip(every / 2).step_by(every).collect()
    }
}

/// Axes and standard deviations along them; `None` if the points lie in a plane.
pub(super) fn principal_axes(points: &[Vector3<f64>]) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let (mean, spread) = covariance(points.iter().copied());
    let (variances, own) = principal(&spread)?;
    let deviations = variances.map(|variance| variance.max(0.0).sqrt());
    if deviations[0].partial_cmp(&(LEAST_THICKNESS * deviations[2]))
        != Some(std::cmp::Ordering::Greater)
    {
        return None;
    }
    let longer_side = |axis: Vector3<f64>| {
        let skew: f64 = points.iter().map(|p| (p - mean).dot(&axis).powi(3)).sum();
        if skew < 0.0 { -axis } else { axis }
    };
    let axis = |i: usize| longer_side(own.column(i).into_owned());
    let (first, second) = (axis(0), axis(1));
    let axes = Matrix3::from_columns(&[first, second, first.cross(&second)]);
    Some((axes, deviations))
}
