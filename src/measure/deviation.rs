//! How far a model is off, direction by direction: the error norms of the source.

use super::feet;
use crate::model::{Grain, StarSurface, Surface};
use nalgebra::{Point3, Vector3};

/// Norms of weighted deviations (Radvilaite 2016, equations 2.21-2.26).
///
/// A deviation is that of the model from the truth: positive where the model is too large. It is a
/// length, or, [relative](Self::relative) to the true radius, a number.
///
/// The tables of the source (3.1-3.4) give norms of *relative* deviations, under names of their own:
///
/// | printed | here | evidence |
/// |---|---|---|
/// | LS error | [`sum_of_squares`](Self::sum_of_squares) | table 3.1: threshold 3.95186 for 3.9519, q = 1 8.9523, 4.6413, 4.3758, 4.4152 for 8.9520, 4.6410, 4.3758, 4.4152 |
/// | mean deviation | [`mean_square`](Self::mean_square) | 8.9520 / 16258 = 0.000551 |
/// | maximal error | square of the largest absolute deviation, there a *length* | table 3.1, q = 1: 0.00617, 0.00602, 0.01000, 0.01124 for 0.00617, 0.00602, 0.01000, 0.01123 |
///
/// The minimal errors of tables 3.2 and 3.3 are negative, so signed deviations: [`least`](Self::least).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Sum of the weights.
    pub weight: f64,
    /// Weighted sum of squared deviations: the least-squares (LS) error.
    pub sum_of_squares: f64,
    /// Weighted mean of the absolute deviations.
    pub mean_absolute: f64,
    /// Most positive deviation: where the model is too large, or the least too small.
    pub largest: f64,
    /// Most negative deviation.
    pub least: f64,
}

impl Deviation {
    /// The norms of pairs (deviation, weight). Weights are not negative. Without any weight the means
    /// are not numbers; of a deviation that is none, all but the weight.
    pub fn of(deviations: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut norms = Self {
            weight: 0.0,
            sum_of_squares: 0.0,
            mean_absolute: 0.0,
            largest: f64::NEG_INFINITY,
            least: f64::INFINITY,
        };
        for (deviation, weight) in deviations {
            norms.weight += weight;
            norms.sum_of_squares += weight * deviation * deviation;
            norms.mean_absolute += weight * deviation.abs();
            norms.largest = norms.largest.max(deviation);
            norms.least = norms.least.min(deviation);
        }
        norms.mean_absolute /= norms.weight;
        // The larger of NaN and a number is the number.
        if norms.sum_of_squares.is_nan() {
            (norms.largest, norms.least) = (f64::NAN, f64::NAN);
        }
        norms
    }

    /// Of the radius of a model from the true one, in weighted directions, as lengths.
    pub fn radial(
        model: &(impl StarSurface + ?Sized),
        truth: &(impl StarSurface + ?Sized),
        directions: &[(Vector3<f64>, f64)],
    ) -> Self {
        let radii = directions.iter();
        Self::of(radii.map(|(n, weight)| (model.radius(n) - truth.radius(n), *weight)))
    }

    /// As [`radial`](Self::radial), each deviation divided by the true radius.
    pub fn relative(
        model: &(impl StarSurface + ?Sized),
        truth: &(impl StarSurface + ?Sized),
        directions: &[(Vector3<f64>, f64)],
    ) -> Self {
        let radii = directions.iter();
        Self::of(radii.map(|(n, weight)| (model.radius(n) / truth.radius(n) - 1.0, *weight)))
    }

    /// Of a fitted grain from places of the true surface, in the scan's frame; as lengths, all of equal weight. Of a
    /// star-shaped grain they are taken along the rays from its centre, of any other along its normals.
    pub fn from_places(grain: &Grain, places: &[Point3<f64>]) -> Self {
        let Some(star) = grain.star() else {
            let feet = feet(grain, places);
            return Self::of(feet.iter().map(|foot| (-foot.distance, 1.0)));
        };
        let centre = star.frame().centre;
        Self::of(places.iter().map(|place| {
            let from_centre = place - centre;
            let distance = from_centre.norm();
            (star.radius(&(from_centre / distance)) - distance, 1.0)
        }))
    }

    /// Weighted mean of the squared deviations.
    pub fn mean_square(&self) -> f64 {
        self.sum_of_squares / self.weight
    }

    /// Root of the weighted mean of the squared deviations.
    pub fn rms(&self) -> f64 {
        self.mean_square().sqrt()
    }

    /// The largest absolute deviation.
    pub fn greatest_absolute(&self) -> f64 {
        self.largest.max(-self.least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Ellipsoid, Sphere};
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    #[test]
    fn the_norms_of_a_few_deviations_are_their_closed_forms() {
        let norms = Deviation::of([(3.0, 1.0), (-4.0, 0.5), (0.0, 2.5)]);
        assert_abs_diff_eq!(norms.sum_of_squares, 17.0, epsilon = 1e-15);
        assert_abs_diff_eq!(norms.mean_square(), 4.25, epsilon = 1e-15);
        assert_abs_diff_eq!(norms.rms(), 4.25_f64.sqrt(), epsilon = 1e-15);
        assert_abs_diff_eq!(norms.mean_absolute, 1.25, epsilon = 1e-15);
        assert_eq!((norms.largest, norms.least), (3.0, -4.0));
        assert_eq!(norms.greatest_absolute(), 4.0);
        let unknown = Deviation::of([(3.0, 1.0), (f64::NAN, 1.0), (-4.0, 0.5)]);
        assert!(unknown.largest.is_nan() && unknown.least.is_nan() && unknown.rms().is_nan());
    }

    #[test]
    fn deviations_are_those_of_the_model_from_the_truth() {
        let model = Sphere { radius: 1.5 };
        let truth = Ellipsoid {
            semi_axes: Vector3::new(2.0, 2.0, 1.0),
        };
        let directions = [(Vector3::x(), 2.0), (Vector3::z(), 1.0)];
        let absolute = Deviation::radial(&model, &truth, &directions);
        assert_eq!((absolute.least, absolute.largest), (-0.5, 0.5));
        assert_relative_eq!(absolute.sum_of_squares, 0.75, max_relative = 1e-15);
        let relative = Deviation::relative(&model, &truth, &directions);
        assert_eq!((relative.least, relative.largest), (-0.25, 0.5));
        assert_relative_eq!(relative.sum_of_squares, 0.375, max_relative = 1e-15);
    }

    #[test]
    fn nothing_has_no_mean() {
        assert!(Deviation::of([]).rms().is_nan());
    }
}
