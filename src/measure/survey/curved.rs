//! What is measured of the curvature, of surfaces that have one.

use super::{Survey, SurveyError};
use crate::measure::CurvatureStatistics;
use crate::measure::bounds::ratio;

impl Survey<'_> {
    /// Curvature over the whole surface of a grain.
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh, [`SurveyError::Edges`] of superquadrics with exponents below some 1.6, and of those that meet in creases.
    pub fn curvature(&self) -> Result<&CurvatureStatistics, SurveyError> {
        let found = self.any_curvature()?;
        match found.is_on_edges() {
            true => Err(SurveyError::Edges {
                missed: found.gauss_bonnet_error().abs(),
            }),
            false => Ok(found),
        }
    }

    /// The same, whatever its edges.
    pub(super) fn any_curvature(&self) -> Result<&CurvatureStatistics, SurveyError> {
        let surface = self.body.surface()?;
        Ok(self
            .curvature
            .get_or_init(|| CurvatureStatistics::new(surface).in_unit(self.unit.length)))
    }

    /// Roundness of the corners, see [`CurvatureStatistics::roundness`].
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn roundness(&self) -> Result<f64, SurveyError> {
        let found = self.any_curvature()?.roundness(self.inscribed()?.radius);
        Ok(ratio("roundness", found)?)
    }

    /// Regularity: the mean of roundness and of the sphericity inscribed over enclosing sphere, above 0
    /// to 1 (Cho, Dodds and Santamarina 2006).
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn regularity(&self) -> Result<f64, SurveyError> {
        let spheres = self.unit_inscribed()?.radius / self.unit_enclosing()?.radius;
        let sphericity = ratio("inscribed over enclosing radius", spheres)?;
        Ok(0.5 * (self.roundness()? + sphericity))
    }
}
