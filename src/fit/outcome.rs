//! What a fit gives.

pub(super) mod bridged;
pub(super) mod contradicted;
pub(super) mod figures;
pub(super) mod local_cells;
pub(super) mod samples;
pub(super) mod sound;
pub(super) mod standard_errors;
pub(super) mod turn;
pub(super) mod uncertainty;

use super::candidate::Search;
use super::estimate::Estimate;
use super::kind::choice::KindChoice;
use super::prepare::Reference;
use super::warning::FitWarning;
use crate::measure::{Measured, Scheme, Survey};
use crate::model::{Grain, NoStandardErrors, StandardErrors, StarGrain};
use nalgebra::Point3;
use samples::Samples;

/// A fitted grain and what is known of it.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Fitted {
    /// The grain, in the scan's frame and unit.
    pub grain: Grain,
    /// Why it is of its kind.
    pub kind: KindChoice,
    /// The candidates, the choice and the work done.
    pub search: Search,
    /// What the candidates were compared with.
    pub reference: Reference,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// Mean of the radius over all directions, in the scan's unit; of a surface without one, the radius of the ball of
    /// equal volume.
    pub mean_radius: f64,
    /// Radial residuals of all points the fit rests on; of a surface without a radius, distances along its normals.
    pub residuals: Residuals,
    /// Root mean square difference of the radius between mirror images, as far as expansions of degree
    /// 3 follow it, in the scan's unit. `None` of a fit without mirrors.
    pub asymmetry: Option<f64>,
    /// What blended cells approximate. `None` of fits to the points themselves.
    pub estimate: Option<EstimateSummary>,
    /// The expansion of the whole sphere that comes as near to the estimate as the chosen cells. `None` where there are no
    /// cells.
    pub whole: Option<StarGrain>,
    /// See [`Self::warnings`]: standard errors follow from them too.
    pub(crate) warnings: Vec<FitWarning>,
    /// Area, volume, moments and mean radius of the grain at unit size, once they are measured.
    pub(crate) measured: Option<Measured>,
    pub(crate) posterior: Option<Box<Estimate>>,
    /// What a surface without a radius was fitted to.
    pub(crate) samples: Option<Samples>,
    /// The points of a radius whose estimate hides edges.
    pub(crate) edged: Option<Vec<Point3<f64>>>,
    /// Standard errors of a surface that has no estimate of its radius.
    pub(crate) errors: Option<Result<StandardErrors, NoStandardErrors>>,
    /// Of points that may be the centres of voxels, the mean distance from one to the next.
    pub(crate) step: Option<f64>,
}

/// What an estimate says of itself. Lengths are in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct EstimateSummary {
    /// Largest degree of its expansion.
    pub degree: usize,
    /// Standard deviation of the radius, as root mean square over all directions.
    pub deviation: f64,
    /// Standard deviation of the noise of one point.
    pub noise: f64,
    /// Exponent of the power law by which the variance of its harmonics falls with their degree, without that of texture.
    pub slope: f64,
    /// Points that were left out: those that stand apart from their neighbours, those that stand alone, and dust or glare on one
    /// side.
    pub outliers: usize,
    /// Largest difference of the model's radius from the estimate. `None` where the model is its expansion.
    pub largest_difference: Option<f64>,
}

/// Radial residuals: radius of the point minus radius of the grain in its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Residuals {
    /// Root mean square, in the scan's unit.
    pub rms: f64,
    /// Largest absolute value, in the scan's unit.
    pub max: f64,
}

impl Residuals {
    /// Those of points, each by its distance.
    pub(crate) fn of(distances: impl IntoIterator<Item = f64>) -> Self {
        let (mut squares, mut max, mut count) = (0.0, 0.0_f64, 0);
        for distance in distances {
            squares += distance * distance;
            max = max.max(distance.abs());
            count += 1;
        }
        Self {
            rms: (squares / f64::from(count)).sqrt(),
            max,
        }
    }
}

impl Fitted {
    /// What a user should know of the scan and the fit.
    pub fn warnings(&self) -> &[FitWarning] {
        &self.warnings
    }

    /// The survey of the grain as it was fitted, with exact integrals; what the fit measured is not measured again.
    pub fn survey(&self) -> Survey<'_> {
        match self.measured {
            Some(measured) => Survey::of_known(&self.grain, measured),
            None => Survey::of_grain(&self.grain, Scheme::Exact),
        }
    }

    /// The same with area, volume, moments and mean radius of the surface itself.
    pub(super) fn measured(mut self) -> Self {
        let survey = self.survey();
        let (measured, radius) = (survey.measured().ok().copied(), survey.mean_radius());
        self.mean_radius = radius.unwrap_or(self.mean_radius);
        self.measured = measured;
        self
    }
}
