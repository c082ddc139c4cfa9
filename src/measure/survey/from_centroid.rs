//! What is measured of the radius seen from the centroid, of bodies that it sees whole.

use super::{Survey, SurveyError};
use crate::measure::descriptors::angularity::angularity;
use crate::measure::integrals::elements::{Element, mesh_elements};
use crate::measure::seen::seen_elements;
use crate::measure::{EXPANSION_DEGREE, RadialExpansion, SPECTRUM_DEGREE, Spectrum};
use nalgebra::Point3;
use std::borrow::Cow;
use std::f64::consts::PI;

/// Share of the directions from the centroid that may meet the surface more than once where the radius
/// from there is expanded or compared.
const LARGEST_OVERHANG: f64 = 0.01;

impl Survey<'_> {
    /// Angularity index: the mean over all directions from the centroid of |r - r_E| / r_E, with r_E
    /// the radius of the ellipsoid of equal moments. Zero of an ellipsoid, without an upper bound.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`], and [`SurveyError::NotStarShaped`].
    pub fn angularity(&self) -> Result<f64, SurveyError> {
        Ok(angularity(self.star_shaped()?, &self.unit_ellipsoid()?))
    }

    /// Power of the radius from the centroid per degree of spherical harmonics.
    ///
    /// # Errors
    ///
    /// As [`Self::angularity`].
    pub fn spectrum(&self) -> Result<Spectrum, SurveyError> {
        let elements = self.star_shaped()?;
        let found = self.spectrum.get_or_init(|| Spectrum::new(elements));
        Ok(self.scale.spectrum(found.clone()))
    }

    /// The radius seen from the centroid in harmonics up to a degree.
    ///
    /// # Errors
    ///
    /// As [`Self::spectrum`], and [`SurveyError::Degree`] above [`EXPANSION_DEGREE`].
    pub fn expansion(&self, degree: usize) -> Result<RadialExpansion, SurveyError> {
        if degree > EXPANSION_DEGREE {
            return Err(SurveyError::Degree { found: degree });
        }
        let found = RadialExpansion::new(&self.resolved(degree)?, degree);
        Ok(self.scale.expansion(found))
    }

    /// The elements of a surface that is seen once in each direction from the centroid.
    fn star_shaped(&self) -> Result<&[Element], SurveyError> {
        self.one_body()?;
        let centroid = self.unit_properties()?.centroid;
        let seen = || self.seen_from(&centroid, SPECTRUM_DEGREE);
        let elements = self.elements.get_or_init(seen);
        let (mut front, mut back) = (0.0, 0.0);
        for element in elements {
            let (_, _, solid_angle) = element.seen();
            *(if solid_angle > 0.0 {
                &mut front
            } else {
                &mut back
            }) += solid_angle.abs();
        }
        let share = ((front - 4.0 * PI).abs() + back) / (4.0 * PI);
        // Written so that NaN fails.
        match share <= LARGEST_OVERHANG {
            true => Ok(elements),
            false => Err(SurveyError::NotStarShaped { share }),
        }
    }

    /// The same, so small that harmonics of a degree are resolved.
    fn resolved(&self, degree: usize) -> Result<Cow<'_, [Element]>, SurveyError> {
        let elements = self.star_shaped()?;
        match degree > SPECTRUM_DEGREE && self.body.surface().is_ok() {
            true => {
                let centroid = self.unit_properties()?.centroid;
                Ok(self.seen_from(&centroid, degree).into())
            }
            false => Ok(elements.into()),
        }
    }

    /// The elements of a surface seen from a point; those of a formula resolve harmonics of a degree.
    fn seen_from(&self, point: &Point3<f64>, degree: usize) -> Vec<Element> {
        match self.body.surface() {
            Ok(surface) => {
                let shift = surface.frame().centre - point;
                seen_elements(surface, &shift, degree)
            }
            Err(_) => mesh_elements(self.mesh(), point),
        }
    }
}
