//! The points that an estimate rests on, in a space in which the grain is rounder.

use crate::fit::points::without::without;
use crate::fit::prepare::Sample;
use crate::sphere::{HarmonicBasis, coefficient_count};
use nalgebra::Vector3;

/// A cloud is uneven where the squared moments of its density, of degrees 1 to [`MOMENTS`] in units of that of degree 0, add up
/// to more than this and what random places have: .45 where half of the points are eight times thinner.
const UNEVEN: f64 = 0.1;
const MOMENTS: usize = 4;
const RANDOM: f64 = 60.0;

/// Directions and radii of points after the linear map T = diag(`stretch`), radii in units of their mean.
#[derive(Debug, Clone)]
pub(crate) struct Cloud {
    /// The factors of the map along the grain's own axes; their product is 1.
    pub(crate) stretch: Vector3<f64>,
    /// Unit vectors in the stretched space.
    pub(crate) directions: Vec<Vector3<f64>>,
    /// Radii in the stretched space, in units of `mean`.
    pub(crate) radii: Vec<f64>,
    /// Semi-axes of an ellipsoid that the grain is like, in units of their geometric mean.
    pub(crate) semi_axes: Vector3<f64>,
    /// How many points each stands for, in units of the mean of that number, times the square of [f](Self::along_normal): noise
    /// is the same along the normals of a surface, so that of stretched radii is 1 / f times that.
    pub(crate) weights: Vec<f64>,
    /// Mean radius in the stretched space, in the scan's unit.
    pub(crate) mean: f64,
    /// sum of log(f |T n_i| / mean): minus the logarithm of the density that map and weights take from the likelihood.
    pub(crate) compression: f64,
}

impl Cloud {
    /// The samples (in the grain's own frame) after a map; `counts` says how many points each stands for.
    pub(crate) fn new(
        samples: &[Sample],
        counts: Option<&[f64]>,
        stretch: Vector3<f64>,
        semi_axes: Vector3<f64>,
    ) -> Self {
        let (directions, mut radii): (Vec<_>, Vec<_>) =
            Self::mapped(samples, stretch, 1.0).into_iter().unzip();
        let mut weights = counts.map_or_else(|| vec![1.0; samples.len()], <[f64]>::to_vec);
        let per_weight = weights.len() as f64 / weights.iter().sum::<f64>();
        weights.iter_mut().for_each(|weight| *weight *= per_weight);
        let weighted = radii.iter().zip(&weights).map(|(r, w)| r * w);
        let mean = weighted.sum::<f64>() / samples.len() as f64;
        radii.iter_mut().for_each(|r| *r /= mean);
        let mut compression = 0.0;
        for (i, weight) in weights.iter_mut().enumerate() {
            let f = along_normal(&directions[i], &stretch, &semi_axes);
            *weight *= f * f;
            compression += (f * radii[i] / samples[i][3]).ln();
        }
        Self {
            stretch,
            semi_axes,
            compression,
            directions,
            radii,
            weights,
            mean,
        }
    }

    /// Directions and radii, in units of `mean`, of samples after a map.
    pub(crate) fn mapped(
        samples: &[Sample],
        stretch: Vector3<f64>,
        mean: f64,
    ) -> Vec<(Vector3<f64>, f64)> {
        let mapped = samples.iter().map(|&[x, y, z, radius]| {
            let mapped = stretch.component_mul(&Vector3::new(x, y, z));
            let length = mapped.norm();
            (mapped / length, radius * length / mean)
        });
        mapped.collect()
    }

    /// Which samples are its points: these are in their order, without those that were left out.
    pub(super) fn holds(&self, samples: &[Sample]) -> Vec<bool> {
        let mapped = Self::mapped(samples, self.stretch, 1.0);
        let mut own = self.directions.iter().peekable();
        let is_own = |(n, _): &(_, f64)| own.next_if_eq(&n).is_some();
        mapped.iter().map(is_own).collect()
    }

    /// The points themselves, in units of `mean`.
    pub(crate) fn points(&self) -> Vec<Vector3<f64>> {
        let rays = self.directions.iter().zip(&self.radii);
        rays.map(|(n, radius)| n * *radius).collect()
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.radii.len()
    }

    /// f = N.T^-1 n': by how much the surface of the ellipsoid moves along its normal N where the stretched radius in the
    /// direction n' moves by one.
    pub(super) fn along_normal(&self, n: &Vector3<f64>) -> f64 {
        along_normal(n, &self.stretch, &self.semi_axes)
    }

    /// Variance of the stretched radius of a point in the direction n' whose variance along the normal is given.
    pub(super) fn of_radius(&self, n: &Vector3<f64>, variance: f64) -> f64 {
        variance / self.along_normal(n).powi(2)
    }

    /// Errors of the stretched radii of samples, along the normals.
    pub(super) fn along_normals(&self, samples: &[Sample], errors: &[f64]) -> Vec<f64> {
        let mapped = Self::mapped(samples, self.stretch, self.mean).into_iter();
        mapped
            .zip(errors)
            .map(|((n, _), e)| e * self.along_normal(&n))
            .collect()
    }

    /// Weighted sum of the squares of an error per point.
    pub(super) fn squares(&self, errors: impl IntoIterator<Item = f64>) -> f64 {
        let weighted = errors.into_iter().zip(&self.weights);
        weighted.map(|(e, w)| w * e * e).sum()
    }

    /// Weighted mean square of an error per point.
    pub(super) fn mean_square(&self, errors: impl IntoIterator<Item = f64>) -> f64 {
        self.squares(errors) / self.len() as f64
    }

    /// Errors along the normals per point, as of one that stands for the mean number: means of many points have smaller ones.
    pub(super) fn of_mean_weight(&self, errors: &[f64]) -> Vec<f64> {
        let weighted = errors.iter().zip(&self.weights);
        weighted.map(|(e, w)| e * w.sqrt()).collect()
    }

    /// Whether the points are much denser on one side than on another.
    pub(crate) fn is_uneven(&self) -> bool {
        let basis = HarmonicBasis::new(MOMENTS);
        let mut values = vec![0.0; coefficient_count(MOMENTS)];
        let mut moments = values.clone();
        for (n, weight) in self.directions.iter().zip(&self.weights) {
            basis.evaluate(n, &mut values);
            for (moment, value) in moments.iter_mut().zip(&values) {
                *moment += weight * value;
            }
        }
        let squares: f64 = moments[1..].iter().map(|moment| moment * moment).sum();
        squares > (UNEVEN + RANDOM / self.len() as f64) * moments[0].powi(2)
    }

    /// Every so many points of the cloud: samples are sorted by place, so these are spread like all.
    pub(crate) fn every(&self, step: usize) -> Self {
        fn keep<T: Copy>(values: &[T], step: usize) -> Vec<T> {
            values.iter().step_by(step).copied().collect()
        }
        let radii = keep(&self.radii, step);
        Self {
            compression: self.compression * radii.len() as f64 / self.len() as f64,
            directions: keep(&self.directions, step),
            radii,
            weights: keep(&self.weights, step),
            ..*self
        }
    }

    /// The cloud without the points at the given ascending positions.
    pub(crate) fn without(&self, left_out: &[usize]) -> Self {
        let left_out = || left_out.iter().copied();
        Self {
            directions: without(&self.directions, left_out()),
            radii: without(&self.radii, left_out()),
            weights: without(&self.weights, left_out()),
            ..*self
        }
    }
}

fn along_normal(n: &Vector3<f64>, stretch: &Vector3<f64>, semi_axes: &Vector3<f64>) -> f64 {
    let plain = n.component_div(stretch);
    let normal = plain.component_div(&semi_axes.component_mul(semi_axes));
    normal.normalize().dot(&plain)
}
