//! Standard errors of a grain's figures.
//!
//! A figure that changes by g'dx with the coefficients x has the posterior variance g'C g. To it are added, as
//! squares,
//!
//! - the difference between the figure that is told (of the surface that stands for the estimate) and the best
//!   value of the estimate;
//! - allowances for what second order brings: half of the area's excess, for it rests on degrees that the points
//!   do not tell; [texture](super::texture) between the points, what noise along the surface [blurs](super::blur) of
//!   it, what is missing of a [rim](super::rims) or over a [hole](super::hole); those of the [extents](super::dimension_errors); the repulsion of nearly
//!   equal moments;
//! - a floor, for rounding and quadrature.
//!
//! Where what is left of the points, or of one of them, is no noise, the variances grow by what
//! [leaving them out](super::left_out) tells.
//!
//! There are none where neither can be trusted: beside a large hole, and of bodies with
//! [edges](super::unresolved) that are symmetric or have flat sides.

use super::blur::Blur;
use super::dimension_errors::dimensions;
use super::dimensions::Reach;
use super::functionals::{RingSurface, combined};
use super::left_out::LeftOut;
use super::one_sided::off;
use super::outcome::Estimate;
use super::posterior::Posterior;
use super::rims::Rim;
use super::texture::hidden_slopes;
use super::unresolved::{is_rough, kurtosis};
use crate::fit::figures::{Figures, INERTIA, INTEGRALS, MassList, derivatives, list, mass, unlist};
use crate::fit::gaps::random_gap;
use crate::fit::hole::Holes;
use crate::fit::turn::entry_variance;
use crate::measure::{Moments, PrincipalInertia};
use crate::model::{NoInterval, StandardErrors};
use crate::vectorize::dot;
use nalgebra::{Matrix6, SMatrix, Vector3};
use std::f64::consts::PI;

/// Half-angle of holes, in radians, up to which 95 % intervals of area and volume cover: of 20 degrees they do (92 %
/// of 50 particles), of 40 they are up to 8 standard errors off.
const LARGEST_HOLE: f64 = 25.0 * PI / 180.0;

impl Estimate {
    /// Standard errors of the figures that are told of the grain; nothing is computed before this is called.
    ///
    /// # Errors
    /// [`NoInterval`] where they could not be trusted.
    pub(in crate::fit) fn errors(&self, told: &Figures) -> Result<StandardErrors, NoInterval> {
        let holes = self.holes();
        let half_angle = holes.largest;
        if half_angle > LARGEST_HOLE.max(random_gap(self.cloud.len())) {
            return Err(NoInterval::Hole { half_angle });
        }
        self.errors_with(told, holes)
    }

    /// The same, with what holes hide only as far as the prior tells it.
    pub(in crate::fit) fn errors_beside_holes(
        &self,
        told: &Figures,
    ) -> Result<StandardErrors, NoInterval> {
        self.errors_with(told, &Holes::default())
    }

    fn errors_with(&self, told: &Figures, holes: &Holes) -> Result<StandardErrors, NoInterval> {
        let posterior = self.posterior();
        let residuals = posterior.residuals(&self.coefficients);
        let of_mean_weight = self.cloud.of_mean_weight(&residuals);
        let is_rough = is_rough(&of_mean_weight);
        if self.hides_edges(is_rough) {
            let kurtosis = kurtosis(&of_mean_weight);
            return Err(NoInterval::Unresolved { kurtosis });
        }
        let left_out = LeftOut::new(self, &posterior, &residuals, is_rough);
        let left_out = (is_rough || left_out.stand_out).then_some(left_out);
        // Points on one side of it.
        let off = off(&of_mean_weight).unwrap_or(0.0);
        // Of a rough surface the points left out tell.
        let blur = Blur::new(self, &residuals);
        let hidden = if is_rough { 0.0 } else { hidden_slopes(self) };
        let slopes = hidden + blur.slopes;
        let beside = (left_out.as_ref(), holes);
        let best = Best::new(self, &posterior, &residuals, beside, slopes);
        let best = best.ok_or(NoInterval::NotFinite)?;
        let errors = best.errors(told).with_scale(off, told);
        Ok(blur.with_swelling(errors, told))
    }
}

/// Least standard error of the area, relative: of clean points of a cement particle it is off by 1e-5.
const AREA_FLOOR: f64 = 2e-5;

/// Least standard error of an extent, relative: of clean points it is off by 3e-6.
const EXTENT_FLOOR: f64 = 1e-5;

/// Share of the area's excess that the best value holds. Of spectra that end (band-limited grains) the prior
/// expects too much of it, of those that go on, as where residuals are no noise, about the right amount; this share is
/// the allowance for both.
const EXCESS_SHARE: f64 = 0.5;

/// Share of the area missing along a rim that the part has of which the points tell: the least on lenses, nearly.
const AREA_OF_RIM: f64 = 0.25;

/// The best values of an estimate, and what their errors come from.
pub(super) struct Best {
    pub(super) figures: Figures,
    covariance: SMatrix<f64, INTEGRALS, INTEGRALS>,
    /// Excess of area, volume, centroid, inertia over those of the mean.
    excess: MassList,
    /// How much of that of the area the best value holds.
    share: f64,
    /// Area of texture between the points.
    texture: f64,
    principal: PrincipalInertia,
    dimension_variances: Vector3<f64>,
    dimension_excess: Vector3<f64>,
}

impl Best {
    /// `None` if the figures are not finite. `left_out` are the points where residuals are no noise; `holes` are those that are no chance; `hidden_slopes` the
    /// mean square of the slopes of texture between the points.
    pub(super) fn new(
        estimate: &Estimate,
        posterior: &Posterior<'_>,
        residuals: &[f64],
        (left_out, holes): (Option<&LeftOut<'_>>, &Holes),
        hidden_slopes: f64,
    ) -> Option<Self> {
        let surface = RingSurface::new(estimate);
        let moments = surface.moments();
        let (mass, principal) = mass(&moments);
        let principal = principal?;
        let jacobian = derivatives(&moments);
        let excess = jacobian * list(&surface.excess(estimate));

        let given = estimate.given(posterior);
        let integrals = surface.gradients();
        let gradients: Vec<Vec<f64>> = (0..INTEGRALS)
            .map(|row| combined(integrals.iter(), jacobian.row(row).iter()))
            .collect();
        let covariances = given.covariances(&gradients);
        let mut covariance = covariance(&gradients, &covariances);
        if let Some(left_out) = left_out {
            covariance += left_out.covariance(&covariances);
        }

        if let Some(rim) = Rim::of(estimate, residuals) {
            let with_it = rim.moments(&surface);
            let mut added = jacobian * (list(&with_it) - list(&moments));
            added[0] /= AREA_OF_RIM;
            covariance += added * added.transpose();
        }
        if !holes.is_empty() {
            let hidden =
                jacobian * (list(&surface.moments_with(|n| holes.hidden(n))) - list(&moments));
            covariance += hidden * hidden.transpose();
        }

        let nodes = surface.nodes.iter().zip(&surface.radii);
        let starts: Vec<_> = nodes.map(|((n, _), (r, _))| (*n, *r)).collect();
        let reach = Reach::new(estimate, &starts)?;
        let sd = |i: usize, j: usize| {
            entry_variance(&of_inertia(&covariance), &principal.axes, i, j).sqrt()
        };
        let mass_and = (&gradients[..], &covariances[..]);
        let beside = (left_out, holes);
        let dimensions = dimensions(estimate, &given, &reach, &principal, mass_and, sd, beside);
        Some(Self {
            figures: Figures {
                area: mass.area,
                volume: mass.volume,
                centroid: mass.centroid.coords,
                inertia: mass.inertia,
                moments: principal.moments,
                dimensions: dimensions.lengths,
            },
            covariance,
            excess,
            share: left_out.map_or(EXCESS_SHARE, |_| 1.0),
            texture: surface.excess_of(0.0, hidden_slopes).area,
            principal,
            dimension_variances: dimensions.variances,
            dimension_excess: dimensions.excess,
        })
    }

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
    }

    /// Variance of the entry i, j of the inertia tensor along the principal axes.
    fn entry_variance(&self, i: usize, j: usize) -> f64 {
        entry_variance(&of_inertia(&self.covariance), &self.principal.axes, i, j)
    }

    /// The mean of a principal moment is pushed away from its neighbours': by var(I_ij) / (I_i - I_j) each, at most
    /// the standard deviation.
    fn repulsion(&self, i: usize) -> f64 {
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
fn of_inertia(covariance: &SMatrix<f64, INTEGRALS, INTEGRALS>) -> Matrix6<f64> {
    covariance.fixed_view::<6, 6>(INERTIA, INERTIA).into_owned()
}

/// G'C G of functionals G and C G, made symmetric.
fn covariance(functionals: &[Vec<f64>], solved: &[Vec<f64>]) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
    let raw =
        SMatrix::<f64, INTEGRALS, INTEGRALS>::from_fn(|i, j| dot(&functionals[i], &solved[j]));
    (raw + raw.transpose()) * 0.5
}

#[cfg(test)]
mod tests;
