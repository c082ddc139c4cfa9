//! What a fit gives.

use super::candidate::Search;
use super::prepare::Reference;
use super::warning::FitWarning;
use crate::model::Grain;
use nalgebra::{Matrix3, Vector3};

/// A fitted grain and what is known of it.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// The grain, in the scan's frame and unit.
    pub grain: Grain,
    /// The candidates, the choice and the work done.
    pub search: Search,
    /// What the candidates were compared with.
    pub reference: Reference,
    /// Distinct points that the fit rests on.
    pub points: usize,
    /// Mean of the radius over all directions, in the scan's unit.
    pub mean_radius: f64,
    /// Radial residuals of all points the fit rests on.
    pub residuals: Residuals,
    /// Root mean square difference of the radius between mirror images, as far as expansions of degree
    /// 3 follow it, in the scan's unit. `None` of a fit without mirrors.
    pub asymmetry: Option<f64>,
    /// What blended cells approximate. `None` of fits to the points themselves.
    pub estimate: Option<EstimateSummary>,
    /// The expansion of the whole sphere that comes as near to the estimate as the chosen cells. `None` where there are no
    /// cells.
    pub whole: Option<Grain>,
    /// What a user should know of the scan and the fit.
    pub warnings: Vec<FitWarning>,
}

/// What an estimate says of itself. Lengths are in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimateSummary {
    /// Largest degree of its expansion.
    pub degree: usize,
    /// Standard deviation of the radius, as root mean square over all directions.
    pub deviation: f64,
    /// Standard deviation of the noise of one point (of the mean of a patch, of clouds of more than 30 000 points).
    pub noise: f64,
    /// Exponent of the power law by which the variance of its harmonics falls with their degree.
    pub slope: f64,
    /// Points that stand alone and were left out.
    pub outliers: usize,
}

/// Radial residuals: radius of the point minus radius of the grain in its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residuals {
    /// Root mean square, in the scan's unit.
    pub rms: f64,
    /// Largest absolute value, in the scan's unit.
    pub max: f64,
}

/// Standard errors (one standard deviation) of a grain's measures, in the powers of the scan's unit
/// of these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardErrors {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
    /// Of the centroid's coordinates along the grain's axes.
    pub centroid: Vector3<f64>,
    /// Of the entries of the inertia tensor about the centroid, along the grain's axes.
    pub inertia: Matrix3<f64>,
    /// Of the principal moments of inertia, ascending.
    pub moments: Vector3<f64>,
    /// Of the length, width and thickness: extents along the principal axes.
    pub dimensions: Vector3<f64>,
    /// By what noise makes these extents too large.
    pub dimensions_excess: Vector3<f64>,
}

impl Fitted {
    /// Standard errors of the grain's figures.
    pub fn standard_errors(&self) -> Option<StandardErrors> {
        None
    }
}
