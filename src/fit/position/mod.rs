//! The position of a surface's points over the sphere, fitted to the faces of a scan, or to points that have none: for
//! surfaces that no centre sees, and for those with steep sides.
//!
//! The faces, or those of a [crust](super::crust) around points, are [mapped](map) to the sphere, one to one. Then
//! coordinates are fitted as functions on the sphere, in [rounds] that also move the directions; cells are
//! [split](mod@search) where the distance asks for it.

mod cloud;
mod dimension_errors;
mod ends;
mod errors;
mod finest;
mod foot;
mod functionals;
mod functions;
mod least_squares;
mod levels;
mod local_faces;
pub(crate) mod map;
mod on_mesh;
mod on_sphere;
mod rounds;
mod search;
mod taper;
mod voxels;

use super::context::Context;
use super::error::FitError;
use super::kind::choice::Rival;
use super::options::FitOptions;
use super::outcome::samples::Samples;
use super::prepare::Reference;
use super::warning::FitWarning;
use crate::model::{Frame, NoStandardErrors, Position, StandardErrors};
use crate::scan::Scan;
use levels::{Found, Levels};
use local_faces::LocalFaces;
use nalgebra::Point3;
use search::search;

pub(super) use search::MOST_COEFFICIENTS;

/// A fitted surface, and what is known of it.
#[derive(Debug, Clone)]
pub struct PositionFit {
    /// The centroid of the scan and its principal axes.
    pub frame: Frame,
    /// In that frame.
    pub surface: Position,
    /// Area and volume of the scan's faces.
    pub reference: Reference,
    /// Radius of the ball of equal volume.
    pub radius: f64,
    /// Points fitted, those inside large faces too.
    pub samples: usize,
    /// Distances of the samples from the surface, weighted 80 % by area and 20 % by solid angle on the sphere.
    pub distance: Distance,
    /// The same at vertices that a fit of the same functions has not used.
    pub held_out: Distance,
    /// Weight of the roughness beside the mean squared distance, both in units of the radius.
    pub roughness: f64,
    /// Distance of held-out points that was good enough.
    pub limit: f64,
    /// The one that was asked for.
    pub tolerance: f64,
    /// Samples at which the surface is turned over.
    pub turned_over: usize,
    /// Pairs of triangles of the surface's mesh that cross.
    pub crossings: usize,
    /// Where the first of these cross, in the scan's frame.
    pub crossing: Option<Point3<f64>>,
    /// Whether neither fewer cells nor rougher ones would leave a surface that is sound.
    pub(super) is_hopeless: bool,
    /// Standard errors of its figures.
    pub errors: Result<StandardErrors, NoStandardErrors>,
    /// What it was fitted to.
    pub(crate) fitted_to: Samples,
    /// What a user should know of the scan.
    pub warnings: Vec<FitWarning>,
}

/// Distances that are good enough, over the scatter that the scan is known to have: by so much a body of its own
/// directions may differ from the mean of all.
const OVER_SCATTER: f64 = 1.1;

/// Distances in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// Root of the weighted mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
}

/// Fits positions over the sphere to the faces of a scan, or to its points if it has none. Of the options, `segments`, `degree`,
/// `max_segments`, `max_degree` and `tolerance` count; the tolerance is one of held-out distance, relative to the radius of the ball of equal volume.
///
/// # Errors
/// [`FitError`] if the scan's faces are not closed or its points enclose nothing, if they have no map to the sphere, if they do not determine a surface,
/// or if the fit is cancelled.
pub fn fit_position(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<PositionFit, FitError> {
    fit_position_if(scan, options, context, &|_| true)
}

/// The same, but only where `is_worth` says so of the number of coefficients and the least distance that they may leave.
///
/// # Errors
/// Also [`FitError::NoPositions`] if it is not.
pub(super) fn fit_position_if(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
    is_worth: &(dyn Fn(Rival) -> bool + Sync),
) -> Result<PositionFit, FitError> {
    if options.is_degree_zero() {
        return Err(FitError::PointOfDegreeZero);
    }
    let local = LocalFaces::new(scan)?;
    let radius = local.radius;
    options.tolerance.check(radius)?;
    let tolerance = options.tolerance.length(radius);
    let limit = tolerance.max(OVER_SCATTER * scan.scatter().unwrap_or(0.0));
    let is_worth = |coefficients: usize, rms: f64| {
        is_worth(Rival {
            coefficients,
            rms: rms * radius,
        })
    };
    let mut levels = Levels::new(&local, context)?;
    let found = context.run(|| search(&mut levels, options, limit / radius, &is_worth, context))?;
    let Found {
        fitted,
        scanned,
        points,
        normals,
        hidden,
    } = found.ok_or(FitError::NoPositions)?;
    let distance = |found: cloud::Distances| Distance {
        rms: found.rms * radius,
        max: found.max * radius,
    };
    let [turned_over, crossings] = fitted.faults;
    Ok(PositionFit {
        crossing: fitted.crossing.map(|place| local.to_scan(&place)),
        frame: local.frame,
        surface: fitted.surface.times(radius),
        reference: local.reference,
        radius,
        samples: scanned,
        distance: distance(fitted.distances),
        held_out: distance(fitted.held_out),
        roughness: fitted.roughness,
        limit,
        tolerance,
        turned_over,
        crossings,
        is_hopeless: fitted.is_hopeless,
        errors: fitted.errors.map(|errors| errors.times(radius)),
        fitted_to: Samples {
            points: points.iter().map(|p| local.to_scan(p)).collect(),
            normals: normals.iter().map(|n| local.frame.axes * n).collect(),
            hidden: hidden
                .iter()
                .map(|square| square * radius * radius)
                .collect(),
        },
        warnings: local.warnings,
    })
}

#[cfg(test)]
mod tests;
