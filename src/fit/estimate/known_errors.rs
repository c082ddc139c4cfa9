//! What is known of the errors of an estimate's figures, whichever surface stands for it.

use crate::fit::outcome::figures::{Figures, INERTIA, INTEGRALS, MassList, unlist};
use crate::fit::outcome::turn::entry_variance;
use crate::measure::{Moments, PrincipalInertia};
use crate::model::StandardErrors;
use nalgebra::{Matrix6, SMatrix, Vector3};

/// Least standard error of the area, relative: of clean points of a cement particle it is off by 1e-5.
const AREA_FLOOR: f64 = 2e-5;

/// Least standard error of an extent, relative: of clean points it is off by 3e-6.
const EXTENT_FLOOR: f64 = 1e-5;

/// Share of the area's excess that the best value holds. Of spectra that end (band-limited grains) the prior
/// expects too much of it, of those that go on, as where residuals are no noise, about the right amount; this share is
/// the allowance for both.
pub(super) const EXCESS_SHARE: f64 = 0.5;

/// The best values of an estimate, and what their errors come from.
#[derive(Debug, Clone)]
pub(super) struct KnownErrors {
    pub(super) figures: Figures,
    pub(super) covariance: SMatrix<f64, INTEGRALS, INTEGRALS>,
    /// Excess of area, volume, centroid, inertia over those of the mean.
    pub(super) excess: MassList,
    /// How much of that of the area the best value holds.
    pub(super) share: f64,
    /// Area of texture between the points.
    pub(super) texture: f64,
    pub(super) principal: PrincipalInertia,
    pub(super) dimension_variances: Vector3<f64>,
    pub(super) dimension_excess: Vector3<f64>,
    /// Share by which all lengths together may be off.
    pub(super) all_over: f64,
}

impl KnownErrors {
    /// Standard errors of figures that are told of the grain.
    pub(super) fn errors(&self, told: &Figures) -> StandardErrors {
        let variance = |at: usize| self.covariance[(at, at)].max(0.0);
        let best = &self.figures;
        let square = |x: f64| x * x;
        let shifts: Moments = unlist(&self.excess);
        let half = EXCESS_SHARE * shifts.area;
        let excess = self.share * shifts.area;
        let area = square(best.area + excess - told.area)
            + square(half)
            + square(self.texture)
            + variance(0);
        let volume = square(best.volume + shifts.volume - told.volume) + variance(1);
        let centroid = Vector3::from_fn(|i, _| {
            square(best.centroid[i] + shifts.first[i] - told.centroid[i]) + variance(2 + i)
        });
        let mut inertia = unlist(&self.covariance.diagonal()).second;
        let off = best.inertia + shifts.second - told.inertia;
        inertia += off.component_mul(&off);
        let axes = &self.principal.axes;
        let moments = Vector3::from_fn(|i, _| {
            let axis = axes.column(i).into_owned();
            let shift = axis.dot(&(shifts.second * axis));
            self.entry_variance(i, i)
                + square(best.moments[i] + shift - told.moments[i])
                + square(self.repulsion(i))
        });
        let dimensions = Vector3::from_fn(|i, _| {
            self.dimension_variances[i] + square(best.dimensions[i] - told.dimensions[i])
        });
        let root = |x: f64| x.max(0.0).sqrt();
        StandardErrors {
            area: root(area).max(AREA_FLOOR * best.area),
            volume: root(volume),
            centroid: centroid.map(root),
            inertia: inertia.map(root),
            moments: moments.map(root),
            dimensions: dimensions.zip_map(&best.dimensions, |x, extent| {
                root(x).max(EXTENT_FLOOR * extent)
            }),
            dimensions_excess: self.dimension_excess,
        }
        .with_scale(self.all_over, told)
    }

    /// Variance of the entry i, j of the inertia tensor along the principal axes.
    pub(super) fn entry_variance(&self, i: usize, j: usize) -> f64 {
        entry_variance(&of_inertia(&self.covariance), &self.principal.axes, i, j)
    }

    /// The mean of a principal moment is pushed away from its neighbours': by var(I_ij) / (I_i - I_j) each, at most
    /// the standard deviation.
    pub(super) fn repulsion(&self, i: usize) -> f64 {
        let moments = self.principal.moments;
        let others = (0..3).filter(|&j| j != i);
        others
            .map(|j| {
                let variance = self.entry_variance(i, j);
                let (gap, sd) = (moments[i] - moments[j], variance.sqrt());
                match variance < sd * gap.abs() {
                    true => variance / gap,
                    false => sd.copysign(i as f64 - j as f64),
                }
            })
            .sum()
    }
}

/// The covariance of the entries of the inertia tensor.
pub(super) fn of_inertia(covariance: &SMatrix<f64, INTEGRALS, INTEGRALS>) -> Matrix6<f64> {
    covariance.fixed_view::<6, 6>(INERTIA, INERTIA).into_owned()
}
