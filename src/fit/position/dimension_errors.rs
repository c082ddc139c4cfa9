//! How well length, width and thickness of a surface are known.
//!
//! To first order by the covariances of its ends and of the inertia tensor that turns its axes. To it are added, as squares,
//!
//! - that the highest of many ripples is higher than the surface;
//! - what points near the [ends](super::ends) tell, and what [voxels](super::voxels) hide there;
//! - the range of extents along axes that may lie anywhere, and what another axis of about this length is longer or shorter.

use super::ends::Ends;
use super::functionals::{End, FIGURES, FigureVector, Functionals};
use super::functions::Functions;
use super::voxels::Hidden;
use crate::fit::outcome::figures::{INERTIA, INTEGRALS, squares_by_size};
use crate::fit::outcome::turn::{OF_RANGE, by_inertia, entry_variance};
use crate::measure::{PrincipalInertia, are_apart};
use nalgebra::{Matrix6, SMatrix, Vector3};

/// Least standard errors, relative.
pub(super) const FLOOR: f64 = 2e-5;

/// Those of lengths where there are cells: ends, which few samples tell, are off by so much on clean bodies.
const FLOOR_OF_CELLS: f64 = 1e-4;

/// A surface, and how well its integrals and ends are known.
pub(super) struct Lengths<'a> {
    pub(super) functions: &'a Functions,
    pub(super) functionals: &'a Functionals,
    pub(super) covariance: &'a SMatrix<f64, FIGURES, FIGURES>,
    /// What holes may hide of them.
    pub(super) of_holes: &'a FigureVector,
    /// From the integrals to the figures.
    pub(super) jacobian: &'a SMatrix<f64, INTEGRALS, INTEGRALS>,
    /// Covariance of the entries of the inertia tensor.
    pub(super) inertia: Matrix6<f64>,
    /// Root mean square of what is not resolved.
    pub(super) unresolved: f64,
    /// What voxels hide.
    pub(super) hidden: Option<&'a Hidden>,
}

impl Lengths<'_> {
    /// Squares of the standard errors of length, width and thickness.
    pub(super) fn squares(&self, ends: &Ends<'_>) -> Vector3<f64> {
        let lengths = Vector3::from_fn(|i, _| self.functionals.length(i));
        let squares = Vector3::from_fn(|i, _| self.along(i, lengths[i], ends));
        squares_by_size(&lengths, &squares)
    }

    /// The square along a principal axis.
    fn along(&self, axis: usize, length: f64, ends: &Ends<'_>) -> f64 {
        let (extent, range) = extent(self.functionals, self.jacobian, &self.inertia, axis);
        let of_points = extent.dot(&(self.covariance * extent));
        let of_holes = extent.dot(self.of_holes);
        let mut squares = of_points + of_holes * of_holes + range * range;
        let mut higher = 0.0;
        for end in &self.functionals.ends[axis] {
            higher += self.higher(end);
            squares += ends.square(end);
            if let Some(hidden) = self.hidden {
                squares += hidden.square(&end.point, &end.along);
                squares += ends.cut_off(end, [hidden.width(), length]);
            }
        }
        let least = self.functions.cover().map_or(FLOOR, |_| FLOOR_OF_CELLS);
        squares + higher * higher + (least * length).powi(2)
    }

    /// By how much the highest of the ripples near an end is higher than the surface.
    fn higher(&self, end: &End) -> f64 {
        let variance = self.covariance[(end.figure, end.figure)].max(0.0);
        let sd = (variance + self.unresolved * self.unresolved).sqrt();
        let near = self.functionals.share_within(2.0 * sd, end);
        let rivals = near * self.functions.count() as f64;
        sd * (2.0 * rivals.ln_1p()).sqrt() + self.unresolved
    }
}

/// The change of an extent with the figures, for its ends move, and its axis turns with the inertia, the entries of which
/// have a covariance; and the error of an axis that may lie anywhere.
fn extent(
    functionals: &Functionals,
    jacobian: &SMatrix<f64, INTEGRALS, INTEGRALS>,
    inertia: &Matrix6<f64>,
    axis: usize,
) -> (FigureVector, f64) {
    let PrincipalInertia { moments, axes } = &functionals.principal;
    let sd = |i: usize, j: usize| entry_variance(inertia, axes, i, j).sqrt();
    let others = (0..3).filter(|&other| other != axis);
    let anywhere =
        others.filter(|&other| !are_apart(sd(axis, other), moments[axis] - moments[other]));
    let ranges = anywhere.map(|other| OF_RANGE * functionals.range(axis, other));
    let range = ranges.fold(0.0, f64::hypot);
    let by_inertia = by_inertia(&functionals.principal, axis, &functionals.span(axis), sd);
    let mut change = FigureVector::zeros();
    let turn = jacobian.fixed_rows::<6>(INERTIA).transpose() * by_inertia;
    change.fixed_rows_mut::<INTEGRALS>(0).copy_from(&turn);
    for end in &functionals.ends[axis] {
        change[end.figure] = 1.0;
    }
    (change, range)
}
