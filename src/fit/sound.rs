//! Whether what was fitted is a body, and that of the points.

use super::error::FitError;
use super::options::FitOptions;
use super::outcome::Fitted;
use crate::model::InvalidGrain;
use crate::sphere::CubeCell;

/// How far points may be from the surface that was asked for, as a share of the mean radius (RMS); ...
const FAR: f64 = 0.25;

/// ... and from the estimate that it is cut from. Scans of grains and stones are within 5 %, a grain and the table
/// that it stands on 8 % or more.
const FAR_FROM_ESTIMATE: f64 = 0.06;

/// A surface holds at most so many times the volume of the polyhedron of its points, which is smaller: of 50 points by
/// a seventh. ...
const LARGEST_VOLUME: f64 = 1.5;

/// ... With fewer points it may hold anything.
const FEW_POINTS: usize = 50;

/// Parts of the cube's edges by which the volume is found, to a percent.
const PARTS: u16 = 12;

/// Refuses a radius that is not above zero everywhere, which is proved and not sampled, and a surface far from its
/// points. With such a radius the volume and the moments are above zero too.
pub(super) fn check(fitted: &Fitted, options: &FitOptions) -> Result<(), FitError> {
    let rms = fitted.residuals.rms;
    let (off, far) = match fitted.search.choice().estimate_rms {
        Some(of_model) => (
            (rms * rms - of_model * of_model).max(0.0).sqrt(),
            FAR_FROM_ESTIMATE,
        ),
        // Of degree 0 even a ball is what was asked for.
        None if options.degree.is_some() => (0.0, FAR),
        None => (rms, FAR),
    };
    let share = off / fitted.mean_radius;
    if share.is_nan() || share > far {
        return Err(FitError::FarFromPoints { share });
    }
    let times = volume(fitted) / fitted.reference.volume;
    if fitted.unseen.is_none() && fitted.points > FEW_POINTS && times > LARGEST_VOLUME {
        return Err(FitError::FarBeyondPoints { times });
    }
    let refused = |invalid| match invalid {
        InvalidGrain::NotPositive { radius, direction } => FitError::NotPositive {
            radius,
            direction: direction.into(),
        },
        InvalidGrain::Unproved { found } => FitError::Unproved { found },
        _ => FitError::Scale {
            size: fitted.mean_radius,
        },
    };
    fitted.grain.least_radius().map_err(refused)?;
    Ok(())
}

/// Roughly.
fn volume(fitted: &Fitted) -> f64 {
    let cells = CubeCell::uniform(PARTS);
    let directions: Vec<_> = cells.iter().map(CubeCell::middle).collect();
    let radii = fitted.grain.local_radii(&directions).into_iter();
    let parts = radii
        .zip(&cells)
        .map(|(r, cell)| r.powi(3) / 3.0 * cell.solid_angle());
    parts.sum()
}
