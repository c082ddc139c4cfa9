//! How well form and sphericity are known: products of powers of sizes that have standard errors.
//!
//! The relative error of x^a y^b is |a| dx/x + |b| dy/y at most, whatever the errors of x and of y have to do with each other, and
//! that is told.

use super::{Survey, SurveyError};
use crate::measure::{Form, Sphericity};

impl Survey<'_> {
    /// Standard errors, at most, of the ratios of [`Self::form`]. `None` where the grain tells none of its dimensions.
    ///
    /// # Errors
    ///
    /// As [`Self::form`].
    pub fn form_errors(&self) -> Result<Option<Form>, SurveyError> {
        let form = self.form()?;
        Ok(self.relative_dimension_errors()?.map(|off| Form {
            aspect_ratio: form.aspect_ratio * (off.x + off.z),
            elongation: form.elongation * (off.x + off.y),
            flatness: form.flatness * (off.y + off.z),
        }))
    }

    /// The same of [`Self::sphericity`]. `None` where the grain tells no errors of its area and volume, of its dimensions or of its
    /// spheres.
    ///
    /// # Errors
    ///
    /// As [`Self::sphericity`].
    pub fn sphericity_errors(&self) -> Result<Option<Sphericity>, SurveyError> {
        let sphericity = self.sphericity()?;
        let (Ok(errors), Some(off)) = (self.standard_errors(), self.relative_dimension_errors()?)
        else {
            return Ok(None);
        };
        let (Some(inscribed), Some(enclosing)) = (self.inscribed_error()?, self.enclosing_error()?)
        else {
            return Ok(None);
        };
        let (area, volume) = (errors.area / self.area()?, errors.volume / self.volume()?);
        let inscribed = inscribed / self.inscribed()?.radius;
        let enclosing = enclosing / self.enclosing()?.radius;
        let spheres = inscribed + enclosing;
        Ok(Some(Sphericity {
            wadell: sphericity.wadell * (2.0 / 3.0 * volume + area),
            operational: sphericity.operational * (volume / 3.0 + enclosing),
            inscribed_enclosing: sphericity.inscribed_enclosing * spheres,
            inscribed_enclosing_root: sphericity.inscribed_enclosing_root * spheres / 2.0,
            krumbein: sphericity.krumbein * (2.0 * off.x + off.y + off.z) / 3.0,
            maximum_projection: sphericity.maximum_projection * (off.x + off.y + 2.0 * off.z) / 3.0,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::egg;
    use super::*;
    use crate::measure::Scheme;
    use approx::assert_relative_eq;

    #[test]
    fn errors_of_ratios_are_the_sums_of_those_of_their_sizes() {
        let grain = egg([1.0, 3.0, 0.5, 0.25, 2.0], 0.02);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let (form, off) = (
            survey.form().unwrap(),
            survey.form_errors().unwrap().unwrap(),
        );
        assert_relative_eq!(
            off.aspect_ratio / form.aspect_ratio,
            0.025,
            max_relative = 1e-12
        );
        assert_relative_eq!(
            off.elongation / form.elongation,
            0.0075,
            max_relative = 1e-12
        );
        assert_relative_eq!(off.flatness / form.flatness, 0.0225, max_relative = 1e-12);
        let (found, off) = (
            survey.sphericity().unwrap(),
            survey.sphericity_errors().unwrap().unwrap(),
        );
        assert_relative_eq!(off.wadell / found.wadell, 0.03, max_relative = 1e-12);
        assert_relative_eq!(
            off.krumbein / found.krumbein,
            0.0325 / 3.0,
            max_relative = 1e-12
        );
        let maximum_projection = 0.0475 / 3.0;
        assert_relative_eq!(
            off.maximum_projection / found.maximum_projection,
            maximum_projection,
            max_relative = 1e-12
        );
        let inside =
            survey.inscribed_error().unwrap().unwrap() / survey.inscribed().unwrap().radius;
        let outside =
            survey.enclosing_error().unwrap().unwrap() / survey.enclosing().unwrap().radius;
        assert_relative_eq!(
            off.operational / found.operational,
            0.01 + outside,
            max_relative = 1e-12
        );
        let spheres = off.inscribed_enclosing / found.inscribed_enclosing;
        assert_relative_eq!(spheres, inside + outside, max_relative = 1e-12);
        let root = off.inscribed_enclosing_root / found.inscribed_enclosing_root;
        assert_relative_eq!(root, spheres / 2.0, max_relative = 1e-12);
    }

    #[test]
    fn without_errors_of_sizes_there_are_none_of_ratios() {
        let grain =
            egg([0.0; 5], 0.0).with_standard_errors(Err(crate::model::NoStandardErrors::NotTold));
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        assert_eq!(survey.form_errors(), Ok(None));
        assert_eq!(survey.sphericity_errors(), Ok(None));
    }
}
