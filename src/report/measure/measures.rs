//! The measures of a solid, each taken when it is asked for.

use super::records::rows;
use super::{
    BoxRecord, CurvatureRecord, Dimensions, EllipsoidRecord, Measure, Principal, ProjectionRecord,
    SphereRecord, Spheres, WithErrors,
};
use crate::measure::{Convexity, Form, SideRatios, Spectrum, Sphericity, Survey, SurveyError};
use serde::Serialize;

/// The measures of a solid; absent are those that were not asked for, and `null` in the report those that
/// cannot be had.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Measures {
    /// Area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
    /// Its error by quadrature, as a share of it; absent unless the body is of superquadrics, one or several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area_error: Option<f64>,
    /// Volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
    /// Its error by quadrature, likewise; that of the moments too, as a share of the volume and the size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_error: Option<f64>,
    /// Centroid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centroid: Option<[f64; 3]>,
    /// Inertia about the centroid, along the axes of the scan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[[f64; 3]; 3]>,
    /// Principal moments and axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub principal: Option<Principal>,
    /// Extents along the principal axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Dimensions>,
    /// The box of least volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub minimum_box: Option<BoxRecord>,
    /// Ratios of the sides of the box of least volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratios: Option<WithErrors<SideRatios>>,
    /// Ratios of the extents along the principal axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<WithErrors<Form>>,
    /// The largest inscribed and the smallest enclosing sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Spheres>,
    /// Sphericity in its forms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphericity: Option<WithErrors<Sphericity>>,
    /// Roundness of the corners.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roundness: Option<f64>,
    /// Its standard error; absent where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roundness_standard_error: Option<f64>,
    /// Regularity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regularity: Option<f64>,
    /// Its standard error; absent where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regularity_standard_error: Option<f64>,
    /// Angularity index.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angularity: Option<f64>,
    /// Its standard error; absent where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angularity_standard_error: Option<f64>,
    /// The body against its convex hull.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convexity: Option<WithErrors<Convexity>>,
    /// The ellipsoid of equal moments.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ellipsoid: Option<EllipsoidRecord>,
    /// Outlines along the principal axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projections: Option<[ProjectionRecord; 3]>,
    /// Curvature over the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curvature: Option<CurvatureRecord>,
    /// Power per degree of spherical harmonics.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<WithErrors<Spectrum>>,
}

fn inscribed(survey: &Survey<'_>) -> Result<SphereRecord, SurveyError> {
    Ok(SphereRecord::new(
        survey.inscribed()?,
        survey.inscribed_error()?,
    ))
}

impl Measures {
    /// Whether figures are among them that have standard errors, where these are known.
    pub(in crate::report) fn may_have_errors(&self) -> bool {
        let sums = self.area.is_some() || self.volume.is_some() || self.centroid.is_some();
        let moments = self.inertia.is_some() || self.principal.is_some();
        let boxes = self.minimum_box.is_some() || self.ratios.is_some();
        let ratios = self.form.is_some() || self.sphericity.is_some() || self.convexity.is_some();
        let shapes =
            self.spheres.is_some() || self.ellipsoid.is_some() || self.projections.is_some();
        let corners = self.roundness.is_some() || self.regularity.is_some();
        let from_centroid = self.angularity.is_some() || self.spectrum.is_some();
        let surface = corners || from_centroid || self.curvature.is_some();
        sums || moments || boxes || ratios || shapes || surface || self.dimensions.is_some()
    }

    pub(super) fn take(
        &mut self,
        measure: Measure,
        survey: &Survey<'_>,
    ) -> Result<(), SurveyError> {
        match measure {
            Measure::Area => {
                self.area = Some(survey.area()?);
                self.area_error = survey.quadrature_errors().map(|[area, _]| area);
            }
            Measure::Volume => {
                self.volume = Some(survey.volume()?);
                self.volume_error = survey.quadrature_errors().map(|[_, volume]| volume);
            }
            Measure::Centroid => self.centroid = Some(survey.properties()?.centroid.coords.into()),
            Measure::Inertia => self.inertia = Some(rows(&survey.inertia()?)),
            Measure::Principal => self.principal = Some(Principal::new(&survey.principal()?)),
            Measure::Dimensions => self.dimensions = Some(Dimensions::new(survey.dimensions()?)),
            Measure::MinimumBox => {
                let errors = survey.minimum_box_errors()?;
                self.minimum_box = Some(BoxRecord::new(survey.minimum_box()?, errors));
            }
            Measure::Ratios => {
                let errors = survey.side_ratio_errors()?;
                self.ratios = Some(WithErrors::new(survey.side_ratios()?, errors));
            }
            Measure::Form => {
                self.form = Some(WithErrors::new(survey.form()?, survey.form_errors()?));
            }
            Measure::Spheres => {
                self.spheres = Some(Spheres {
                    inscribed: inscribed(survey).ok(),
                    enclosing: SphereRecord::new(survey.enclosing()?, survey.enclosing_error()?),
                });
            }
            Measure::Sphericity => {
                let errors = survey.sphericity_errors()?;
                self.sphericity = Some(WithErrors::new(survey.sphericity()?, errors));
            }
            Measure::Roundness => {
                self.roundness = Some(survey.roundness()?);
                self.roundness_standard_error = survey.roundness_error()?;
            }
            Measure::Regularity => {
                self.regularity = Some(survey.regularity()?);
                self.regularity_standard_error = survey.regularity_error()?;
            }
            Measure::Angularity => {
                self.angularity = Some(survey.angularity()?);
                self.angularity_standard_error = survey.angularity_error()?;
            }
            Measure::Convexity => {
                let errors = survey.convexity_errors()?;
                self.convexity = Some(WithErrors::new(survey.convexity()?, errors));
            }
            Measure::Ellipsoid => {
                let errors = survey.ellipsoid_errors()?;
                self.ellipsoid = Some(EllipsoidRecord::new(survey.ellipsoid()?, errors));
            }
            Measure::Projections => {
                let outlines = survey.projections()?;
                let errors = survey.projection_errors(&outlines)?;
                let seen = |along, i: usize| {
                    let errors = errors.as_ref().map(|errors| &errors[i]);
                    ProjectionRecord::new(along, &outlines[i], errors)
                };
                self.projections =
                    Some([seen("length", 0), seen("width", 1), seen("thickness", 2)]);
            }
            Measure::Curvature => {
                let errors = survey.curvature_errors()?;
                self.curvature = Some(CurvatureRecord::new(survey.curvature()?, errors));
            }
            Measure::Spectrum => {
                let errors = survey.spectrum_errors()?;
                self.spectrum = Some(WithErrors::new(survey.spectrum()?, errors));
            }
        }
        Ok(())
    }
}
