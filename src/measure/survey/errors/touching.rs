//! How well the radii of the spheres inside and around a grain are known.

use super::known::KnownPlace;
use super::{OF_MESH, Survey, SurveyError};
use crate::measure::Ball;
use crate::spread::root_mean_square;

/// A sphere touches the surface where this is farther from it by no more than this share of the radius.
const NEAR: f64 = 0.01;

impl Survey<'_> {
    /// Standard error of the radius of the [inscribed sphere](Self::inscribed): as the surface may be off where the sphere touches
    /// it, the root mean square of that, for all these may be off alike. `None` where the grain does not tell how well its
    /// surface is known.
    ///
    /// # Errors
    ///
    /// As [`Self::inscribed`].
    pub fn inscribed_error(&self) -> Result<Option<f64>, SurveyError> {
        Ok(self.touching_error(self.unit_inscribed()?))
    }

    /// The same of the [enclosing sphere](Self::enclosing), and at least half of that of the length, which holds what the ends lack.
    ///
    /// # Errors
    ///
    /// As [`Self::enclosing`].
    pub fn enclosing_error(&self) -> Result<Option<f64>, SurveyError> {
        let touching = self.touching_error(self.unit_enclosing()?);
        let lengths = self
            .standard_errors()
            .ok()
            .map(|errors| errors.dimensions.max());
        Ok(touching
            .zip(lengths)
            .map(|(touching, length)| touching.max(0.5 * length)))
    }

    fn touching_error(&self, ball: Ball) -> Option<f64> {
        let places = self.known_places()?;
        let apart =
            |known: &KnownPlace| ((known.place - ball.centre.coords).norm() - ball.radius).abs();
        let nearest = places.iter().map(apart).fold(f64::INFINITY, f64::min);
        let is_touched = |known: &&KnownPlace| apart(known) <= nearest + NEAR * ball.radius;
        let touched = places
            .iter()
            .filter(is_touched)
            .map(|known| known.off.place);
        let error = root_mean_square(touched).hypot(OF_MESH * ball.radius);
        Some(error * self.scale.length)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::local_errors;
    use super::*;
    use crate::measure::Scheme;
    use crate::model::{Grain, StandardErrors, grain_from_json};
    use approx::assert_relative_eq;

    /// A spindle along z, of which the ends are less well known than the sides.
    fn spindle(ends: f64, sides: f64, length: f64) -> Grain {
        let text = r#"{"format": "grainform model", "version": 5, "centre": [1, 2, 3],
            "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "harmonics": [12, 0, 0, 0, 0, 0, 1, 0, 0]}"#;
        let figures = StandardErrors {
            dimensions: nalgebra::Vector3::new(length, 0.0, 0.0),
            ..StandardErrors::ZERO
        };
        let grain = grain_from_json(text).unwrap();
        let grain = grain.with_standard_errors(Ok(figures));
        let is_end = |n: &nalgebra::Vector3<f64>| n.z.abs() > 0.8;
        grain.with_local_errors(local_errors(|n| if is_end(n) { ends } else { sides }))
    }

    fn of_mesh(error: f64, radius: f64) -> f64 {
        error.hypot(OF_MESH * radius)
    }

    #[test]
    fn a_radius_is_as_uncertain_as_the_surface_where_the_sphere_touches_it() {
        let grain = spindle(0.5, 0.02, 0.3);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let [inner, outer] =
            [survey.inscribed(), survey.enclosing()].map(|ball| ball.unwrap().radius);
        let told = survey.inscribed_error().unwrap().unwrap();
        assert_relative_eq!(told, of_mesh(0.02, inner), max_relative = 1e-9);
        let told = survey.enclosing_error().unwrap().unwrap();
        assert_relative_eq!(told, of_mesh(0.5, outer), max_relative = 1e-9);
    }

    #[test]
    fn the_sphere_outside_is_no_better_known_than_the_length() {
        let grain = spindle(0.01, 0.02, 0.3);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        assert_relative_eq!(survey.enclosing_error().unwrap().unwrap(), 0.15);
    }

    #[test]
    fn nothing_is_known_of_a_surface_without_errors() {
        let grain = spindle(0.01, 0.02, 0.3).with_local_errors(None);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        assert_eq!(survey.inscribed_error().unwrap(), None);
        assert_eq!(survey.enclosing_error().unwrap(), None);
    }
}
