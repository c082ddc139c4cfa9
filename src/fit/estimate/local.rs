//! The error of the surface from place to place.
//!
//! One noise for all points is wrong on real scans: flat parts are better than it tells, creases and slanted parts
//! worse. How well each point is predicted from all others tells by how much. With the leverage h of a point, the
//! share of the surface there that the point itself decides, and its residual e,
//!
//! ```text
//! z = e / (s sqrt((1 - h) / w)),   h = w y'C y / s^2
//! ```
//!
//! is its error of prediction in standard deviations of that. The mean square of z of the nearest points multiplies
//! the variances of the surface and of a new point: without, flat parts would be told too unsurely, and creases too surely.
//! By how much the model differs from the estimate is known, and added as a square.

use super::outcome::Estimate;
use super::posterior::{Conditioned, Posterior};
use crate::fit::points::neighbours::Neighbours;
use crate::model::StarGrain;
use nalgebra::Vector3;

/// Points whose errors of prediction are taken together.
const VICINITY: usize = 40;

/// Least 1 - h: a point that decides all by itself says nothing of errors.
const LEAST_SPARE: f64 = 0.02;

/// Errors of the radius in a direction, standard deviations in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadiusError {
    /// Of the surface.
    pub surface: f64,
    /// Of a new point.
    pub point: f64,
}

/// The errors of prediction of an estimate's points, in standard deviations.
fn standardised(estimate: &Estimate, posterior: &Posterior<'_>) -> Vec<f64> {
    let noise = estimate.spectrum.noise();
    let residuals = posterior.residuals(&estimate.coefficients);
    let spares = estimate.spares();
    let points = spares.iter().zip(&estimate.cloud.weights);
    let errors = residuals.iter().zip(points).map(|(e, (spare, w))| {
        let spare = spare.max(LEAST_SPARE);
        e / (noise * (spare / w).sqrt())
    });
    errors.collect()
}

/// How well the radius of the stretched space is known in a direction.
pub(super) struct Local {
    /// Variance of the estimate, in squares of the mean.
    variance: f64,
    /// By how much more, or less, than that the points near by are missed.
    factor: f64,
    /// Of a plain radius to one of the stretched space, in units of the mean.
    pub(super) scale: f64,
}

impl Estimate {
    /// Errors of the radius of a grain that stands for the estimate, in directions of the grain's own frame: to those of
    /// the estimate is added, as a square, by how much the grain differs from it there.
    pub(crate) fn radius_errors(
        &self,
        grain: &StarGrain,
        directions: &[Vector3<f64>],
    ) -> Vec<RadiusError> {
        let noise = self.spectrum.noise().powi(2);
        let known = self.locals(directions, |given, n| given.directional_variances(n));
        let differences = self.differences(grain, directions).into_iter();
        known
            .into_iter()
            .zip(differences)
            .zip(directions)
            .map(|((local, difference), n)| {
                let n = self.stretched(n).normalize();
                let of_point = self.cloud.of_radius(&n, noise);
                RadiusError {
                    surface: difference.hypot(local.scatter(local.variance)),
                    point: difference.hypot(local.scatter(local.variance + of_point)),
                }
            })
            .collect()
    }

    /// By how much the plain radius of a grain differs from that of the estimate.
    fn differences(&self, grain: &StarGrain, directions: &[Vector3<f64>]) -> Vec<f64> {
        let mapped: Vec<Vector3<f64>> = directions.iter().map(|n| self.stretched(n)).collect();
        let unit: Vec<Vector3<f64>> = mapped.iter().map(Vector3::normalize).collect();
        let stretched = self.stretched_radii(&unit).into_iter().zip(&mapped);
        let own = grain.local_radii(directions).into_iter();
        own.zip(stretched)
            .map(|(radius, (stretched, mapped))| radius - stretched / mapped.norm())
            .collect()
    }

    /// How well the radius is known in directions of the grain's own frame. `variances` tells those of the estimate in the
    /// same directions of the stretched space.
    pub(super) fn locals(
        &self,
        directions: &[Vector3<f64>],
        variances: impl Fn(&Conditioned<'_>, &[Vector3<f64>]) -> Vec<f64>,
    ) -> Vec<Local> {
        let posterior = self.posterior();
        let given = self.given(&posterior);
        let errors = standardised(self, &posterior);
        let neighbours = Neighbours::new(&self.cloud.directions);

        let mapped: Vec<Vector3<f64>> = directions.iter().map(|n| self.stretched(n)).collect();
        let unit: Vec<Vector3<f64>> = mapped.iter().map(Vector3::normalize).collect();
        let known = variances(&given, &unit);
        mapped
            .iter()
            .zip(&unit)
            .zip(known)
            .map(|((mapped, n), variance)| {
                let near = neighbours.nearest(n, VICINITY);
                let squares = near.iter().map(|&i| errors[i].powi(2));
                Local {
                    variance,
                    factor: squares.sum::<f64>() / near.len().max(1) as f64,
                    scale: self.cloud.mean / mapped.norm(),
                }
            })
            .collect()
    }
}

impl Local {
    /// Standard deviation of the plain radius, with a variance of that of the stretched space.
    fn scatter(&self, variance: f64) -> f64 {
        self.scale * (self.factor * variance).sqrt()
    }

    /// Variance in the stretched space, no less than the estimate tells.
    pub(super) fn variance_at_least(&self) -> f64 {
        self.factor.max(1.0) * self.variance
    }
}
