//! How well what is measured of the radius seen from the centroid is known.

use super::chance::{Part, error_of_mean};
use super::known::KnownPlace;
use super::{Survey, SurveyError};
use crate::measure::{EquivalentEllipsoid, Spectrum};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Least cosine between the direction in which a place is seen and the normal: a radius is not told to be off by more than some times
/// as much as the surface.
const STEEPEST: f64 = 0.1;

/// Share of itself by which an angularity may be off by quadrature.
const OF_ANGULARITY: f64 = 3e-4;

/// A place as it is seen from the centroid.
struct Seen {
    direction: Vector3<f64>,
    distance: f64,
    solid_angle: f64,
    /// How far the distance may be off.
    off: f64,
    /// The solid angle round it that is off alike.
    patch: f64,
}

impl Seen {
    fn new(known: &KnownPlace, centroid: &Vector3<f64>) -> Self {
        let place = known.place - centroid;
        let distance = place.norm();
        let direction = place / distance;
        let cosine = direction.dot(&known.normal).max(STEEPEST);
        let per_area = cosine / (distance * distance);
        Self {
            direction,
            distance,
            solid_angle: known.area * per_area,
            off: known.off.place / cosine,
            patch: (known.patch * per_area).min(4.0 * PI),
        }
    }
}

impl Survey<'_> {
    /// Standard error of the [angularity](Self::angularity): by chance, of patches of the surface that have nothing to do with each other,
    /// what all of them add, and all of what the ellipsoid is off by, which is no more than the radius is in the mean. `None` where the
    /// grain tells no errors.
    ///
    /// # Errors
    ///
    /// As [`Self::angularity`].
    pub fn angularity_error(&self) -> Result<Option<f64>, SurveyError> {
        let angularity = self.angularity()?;
        let (Some(off), Some(seen)) = (self.ellipsoid_errors()?, self.seen()?) else {
            return Ok(None);
        };
        let ellipsoid: EquivalentEllipsoid = self.unit_ellipsoid()?;
        let of_ellipsoid = off.component_div(&self.ellipsoid()?.semi_axes).max();
        let solid_angle: f64 = seen.iter().map(|seen| seen.solid_angle).sum();
        let of_radius = |seen: &Seen| seen.solid_angle * seen.off / seen.distance;
        let of_radius = seen.iter().map(of_radius).sum::<f64>() / solid_angle;
        let parts: Vec<Part<2>> = seen
            .iter()
            .map(|seen| {
                let expected = ellipsoid.radius(&seen.direction);
                let [apart, off] = [seen.distance / expected - 1.0, seen.off / expected];
                Part {
                    measure: seen.solid_angle,
                    patch: seen.patch,
                    told: [1.0, apart.abs()],
                    may_be: [off, -off].map(|off| [1.0, (apart + off).abs()]),
                }
            })
            .collect();
        let error = error_of_mean(&parts, 0.0).hypot(OF_ANGULARITY * angularity);
        Ok(Some(error + of_ellipsoid.min(of_radius)))
    }

    /// Standard errors of the [spectrum](Self::spectrum): of each coefficient that of an error of the radius that is off alike over patches
    /// and has all degrees alike, which adds to the power of each; of degree 0 also what the size is off by. `None` where the
    /// grain tells no errors.
    ///
    /// # Errors
    ///
    /// As [`Self::spectrum`].
    pub fn spectrum_errors(&self) -> Result<Option<Spectrum>, SurveyError> {
        let found = self.spectrum()?;
        let (Ok(errors), Some(seen)) = (self.standard_errors(), self.seen()?) else {
            return Ok(None);
        };
        let of_place = |seen: &Seen| seen.off.powi(2) * seen.patch * seen.solid_angle;
        let variance = seen.iter().map(of_place).sum::<f64>() / (4.0 * PI);
        let variance = self.scale.area(variance);
        let of_size = errors.volume / (3.0 * self.volume()?);
        let mean = found.power[0].sqrt();
        let share = variance.sqrt().hypot(mean * of_size) / mean;
        let orders = |degree: usize| (2 * degree + 1) as f64;
        let powers = || found.power.iter().enumerate();
        let of_power = |(degree, power): (usize, &f64)| match degree {
            0 => 2.0 * power * share,
            _ => (4.0 * power * variance + 3.0 * (orders(degree) * variance).powi(2)).sqrt(),
        };
        let of_amplitude = |(degree, power): (usize, &f64)| {
            let amplitude = power.sqrt();
            let more = (power + orders(degree) * variance).sqrt() - amplitude;
            match degree {
                0 => 0.0,
                _ => (variance.sqrt().hypot(more) + amplitude * share) / mean,
            }
        };
        Ok(Some(Spectrum {
            power: powers().map(of_power).collect(),
            relative_amplitude: powers().map(of_amplitude).collect(),
        }))
    }

    /// Places all over the surface, seen from the centroid.
    fn seen(&self) -> Result<Option<Vec<Seen>>, SurveyError> {
        let Some(places) = self.known_places() else {
            return Ok(None);
        };
        let centroid = self.unit_properties()?.centroid.coords;
        let seen = places.iter().map(|place| Seen::new(place, &centroid));
        Ok(Some(seen.collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{bent_egg, egg};
    use super::*;
    use crate::measure::Scheme;
    use approx::assert_relative_eq;

    /// A coefficient has the variance h² w of an error h that is alike over solid angles w.
    #[test]
    fn powers_are_off_as_each_coefficient_is_and_by_what_all_of_them_add() {
        let (place, curvature) = (1e-3, 1e-2);
        let grain = bent_egg(place, curvature);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let (found, off) = (
            survey.spectrum().unwrap(),
            survey.spectrum_errors().unwrap().unwrap(),
        );
        let radius = survey.mean_radius().unwrap();
        let variance = place * place * 8.0 * PI * place / curvature / (radius * radius);
        let of_two = (4.0 * found.power[2] * variance).sqrt();
        assert_relative_eq!(off.power[2], of_two, max_relative = 0.05);
        // Degree 16 of the egg has no power: what is told there is all error.
        let none = ((33.0 * variance).sqrt()).hypot(variance.sqrt()) / found.power[0].sqrt();
        assert_relative_eq!(off.relative_amplitude[16], none, max_relative = 0.1);
        assert_eq!(off.relative_amplitude[0], 0.0);
    }

    /// The size is off by a third of the volume's four percent.
    #[test]
    fn the_power_of_degree_zero_is_off_as_the_size_is() {
        let grain = egg([0.0, 4.0, 0.0, 0.0, 0.0], 0.0);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let off = survey.spectrum_errors().unwrap().unwrap();
        let share = off.power[0] / survey.spectrum().unwrap().power[0];
        assert_relative_eq!(share, 0.08 / 3.0, max_relative = 1e-3);
    }

    #[test]
    fn angularity_is_off_where_the_radius_is_that_of_the_ellipsoid() {
        let told = |place| {
            let grain = bent_egg(place, 1e-2);
            let survey = Survey::of_grain(&grain, Scheme::Exact);
            let ellipsoid = survey.ellipsoid_errors().unwrap().unwrap();
            let share = ellipsoid.component_div(&survey.ellipsoid().unwrap().semi_axes);
            survey.angularity_error().unwrap().unwrap() - share.max()
        };
        let radius = Survey::of_grain(&egg([0.0; 5], 0.0), Scheme::Exact)
            .mean_radius()
            .unwrap();
        assert!(told(0.0) < 1e-4, "{}", told(0.0));
        // Far more than it is apart: |x| is expected to be as large as the error.
        assert_relative_eq!(told(0.3 * radius), 0.3, max_relative = 0.1);
        let none = bent_egg(0.1, 0.1).with_local_errors(None);
        assert_eq!(
            Survey::of_grain(&none, Scheme::Exact).angularity_error(),
            Ok(None)
        );
    }
}
