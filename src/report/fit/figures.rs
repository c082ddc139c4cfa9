//! The figures of a fitted grain, as far as they can be told.

use super::StandardErrorsRecord;
use crate::fit::{FitOptions, Fitted, NoInterval};
use crate::measure::{Survey, SurveyError};
use crate::model::Unseen;
use crate::report::measure::{Dimensions, NotMeasured, Principal};

/// Figures that rest on the whole surface.
const OF_THE_WHOLE: [&str; 4] = ["area", "volume", "principal", "dimensions"];

/// Figures of a fitted grain, and why some are missing.
#[derive(Default)]
pub(super) struct Figures {
    pub(super) area: Option<f64>,
    pub(super) volume: Option<f64>,
    pub(super) principal: Option<Principal>,
    pub(super) dimensions: Option<Dimensions>,
    pub(super) not_measured: Vec<NotMeasured>,
    pub(super) standard_errors: Option<StandardErrorsRecord>,
    pub(super) no_standard_errors: Option<String>,
}

impl Figures {
    pub(super) fn new(fitted: &Fitted, survey: &Survey, options: &FitOptions) -> Self {
        match fitted.grain.unseen().filter(|_| !options.extrapolate) {
            Some(unseen) => Self::withheld(&unseen),
            None => Self::told(fitted, survey),
        }
    }

    fn withheld(unseen: &Unseen) -> Self {
        let reason = unseen.to_string();
        let missing = OF_THE_WHOLE.map(|measure| NotMeasured {
            measure,
            reason: reason.clone(),
        });
        Self {
            not_measured: missing.into(),
            no_standard_errors: Some("there are no figures for them".into()),
            ..Self::default()
        }
    }

    fn told(fitted: &Fitted, survey: &Survey) -> Self {
        let mut not_measured = Vec::new();
        fn known<T>(
            measure: &'static str,
            found: Result<T, SurveyError>,
            missing: &mut Vec<NotMeasured>,
        ) -> Option<T> {
            found
                .map_err(|error| missing.push(NotMeasured::new(measure, &error)))
                .ok()
        }
        let area = known("area", survey.area(), &mut not_measured);
        let volume = known("volume", survey.volume(), &mut not_measured);
        let principal = known("principal", survey.principal(), &mut not_measured);
        let dimensions = known("dimensions", survey.dimensions(), &mut not_measured);
        let errors = match (survey.properties(), dimensions, principal) {
            (Ok(properties), Some(dimensions), Some(_)) => {
                fitted.standard_errors(&properties, &dimensions)
            }
            _ => Err(NoInterval::OutOfRange),
        };
        let no_standard_errors = errors.as_ref().err().map(ToString::to_string);
        Self {
            area,
            volume,
            principal: principal.map(|principal| Principal::new(&principal)),
            dimensions: dimensions.map(Dimensions::new),
            not_measured,
            standard_errors: errors.ok().map(Into::into),
            no_standard_errors,
        }
    }
}
