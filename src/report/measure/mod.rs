//! What `grainform measure` tells of a solid.

mod faces;
mod measures;
mod names;
mod outline;
pub(super) mod records;
mod text;
mod withheld;

pub use faces::{FacesRecord, FillRecord};
pub use measures::Measures;
pub use names::{Measure, UnknownMeasure};
pub use outline::{OutlineFigures, ProjectionRecord};
pub(super) use records::rows;
pub use records::{
    BoxRecord, BoxSides, CurvatureRecord, Dimensions, EllipsoidRecord, Principal, SphereRecord,
    Spheres, WithErrors,
};
pub(crate) use withheld::{Withheld, by_reason};

use super::labels::Labels;
use super::standard_errors::{StandardErrorsRecord, recorded};
use crate::fit::{ReferenceKind, ScannedSurface};
use crate::measure::{ScannedBody, Survey, SurveyError};
use crate::unit::Unit;
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

/// Why what is measured of points with a large hole has no standard errors.
const OF_GUESS: &str = "the figures are those of the polyhedron, whose facets over what was not seen are a guess; fit the scan, and \
     measure the model, both with --extrapolate";

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
        let report = Self::without(
            &withheld,
            input,
            surface.kind.into(),
            survey,
            only,
            warnings,
        );
        let is_guess = is_guess_told && surface.unseen.is_some() && !surface.is_sparse;
        let why = |why| if is_guess { OF_GUESS.into() } else { why };
        Self {
            no_standard_errors: report.no_standard_errors.map(why),
            ..report
        }
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
