//! How well the roundness is known.

use super::bending::bent;
use super::chance::{Part, error_of_mean};
use super::{Survey, SurveyError};

/// Share of itself by which the roundness may be off by quadrature.
const OF_ROUNDNESS: f64 = 5e-3;

impl Survey<'_> {
    /// Standard error of the [roundness](Self::roundness): what bends, and the inscribed sphere. `None` where the grain tells no errors.
    ///
    /// # Errors
    ///
    /// As [`Self::roundness`].
    pub fn roundness_error(&self) -> Result<Option<f64>, SurveyError> {
        let roundness = self.roundness()?;
        let (Some(of_radius), Some(places)) = (self.inscribed_error()?, self.known_places()) else {
            return Ok(None);
        };
        let radius = self.unit_inscribed()?.radius;
        let corner = |[larger, _]: [f64; 2]| match larger * radius > 1.0 {
            true => [1.0, 1.0 / (larger * radius)],
            false => [0.0; 2],
        };
        let parts: Vec<Part<8>> = places.iter().map(|place| bent(place, corner)).collect();
        let of_bends = error_of_mean(&parts, 1.0).hypot(OF_ROUNDNESS * roundness);
        let share = of_radius / self.inscribed()?.radius;
        let found = self.corners()?;
        let [more, less] = [1.0 + share, 1.0 - share]
            .map(|times| (found.roundness(radius * times) - roundness).abs());
        Ok(Some(of_bends + more.max(less)))
    }

    /// The same of the [regularity](Self::regularity): half of those of roundness and sphericity.
    ///
    /// # Errors
    ///
    /// As [`Self::regularity`].
    pub fn regularity_error(&self) -> Result<Option<f64>, SurveyError> {
        self.regularity()?;
        let (roundness, spheres) = (self.roundness_error()?, self.sphericity_errors()?);
        let both = roundness.zip(spheres);
        Ok(both.map(|(roundness, spheres)| 0.5 * (roundness + spheres.inscribed_enclosing)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::bent_egg;
    use super::*;
    use crate::measure::Scheme;
    use approx::assert_relative_eq;

    #[test]
    fn roundness_is_off_as_the_surface_is_bent_and_the_sphere_inside_is() {
        let error = |place, curvature| {
            let grain = bent_egg(place, curvature);
            let survey = Survey::of_grain(&grain, Scheme::Exact);
            let error = survey.roundness_error().unwrap().unwrap();
            let regularity = survey.regularity_error().unwrap().unwrap();
            let spheres = survey
                .sphericity_errors()
                .unwrap()
                .unwrap()
                .inscribed_enclosing;
            assert_relative_eq!(regularity, 0.5 * (error + spheres), max_relative = 1e-12);
            error
        };
        let [least, bent, moved] = [error(0.0, 0.0), error(1e-4, 0.1), error(0.05, 1e-9)];
        assert!(least < 0.006, "{least}");
        assert!(bent > 3.0 * least && bent < 0.1, "{bent}");
        assert!(moved > 2.0 * least, "{moved}");
    }

    #[test]
    fn nothing_is_known_of_the_roundness_of_a_surface_without_errors() {
        let grain = bent_egg(0.0, 0.0).with_local_errors(None);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        assert_eq!(survey.roundness_error(), Ok(None));
        assert_eq!(survey.regularity_error(), Ok(None));
    }
}
