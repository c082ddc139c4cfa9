//! Standard errors of a grain's figures.
//!
//! A figure that changes by g'dx with the coefficients x has the posterior variance g'C g. To it are added, as
//! squares,
//!
//! - the difference between the figure that is told (of the surface that stands for the estimate) and the best
//!   value of the estimate;
//! - allowances for what second order brings: half of the area's excess, for it rests on degrees that the points
//!   do not tell; [texture](super::texture) between the points, what noise along the surface [blurs](super::blur) of
//!   it, what is [flattened](super::flattened) of edges, what is missing of a [rim](super::rims) or over a [hole](crate::fit::holes); those of the [extents](super::dimension_errors); the repulsion of nearly
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
use super::flattened::Flattened;
use super::functionals::{RingSurface, combined};
use super::known_errors::{EXCESS_SHARE, KnownErrors, of_inertia};
use super::left_out::LeftOut;
use super::one_sided::off;
use super::outcome::Estimate;
use super::plateau::Plateau;
use super::posterior::Posterior;
use super::rims::Rim;
use super::texture::hidden_slopes;
use super::unresolved::{is_rough, kurtosis};
use crate::fit::holes::{Holes, random_gap};
use crate::fit::outcome::figures::{Figures, INTEGRALS, derivatives, list, mass};
use crate::fit::outcome::turn::entry_variance;
use crate::fit::points::close_pairs;
use crate::model::{NoStandardErrors, StandardErrors};
use crate::vectorize::dot;
use nalgebra::{SMatrix, SVector};
use std::f64::consts::PI;

/// Half-angle of holes, in radians, up to which 95 % intervals of area and volume cover: of 20 degrees they do (92 %
/// of 50 particles), of 40 they are up to 8 standard errors off.
const LARGEST_WITH_ERRORS: f64 = 25.0 * PI / 180.0;

impl Estimate {
    /// Standard errors of the figures that are told of the grain; nothing is computed before this is called.
    ///
    /// # Errors
    /// [`NoStandardErrors`] where they could not be trusted.
    pub(in crate::fit) fn errors(
        &self,
        told: &Figures,
    ) -> Result<StandardErrors, NoStandardErrors> {
        let holes = self.holes();
        let half_angle = holes.largest;
        if half_angle > LARGEST_WITH_ERRORS.max(random_gap(self.cloud.len())) {
            return Err(NoStandardErrors::Hole { half_angle });
        }
        let known = || self.known_errors(holes);
        of_figures(self.derived.errors.get_or_init(known), told)
    }

    /// The same, with what holes hide only as far as the prior tells it.
    pub(in crate::fit) fn errors_beside_holes(
        &self,
        told: &Figures,
    ) -> Result<StandardErrors, NoStandardErrors> {
        let known = || self.known_errors(&Holes::default());
        of_figures(self.derived.errors_beside_holes.get_or_init(known), told)
    }

    fn known_errors(&self, holes: &Holes) -> Result<KnownErrors, NoStandardErrors> {
        let posterior = self.posterior();
        let residuals = posterior.residuals(&self.coefficients);
        let of_mean_weight = self.cloud.of_mean_weight(&residuals);
        let is_rough = is_rough(&of_mean_weight);
        if self.hides_edges(is_rough) {
            let kurtosis = kurtosis(&of_mean_weight);
            return Err(NoStandardErrors::Unresolved { kurtosis });
        }
        let left_out = LeftOut::new(self, &posterior, &residuals, is_rough);
        let left_out = (is_rough || left_out.stand_out).then_some(left_out);
        let off = off(&of_mean_weight).unwrap_or(0.0);
        // Of a rough surface the points left out tell.
        let blur = Blur::new(self, &residuals);
        let hidden = if is_rough { 0.0 } else { hidden_slopes(self) };
        let slopes = hidden + blur.slopes;
        let beside = (left_out.as_ref(), holes);
        let known = known(self, &posterior, &residuals, beside, slopes);
        let known = known.ok_or(NoStandardErrors::NotFinite)?;
        let all_over = off.hypot(blur.swelling);
        let between = 0.5 * known.figures.area * self.slopes_between(&residuals);
        Ok(KnownErrors {
            all_over,
            texture: known.texture.max(between),
            ..known
        })
    }

    /// The mean square of the slopes of texture, as points close together tell it.
    fn slopes_between(&self, residuals: &[f64]) -> f64 {
        let rays = self.cloud.directions.iter();
        let rays = rays.map(|n| n.component_div(&self.cloud.stretch));
        let radii = self.cloud.radii.iter().zip(residuals);
        let places = rays
            .clone()
            .zip(radii)
            .map(|(ray, (radius, e))| ray * (radius - e));
        let off = rays.zip(residuals).map(|(ray, e)| ray * *e);
        close_pairs::slopes(&places.collect::<Vec<_>>(), &off.collect::<Vec<_>>())
    }
}

/// The standard errors of figures by what is known.
fn of_figures(
    known: &Result<KnownErrors, NoStandardErrors>,
    told: &Figures,
) -> Result<StandardErrors, NoStandardErrors> {
    let known = known.as_ref().map_err(|reason| *reason)?;
    Ok(known.errors(told))
}

/// Share of the area missing along a rim that the part has of which the points tell: the least on lenses, nearly.
const AREA_OF_RIM: f64 = 0.25;

/// `None` if the figures are not finite. `left_out` are the points where residuals are no noise; `holes` are those that are no
/// chance; `hidden_slopes` the mean square of the slopes of texture between the points.
fn known(
    estimate: &Estimate,
    posterior: &Posterior<'_>,
    residuals: &[f64],
    (left_out, holes): (Option<&LeftOut<'_>>, &Holes),
    hidden_slopes: f64,
) -> Option<KnownErrors> {
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

    let flat = Flattened::new(estimate, residuals);
    let flattened = flat.of_figures(&gradients, mass.area);
    let flattened = SVector::<f64, INTEGRALS>::from_vec(flattened);
    covariance += flattened * flattened.transpose();
    if let Some(rim) = Rim::of(estimate, residuals) {
        let with_it = rim.moments(&surface);
        let mut added = jacobian * (list(&with_it) - list(&moments));
        added[0] /= AREA_OF_RIM;
        covariance += added * added.transpose();
    }
    if !holes.is_empty() {
        let hidden = jacobian * (list(&surface.moments_with(|n| holes.hidden(n))) - list(&moments));
        covariance += hidden * hidden.transpose();
    }

    let nodes = surface.nodes.iter().zip(&surface.radii);
    let starts: Vec<_> = nodes.map(|((n, _), (r, _))| (*n, *r)).collect();
    let reach = Reach::new(estimate, &starts)?;
    let plateau = Plateau::new(estimate, &given, &surface);
    let sd =
        |i: usize, j: usize| entry_variance(&of_inertia(&covariance), &principal.axes, i, j).sqrt();
    let mass_and = (&gradients[..], &covariances[..]);
    let beside = (left_out, holes);
    let dimensions = dimensions(
        estimate,
        &given,
        (&reach, &plateau, &flat),
        &principal,
        mass_and,
        sd,
        beside,
    );
    Some(KnownErrors {
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
        all_over: 0.0,
    })
}

/// G'C G of functionals G and C G, made symmetric.
fn covariance(functionals: &[Vec<f64>], solved: &[Vec<f64>]) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
    let raw =
        SMatrix::<f64, INTEGRALS, INTEGRALS>::from_fn(|i, j| dot(&functionals[i], &solved[j]));
    (raw + raw.transpose()) * 0.5
}

#[cfg(test)]
mod tests;
