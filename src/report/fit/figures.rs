//! The figures of a fitted grain, as far as they can be told.

use super::StandardErrorsRecord;
use crate::fit::{FitOptions, Fitted, NoInterval};
use crate::measure::{Survey, SurveyError};
use crate::model::Unseen;
use crate::report::measure::{Dimensions, NotMeasured, Principal};
use crate::report::number::percent;

/// Figures that rest on the whole surface.
const OF_THE_WHOLE: [&str; 4] = ["area", "volume", "principal", "dimensions"];

/// By how much area or volume of a surface without standard errors may differ from those of the closed faces that it
/// was fitted to. With standard errors, of 28 scans of grains and stones it is 1.8 % and 2.6 % at most; without, of
/// cones, boxes and the like 3.5 %, and 9 to 12 % where the surface ripples between slivers and on thin plates.
const LARGEST_DIFFERENCE: f64 = 0.05;

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

    /// Withholds area and volume that no standard error vouches for and that the scan's own faces contradict:
    /// `differences` are those from the faces, as shares.
    pub(super) fn withhold_contradicted(&mut self, differences: [Option<f64>; 2]) {
        if self.standard_errors.is_some() {
            return;
        }
        let figures = [("area", &mut self.area), ("volume", &mut self.volume)];
        for ((measure, figure), difference) in figures.into_iter().zip(differences) {
            let Some(difference) = difference.filter(|share| share.abs() > LARGEST_DIFFERENCE)
            else {
                continue;
            };
            *figure = None;
            let reason = format!(
                "that of the surface is {} off that of the closed faces it was fitted to, and no standard error \
                 vouches for it; measure the scan itself",
                percent(difference)
            );
            self.not_measured.push(NotMeasured { measure, reason });
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of_edges() -> Figures {
        Figures {
            area: Some(10.3),
            volume: Some(2.1),
            no_standard_errors: Some("edges".into()),
            ..Figures::default()
        }
    }

    #[test]
    fn what_closed_faces_contradict_and_no_error_vouches_for_is_withheld() {
        let mut figures = of_edges();
        figures.withhold_contradicted([Some(0.094), Some(-0.004)]);
        assert_eq!((figures.area, figures.volume), (None, Some(2.1)));
        let missing = &figures.not_measured[0];
        assert_eq!(missing.measure, "area");
        assert!(missing.reason.contains("+9.400 %"), "{}", missing.reason);

        let mut figures = of_edges();
        figures.withhold_contradicted([Some(-0.04), None]);
        assert!(figures.area.is_some() && figures.not_measured.is_empty());
    }
}
