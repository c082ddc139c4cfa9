//! What `grainform measure` tells of a solid.

mod faces;
mod names;
mod outline;
pub(super) mod records;
mod text;
mod withheld;

pub use faces::{FacesRecord, FillRecord};
pub use names::{Measure, UnknownMeasure};
pub use outline::{OutlineFigures, ProjectionRecord};
pub(super) use records::rows;
pub use records::{
    BoxRecord, BoxSides, CurvatureRecord, Dimensions, EllipsoidRecord, Principal, SphereRecord,
    Spheres, WithErrors,
};
pub(crate) use withheld::{Withheld, by_reason};

use super::standard_errors::{StandardErrorsRecord, recorded};
use super::unit::{Labels, Unit};
use crate::fit::{ReferenceKind, ScannedSurface};
use crate::measure::{
    Convexity, Form, ScannedBody, SideRatios, Spectrum, Sphericity, Survey, SurveyError,
};
use serde::Serialize;
use std::collections::BTreeMap;

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Measured {
    /// The scan's own faces.
    Faces,
    /// The faces that part the voxels of a segmented volume.
    Voxels,
    /// The triangulation of the points' directions.
    Directions,
    /// A fitted model.
    Model,
}

impl From<ReferenceKind> for Measured {
    fn from(kind: ReferenceKind) -> Self {
        match kind {
            ReferenceKind::Faces => Self::Faces,
            ReferenceKind::Voxels => Self::Voxels,
            ReferenceKind::Directions | ReferenceKind::Crust => Self::Directions,
        }
    }
}

/// Measures of a solid of density one: those that were asked for. Their definitions, formulas, ranges
/// and sources are at what each is made from in [`crate::measure`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MeasureReport {
    /// The scan or model.
    pub input: String,
    /// Unit of lengths, where it was told; areas and volumes are in its square and cube.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// What was measured.
    pub of: Measured,
    /// The measures.
    #[serde(flatten)]
    pub measures: Measures,
    /// What the faces of a scan enclose; absent of points and models.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<FacesRecord>,
    /// The measures that were asked for and cannot be had, as nulls.
    #[serde(flatten)]
    nulls: BTreeMap<&'static str, ()>,
    /// Measures that were asked for and cannot be had.
    pub not_measured: Vec<NotMeasured>,
    /// Standard errors of the figures that have such; `null` where none can be trusted or none is known.
    pub standard_errors: Option<StandardErrorsRecord>,
    /// Why there are none: half a sentence.
    pub no_standard_errors: Option<String>,
    /// What is odd about the input: whole sentences.
    pub warnings: Vec<String>,
}

/// The measures of a solid; absent are those that were not asked for, and `null` in the report those that
/// cannot be had.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Measures {
    /// Area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
    /// Its error by quadrature, as a share of it; absent unless the body is a union of superquadrics.
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

/// A measure that cannot be had.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct NotMeasured {
    /// Which.
    pub measure: &'static str,
    /// Why.
    pub reason: String,
}

impl MeasureReport {
    /// The report of some measures of a body; nothing else is computed.
    pub fn new(
        input: String,
        of: Measured,
        survey: &Survey<'_>,
        only: &[Measure],
        warnings: Vec<String>,
    ) -> Self {
        let all = Withheld::default();
        Self::without(&all, input, of, survey, only, warnings)
    }

    /// The report of some measures of the bodies that the faces of a scan enclose.
    pub fn of_faces(
        input: String,
        scanned: &ScannedBody,
        of: Measured,
        only: &[Measure],
        unit: Option<Unit>,
        warnings: Vec<String>,
    ) -> Self {
        let withheld = Withheld::of_faces(scanned, of, only);
        let survey = Survey::of_scanned(scanned);
        Self::without(&withheld, input, of, &survey, only, warnings)
            .in_unit(unit)
            .with_faces(scanned)
    }

    /// The same of the polyhedron through the points of a scan, without what they do not tell; `roughness`: what theirs adds to its
    /// area, as a share.
    pub fn of_points(
        input: String,
        surface: &ScannedSurface<'_>,
        survey: &Survey<'_>,
        only: &[Measure],
        roughness: f64,
        is_guess_told: bool,
        warnings: Vec<String>,
    ) -> Self {
        let withheld = Withheld::of_points(surface, roughness, is_guess_told);
        Self::without(
            &withheld,
            input,
            surface.kind.into(),
            survey,
            only,
            warnings,
        )
    }

    /// The same of a model, without what is withheld of it, which is not computed either.
    pub(crate) fn of_model(
        input: String,
        survey: &Survey<'_>,
        only: &[Measure],
        withheld: &Withheld,
    ) -> Self {
        Self::without(withheld, input, Measured::Model, survey, only, Vec::new())
    }

    fn without(
        withheld: &Withheld,
        input: String,
        of: Measured,
        survey: &Survey<'_>,
        only: &[Measure],
        warnings: Vec<String>,
    ) -> Self {
        let mut measures = Measures::default();
        let mut not_measured = Vec::new();
        let mut nulls = BTreeMap::new();
        for measure in only {
            let taken = match withheld.reason(*measure) {
                Some(reason) => Err(reason),
                None => measures
                    .take(*measure, survey)
                    .map_err(|error| error.to_string()),
            };
            if let Err(reason) = taken {
                let measure = measure.name();
                nulls.insert(measure, ());
                not_measured.push(NotMeasured { measure, reason });
            }
        }
        if measures
            .spheres
            .is_some_and(|spheres| spheres.inscribed.is_none())
            && let Err(error) = survey.inscribed()
        {
            not_measured.push(NotMeasured::new("spheres.inscribed", &error));
        }
        let errors = measures.may_have_errors().then(|| survey.standard_errors());
        let (standard_errors, no_standard_errors) = recorded(errors, &survey.axes());
        Self {
            input,
            unit: None,
            of,
            measures,
            faces: None,
            nulls,
            not_measured,
            standard_errors,
            no_standard_errors,
            warnings,
        }
    }

    /// The same with the unit of its lengths.
    pub fn in_unit(self, unit: Option<Unit>) -> Self {
        Self { unit, ..self }
    }

    /// The same with what the faces of the scan enclose.
    fn with_faces(mut self, scanned: &ScannedBody) -> Self {
        let faces = FacesRecord::new(scanned);
        let is_sum = |missing: &NotMeasured| ["area", "volume"].contains(&missing.measure);
        let sums_are_told = !self.not_measured.iter().any(is_sum);
        let sentences = faces.sentences(Labels(self.unit), sums_are_told);
        let crossing = scanned.crossing.filter(|_| scanned.defect.is_none());
        self.warnings.extend(sentences);
        self.warnings
            .extend(crossing.map(|found| format!("Of the scan, {found}.")));
        self.faces = Some(faces);
        self
    }
}

impl NotMeasured {
    pub(in crate::report) fn new(measure: &'static str, error: &SurveyError) -> Self {
        let reason = error.to_string();
        Self { measure, reason }
    }
}

fn inscribed(survey: &Survey<'_>) -> Result<SphereRecord, SurveyError> {
    Ok(SphereRecord::new(
        survey.inscribed()?,
        survey.inscribed_error()?,
    ))
}

impl Measures {
    /// Whether figures are among them that have standard errors, where these are known.
    pub(super) fn may_have_errors(&self) -> bool {
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

    fn take(&mut self, measure: Measure, survey: &Survey<'_>) -> Result<(), SurveyError> {
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
