//! What `grainform measure` tells of a solid.

mod faces;
mod names;
mod records;
mod text;

pub use faces::{FacesRecord, FillRecord};
pub use names::{Measure, UnknownMeasure};
pub(super) use records::rows;
pub use records::{
    BoxRecord, CurvatureRecord, Dimensions, EllipsoidRecord, Principal, ProjectionRecord,
    SphereRecord, Spheres,
};

use super::unit::{Labels, Unit};
use crate::fit::ReferenceKind;
use crate::measure::{
    Convexity, Form, ScannedBody, SideRatios, Spectrum, Sphericity, Survey, SurveyError,
};
use crate::model::Unseen;
use serde::Serialize;
use std::collections::BTreeMap;

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
    /// Ratios of the sides of the box of least volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratios: Option<SideRatios>,
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
        let mut measures = Measures::default();
        let mut not_measured = Vec::new();
        let mut nulls = BTreeMap::new();
        for measure in only {
            if let Err(error) = measures.take(*measure, survey) {
                nulls.insert(measure.name(), ());
                not_measured.push(NotMeasured::new(measure.name(), &error));
            }
        }
        if measures
            .spheres
            .is_some_and(|spheres| spheres.inscribed.is_none())
            && let Err(error) = survey.inscribed()
        {
            not_measured.push(NotMeasured::new("spheres.inscribed", &error));
        }
        Self {
            input,
            unit: None,
            of,
            measures,
            faces: None,
            nulls,
            not_measured,
            warnings,
        }
    }

    /// The report of a model of which so much was not seen that its measures are guesses: none is told.
    pub fn withheld(input: String, unseen: Unseen, asked: &[Measure]) -> Self {
        let names = || asked.iter().map(|measure| measure.name());
        let reason = unseen.to_string();
        let not_measured = names().map(|measure| NotMeasured {
            measure,
            reason: reason.clone(),
        });
        Self {
            input,
            unit: None,
            of: Measured::Model,
            measures: Measures::default(),
            faces: None,
            nulls: names().map(|name| (name, ())).collect(),
            not_measured: not_measured.collect(),
            warnings: Vec::new(),
        }
    }

    /// The same without area and volume where they are among `missing`, those that a fit of the body withholds.
    #[must_use]
    pub fn without(mut self, missing: &[NotMeasured]) -> Self {
        let Measures { area, volume, .. } = &mut self.measures;
        for (name, figure) in [("area", area), ("volume", volume)] {
            if let Some(missing) = missing.iter().find(|missing| missing.measure == name)
                && figure.take().is_some()
            {
                self.nulls.insert(name, ());
                self.not_measured.push(missing.clone());
            }
        }
        self
    }

    /// The same with the unit of its lengths.
    pub fn in_unit(self, unit: Option<Unit>) -> Self {
        Self { unit, ..self }
    }

    /// The same with what the faces of the scan enclose.
    pub fn with_faces(mut self, scanned: &ScannedBody) -> Self {
        let faces = FacesRecord::new(scanned);
        let is_sum = |missing: &NotMeasured| ["area", "volume"].contains(&missing.measure);
        let sums_are_told = !self.not_measured.iter().any(is_sum);
        let sentences = faces.sentences(Labels(self.unit), sums_are_told);
        self.warnings.extend(sentences);
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

impl Measures {
    fn take(&mut self, measure: Measure, survey: &Survey<'_>) -> Result<(), SurveyError> {
        match measure {
            Measure::Area => self.area = Some(survey.area()?),
            Measure::Volume => self.volume = Some(survey.volume()?),
            Measure::Centroid => self.centroid = Some(survey.properties()?.centroid.coords.into()),
            Measure::Inertia => self.inertia = Some(rows(&survey.inertia()?)),
            Measure::Principal => self.principal = Some(Principal::new(&survey.principal()?)),
            Measure::Dimensions => self.dimensions = Some(Dimensions::new(survey.dimensions()?)),
            Measure::MinimumBox => self.minimum_box = Some(survey.minimum_box()?.into()),
            Measure::Ratios => self.ratios = Some(survey.side_ratios()?),
            Measure::Form => self.form = Some(survey.form()?),
            Measure::Spheres => {
                self.spheres = Some(Spheres {
                    inscribed: survey.inscribed().ok().map(Into::into),
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
            Measure::Curvature => {
                let error = survey.largest_curvature_error()?;
                self.curvature = Some(CurvatureRecord::new(survey.curvature()?, error));
            }
            Measure::Spectrum => self.spectrum = Some(survey.spectrum()?),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    #[test]
    fn what_a_fit_withholds_is_null_and_told_why() {
        let ball = Mesh::radial(4, |_| 1.0);
        let survey = Survey::of_mesh(&ball).unwrap();
        let of = Measured::Model;
        let asked = [Measure::Area, Measure::Volume];
        let report = MeasureReport::new(String::new(), of, &survey, &asked, Vec::new());
        let missing = NotMeasured {
            measure: "area",
            reason: "of slivers".into(),
        };
        let report = report.without(std::slice::from_ref(&missing));
        assert!(report.measures.area.is_none() && report.measures.volume.is_some());
        assert_eq!(report.not_measured[0].reason, missing.reason);
        assert!(serde_json::to_value(&report).unwrap()["measures"]["area"].is_null());
    }
}
