//! What is measured of the curvature, of surfaces that have one.

use super::{Survey, SurveyError};
use crate::measure::CurvatureStatistics;
use crate::measure::curvature::corners::Corners;
use crate::measure::descriptors::bounds::ratio;

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
            .get_or_init(|| CurvatureStatistics::new(surface).in_unit(self.scale.length)))
    }

    /// Roundness: the mean, by area, of the radius of curvature 1/k at the corners over the radius R of the largest inscribed sphere, a
    /// corner being where the larger principal curvature k is above 1/R. Above 0 to 1; 1 without corners.
    ///
    /// Wadell 1932 has the mean radius of the corners of a plane outline over that of its inscribed circle; with curvature, in space, it
    /// is by area (after Bullard and Garboczi 2013 and Zhao and Wang 2016).
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn roundness(&self) -> Result<f64, SurveyError> {
        let corners = self.corners()?;
        Ok(ratio(
            "roundness",
            corners.roundness(self.unit_inscribed()?.radius),
        )?)
    }

    pub(super) fn corners(&self) -> Result<&Corners, SurveyError> {
        let surface = self.body.surface()?;
        Ok(self.corners.get_or_init(|| Corners::new(surface)))
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
