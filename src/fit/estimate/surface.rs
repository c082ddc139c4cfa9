//! An estimate as a surface: its radii, its expansion cut at a degree, and how sure it is as a whole.

use super::outcome::{Dense, Estimate, spare, variance};
use crate::model::{Stretch, Whole};
use crate::sphere::{Interpolant, RingGrid, coefficient_count};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// An expansion resolves its points when what it leaves out is below this share of the estimate's own standard deviation ...
const RESOLVED: f64 = 0.1;

/// ... or below this share of the mean radius.
const LEAST_RESOLUTION: f64 = 1e-6;

impl Estimate {
    /// The linear map of the space in which the radius is expanded.
    pub(crate) fn stretch(&self) -> Stretch {
        Stretch::new(self.cloud.stretch).expect("the axes of a solid are finite and positive")
    }

    /// Standard deviation of the noise of one point along the normals, in the scan's unit.
    pub(crate) fn noise(&self) -> f64 {
        self.noise_of_points() * self.cloud.mean
    }

    /// The same in the stretched space, in units of the mean radius.
    pub(super) fn noise_of_points(&self) -> f64 {
        match self.dense {
            Some(Dense { points, residuals }) => (residuals / spare(&self.unlearnt, points)).sqrt(),
            None => self.spectrum.noise(),
        }
    }

    /// Standard deviation of the radius, as root mean square over all directions, in the scan's unit.
    pub(crate) fn deviation(&self) -> f64 {
        variance(&self.spectrum, &self.unlearnt).sqrt() * self.plain_length()
    }

    /// Distance of its points along the normals, as root mean square, in the scan's unit.
    pub(crate) fn residual(&self) -> f64 {
        self.mean_square().sqrt() * self.cloud.mean
    }

    /// The same along the rays, as a share of the radius in each direction; of patches in the ratio of the points' to theirs.
    pub(crate) fn relative_residual(&self) -> f64 {
        let residuals = self.residuals();
        let relative = residuals.iter().map(|e| e * e).sum::<f64>() / residuals.len() as f64;
        let ratio = self.dense.as_ref().map_or(1.0, |dense| {
            dense.residuals / self.cloud.mean_square(residuals).max(f64::MIN_POSITIVE)
        });
        (relative * ratio).sqrt()
    }

    /// Measured less fitted radii of its points, in the stretched space and in units of the mean radius.
    pub(super) fn residuals(&self) -> Vec<f64> {
        self.posterior().residuals(&self.coefficients)
    }

    /// Mean square of its points' residuals along the normals, in units of the mean radius.
    fn mean_square(&self) -> f64 {
        match self.dense {
            Some(Dense { residuals, .. }) => residuals,
            None => self.posterior().mean_square(&self.coefficients),
        }
    }

    /// Share of the points that is not spent on coefficients: 1 - the mean of their leverages.
    pub(super) fn mean_spare(&self) -> f64 {
        let points = self
            .dense
            .map_or(self.cloud.len() as f64, |dense| dense.points);
        spare(&self.unlearnt, points)
    }

    /// What an expansion may leave out and still be the estimate itself, in the scan's unit.
    pub(crate) fn resolution(&self) -> f64 {
        (RESOLVED * self.deviation()).max(LEAST_RESOLUTION * self.cloud.mean)
    }

    /// Radii in directions of the stretched space, in the scan's unit there.
    pub(crate) fn stretched_radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        self.stretched_radius().values(directions)
    }

    /// How far the surface is beyond places in the grain's own frame, along their rays, in the scan's unit.
    pub(in crate::fit) fn beyond(&self, places: &[Vector3<f64>]) -> Vec<f64> {
        let stretched: Vec<_> = places.iter().map(|place| self.stretched(place)).collect();
        let directions: Vec<_> = stretched.iter().map(Vector3::normalize).collect();
        let radii = self.stretched_radii(&directions).into_iter();
        let both = radii.zip(stretched.iter().zip(places));
        both.map(|(radius, (stretched, place))| (radius / stretched.norm() - 1.0) * place.norm())
            .collect()
    }

    /// The radius over directions of the stretched space, in the scan's unit there.
    pub(crate) fn stretched_radius(&self) -> Interpolant {
        let scaled: Vec<f64> = self
            .coefficients
            .iter()
            .map(|x| x * self.cloud.mean)
            .collect();
        Interpolant::new(self.degree, &scaled)
    }

    /// The expansion up to a degree.
    pub(crate) fn expansion(&self, degree: usize) -> Whole {
        let kept = &self.coefficients[..coefficient_count(degree.min(self.degree))];
        let scaled = kept.iter().map(|x| x * self.cloud.mean).collect();
        Whole::new(scaled).expect("finite radii give finite coefficients")
    }

    /// The expansion as the points tell it, without the pull of the prior, of the degrees that they tell for the most part.
    pub(super) fn unshrunk(&self) -> Whole {
        let whole = (0..=self.degree).flat_map(|l| {
            let times = (1.0 + self.taken(l, 1.0)) * self.cloud.mean;
            let own = &self.coefficients[l * l..coefficient_count(l)];
            own.iter().map(move |x| x * times)
        });
        Whole::new(whole.collect()).expect("finite radii give finite coefficients")
    }

    /// Root mean square, over all plain directions, of what the expansion up to a degree leaves out of the radius.
    pub(crate) fn truncation(&self, degree: usize) -> f64 {
        self.truncation_on(&self.grid(), degree)
    }

    /// The lowest degree whose expansion leaves out no more than `limit`.
    pub(crate) fn least_degree(&self, limit: f64) -> usize {
        let grid = self.grid();
        let (mut low, mut high) = (0, self.degree);
        while low < high {
            let middle = (low + high) / 2;
            match self.truncation_on(&grid, middle) <= limit {
                true => high = middle,
                false => low = middle + 1,
            }
        }
        high
    }

    fn grid(&self) -> RingGrid {
        RingGrid::new(self.degree, self.degree + 1)
    }

    fn truncation_on(&self, grid: &RingGrid, degree: usize) -> f64 {
        let mut tail = self.coefficients.clone();
        tail[..coefficient_count(degree.min(self.degree))].fill(0.0);
        let values = grid.synthesis(&tail);
        let squares = grid.nodes().into_iter().zip(values);
        let sum: f64 = squares
            .map(|((n, solid_angle), (value, _))| solid_angle * self.weight(&n) * value * value)
            .sum();
        (sum / (4.0 * PI)).sqrt() * self.cloud.mean
    }

    /// Weight of a squared error of the stretched radius per solid angle of the stretched space, so that its integral is
    /// that of the squared error of the plain radius over plain directions: a difference d' of the stretched radius is one of
    /// d' |T^-1 n'| of the plain one, and the solid angle is det(T^-1) / |T^-1 n'|^3 times as large.
    pub(crate) fn weight(&self, n: &Vector3<f64>) -> f64 {
        1.0 / (self.length(n) * self.cloud.stretch.product())
    }

    /// How long one of the stretched radius in a direction of the stretched space is in plain space, |T^-1 n'|.
    pub(crate) fn length(&self, n: &Vector3<f64>) -> f64 {
        n.component_div(&self.cloud.stretch).norm()
    }

    /// Root mean square plain length, over all plain directions, of the mean radius of the stretched space.
    fn plain_length(&self) -> f64 {
        let grid = RingGrid::new(0, MEAN_RINGS);
        let nodes = grid.nodes().into_iter();
        let sum: f64 = nodes
            .map(|(n, solid_angle)| solid_angle * self.weight(&n))
            .sum();
        (sum / (4.0 * PI)).sqrt() * self.cloud.mean
    }
}

/// Rings by which the mean weight is found: to 1e-6 of bodies three times as long as wide.
const MEAN_RINGS: usize = 24;

#[cfg(test)]
mod tests;
