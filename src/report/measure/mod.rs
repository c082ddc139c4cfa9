//! What `grainform measure` tells of a solid.

mod names;
mod records;
mod text;

pub use names::{Measure, UnknownMeasure};
pub(super) use records::rows;
pub use records::{
    BoxRecord, CurvatureRecord, Dimensions, EllipsoidRecord, Principal, ProjectionRecord,
    SphereRecord, Spheres,
};

use crate::fit::ReferenceKind;
use crate::measure::{Convexity, Form, Spectrum, Sphericity, Survey, SurveyError};
use serde::Serialize;

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Measured {
    /// The scan's own faces.
    Faces,
    /// The triangulation of the points' directions.
    Directions,
    /// A fitted model.
    Model,
}

impl From<ReferenceKind> for Measured {
    fn from(kind: ReferenceKind) -> Self {
        match kind {
            ReferenceKind::Faces => Self::Faces,
            ReferenceKind::Directions => Self::Directions,
        }
    }
}

/// Measures of a solid of density one: those that were asked for. Their definitions, formulas, ranges
/// and sources are at what each is made from in [`crate::measure`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// The scan or model.
    pub input: String,
    /// What was measured.
    pub of: Measured,
    /// The measures.
    #[serde(flatten)]
    pub measures: Measures,
    /// Measures that were asked for and cannot be had.
    pub not_measured: Vec<NotMeasured>,
    /// What is odd about the input: whole sentences.
    pub warnings: Vec<String>,
}

/// The measures of a solid; absent are those that were not asked for or cannot be had.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Measures {
    /// Area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
    /// Volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
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
    /// Ratios of the extents along the principal axes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub form: Option<Form>,
    /// The largest inscribed and the smallest enclosing sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Spheres>,
    /// Sphericity in its forms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphericity: Option<Sphericity>,
    /// Roundness of the corners.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roundness: Option<f64>,
    /// Regularity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regularity: Option<f64>,
    /// Angularity index.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angularity: Option<f64>,
    /// The body against its convex hull.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convexity: Option<Convexity>,
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
    pub spectrum: Option<Spectrum>,
}

/// A measure that cannot be had.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
        let mut measures = Measures::default();
        let mut not_measured = Vec::new();
        for measure in only {
            if let Err(error) = measures.take(*measure, survey) {
                not_measured.push(NotMeasured {
                    measure: measure.name(),
                    reason: error.to_string(),
                });
            }
        }
        Self {
            input,
            of,
            measures,
            not_measured,
            warnings,
        }
    }
}

impl Measures {
    fn take(&mut self, measure: Measure, survey: &Survey<'_>) -> Result<(), SurveyError> {
        match measure {
            Measure::Area => self.area = Some(survey.properties().area),
            Measure::Volume => self.volume = Some(survey.properties().volume),
            Measure::Centroid => self.centroid = Some(survey.properties().centroid.coords.into()),
            Measure::Inertia => self.inertia = Some(rows(&survey.properties().inertia)),
            Measure::Principal => self.principal = Some(Principal::new(&survey.principal()?)),
            Measure::Dimensions => self.dimensions = Some(Dimensions::new(survey.dimensions()?)),
            Measure::MinimumBox => self.minimum_box = Some(survey.minimum_box()?.into()),
            Measure::Form => self.form = Some(survey.form()?),
            Measure::Spheres => {
                self.spheres = Some(Spheres {
                    inscribed: survey.inscribed()?.into(),
                    enclosing: survey.enclosing()?.into(),
                });
            }
            Measure::Sphericity => self.sphericity = Some(survey.sphericity()?),
            Measure::Roundness => self.roundness = Some(survey.roundness()?),
            Measure::Regularity => self.regularity = Some(survey.regularity()?),
            Measure::Angularity => self.angularity = Some(survey.angularity()?),
            Measure::Convexity => self.convexity = Some(survey.convexity()?),
            Measure::Ellipsoid => self.ellipsoid = Some(survey.ellipsoid()?.into()),
            Measure::Projections => {
                let [length, width, thickness] = survey.projections()?;
                self.projections = Some([
                    ProjectionRecord::new("length", &length),
                    ProjectionRecord::new("width", &width),
                    ProjectionRecord::new("thickness", &thickness),
                ]);
            }
            Measure::Curvature => self.curvature = Some(survey.curvature()?.into()),
            Measure::Spectrum => self.spectrum = Some(survey.spectrum()),
        }
        Ok(())
    }
}
