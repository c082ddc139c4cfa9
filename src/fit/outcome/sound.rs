//! Whether what was fitted is a body, and that of the points.

use crate::fit::error::FitError;
use crate::fit::options::{FARTHEST, FitOptions};
use crate::fit::outcome::{Fitted, Residuals};
use crate::fit::warning::FitWarning;
use crate::measure::grain_properties;
use crate::model::{Grain, InvalidGrain};
use crate::sphere::RingGrid;
use nalgebra::Vector3;

/// The same as [`FARTHEST`] for the estimate that a surface is cut from. Scans of grains and stones are within 5 %, a grain and the table
/// that it stands on 8 % or more.
const FAR_FROM_ESTIMATE: f64 = 0.06;

/// A model that differs from the estimate by more than this share may differ as the points do, and these from the estimate by less
/// than the squares tell.
const COARSE: f64 = 0.02;

/// How far a single point may be from the surface before it is told, as a share of the mean radius. Of kernels it is .2 at most, of
/// grains with the pin that held them .3 to .8. ...
const NOT_FOLLOWED: f64 = 0.25;

/// ... Along rays that graze long and steep bodies noise takes points as far, up to 8 times the RMS residual, and so do steps between
/// few voxels; pins are 12 or more.
const BEYOND_NOISE: f64 = 10.0;

/// A surface holds at most so many times the volume of the polyhedron of its points, which is smaller: of 50 points by
/// a seventh. ...
const LARGEST_VOLUME: f64 = 1.5;

/// ... With fewer points it may hold anything.
const FEW_POINTS: usize = 50;

/// How far points that were held out may be from a surface through a crust, as a share of the radius of the ball of equal volume
/// (RMS). Of bananas and hooks of 400 points and more it is 2 % at most; of 61 to 152 points of an ellipsoid, a cylinder and a
/// cuboid, whose crusts hold a seventh to a third of them, 12 to 25 %, and volumes are 6 to 20 % off.
const FAR_HELD_OUT: f64 = 0.06;

/// Rings of directions whose radii tell the volume to some percent, ...
const RINGS: usize = 48;

/// ... which is enough where it is at most so many times that of the polyhedron.
const CLEARLY_FINE: f64 = 1.2;

/// Refuses a radius that is not above zero everywhere, which is proved and not sampled, and a surface far from its
/// points. With such a radius the volume and the moments are above zero too.
pub(in crate::fit) fn check(
    fitted: &Fitted,
    options: &FitOptions,
    is_rod: bool,
) -> Result<Vec<FitWarning>, FitError> {
    let is_asked_for = options.degree.is_some();
    let rms = fitted.residuals.rms;
    let (off, far) = match (fitted.search.choice().estimate_rms, &fitted.posterior) {
        (Some(of_model), Some(estimate)) if of_model > COARSE * fitted.mean_radius => {
            (estimate.residual(), FAR_FROM_ESTIMATE)
        }
        (Some(of_model), _) => (
            (rms * rms - of_model * of_model).max(0.0).sqrt(),
            FAR_FROM_ESTIMATE,
        ),
        // Of degree 0 even a ball is what was asked for.
        (None, _) if is_asked_for => (0.0, FARTHEST),
        (None, _) => (rms, FARTHEST),
    };
    let share = off / fitted.mean_radius;
    let is_far = |share: f64| share.is_nan() || share > far;
    // Of a rod the distance along a ray counts as a share of it; a hole hides that there is no rod.
    let seen = fitted.posterior.as_ref();
    let seen = seen.filter(|_| is_rod && fitted.grain.unseen().is_none());
    if is_far(share) && seen.is_none_or(|rod| is_far(rod.relative_residual())) {
        return Err(FitError::FarFromPoints { share });
    }
    if fitted.grain.unseen().is_none() && fitted.points > FEW_POINTS && !is_asked_for {
        let times = times_as_large(&fitted.grain, fitted.reference.volume);
        if times > LARGEST_VOLUME {
            return Err(FitError::FarBeyondPoints { times });
        }
    }
    let far = not_followed(&fitted.residuals, fitted.mean_radius, Off::AlongRay);
    let mut warnings: Vec<FitWarning> = far
        .filter(|_| !is_rod && !is_asked_for)
        .into_iter()
        .collect();
    let Some(star) = fitted.grain.star() else {
        return Ok(warnings);
    };
    match star.least_radius() {
        Ok(_) => Ok(warnings),
        Err(InvalidGrain::NotPositive { radius, direction }) => Err(FitError::NotPositive {
            radius,
            direction: direction.into(),
        }),
        // Few large cells of high degree are wild beyond themselves: bounds on them do not tell.
        Err(InvalidGrain::Unproved { found }) => match fitted.estimate.is_none() || is_asked_for {
            true => {
                warnings.push(FitWarning::Unproved { found });
                Ok(warnings)
            }
            false => Err(FitError::Unproved { found }),
        },
        Err(_) => Err(FitError::Scale {
            size: fitted.mean_radius,
        }),
    }
}

/// What a point may be off a surface.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::fit) enum Off {
    AlongRay,
    /// Along the normal.
    Point,
    /// Likewise, by the steps between voxels.
    Voxel,
}

/// How far the farthest point is from a surface, if something sticks out there.
pub(in crate::fit) fn not_followed(
    residuals: &Residuals,
    radius: f64,
    off: Off,
) -> Option<FitWarning> {
    let (largest, share) = (residuals.max, residuals.max / radius);
    let is_beyond_noise = off == Off::Point || largest > BEYOND_NOISE * residuals.rms;
    (share > NOT_FOLLOWED && is_beyond_noise).then_some(FitWarning::NotFollowed {
        largest,
        share,
        is_along_ray: off == Off::AlongRay,
    })
}

/// Refuses positions that are not the body: with a volume far beyond that of closed faces, or through a crust that points which
/// were held out are far from.
pub(in crate::fit) fn check_positions(fitted: &Fitted) -> Result<(), FitError> {
    if fitted.reference.kind.has_faces() {
        let times = fitted.survey().volume().unwrap_or(f64::NAN) / fitted.reference.volume;
        return match times > LARGEST_VOLUME {
            true => Err(FitError::FarBeyondPoints { times }),
            false => Ok(()),
        };
    }
    let held_out = fitted.search.choice().heldout_rms;
    let share = held_out.map_or(0.0, |rms| rms / fitted.mean_radius);
    match share > FAR_HELD_OUT {
        true => Err(FitError::FarFromPoints { share }),
        false => Ok(()),
    }
}

/// The volume of a grain over another: to some percent where that is enough.
fn times_as_large(grain: &Grain, volume: f64) -> f64 {
    let coarse = grain.star().map(|star| {
        let nodes = RingGrid::new(0, RINGS).nodes();
        let (directions, weights): (Vec<Vector3<f64>>, Vec<f64>) = nodes.into_iter().unzip();
        let radii = star.local_radii(&directions).into_iter();
        let cones = radii
            .zip(weights)
            .map(|(r, weight)| weight * r.powi(3) / 3.0);
        cones.sum::<f64>() / volume
    });
    coarse
        .filter(|times| *times <= CLEARLY_FINE)
        .unwrap_or_else(|| grain_properties(grain).properties.volume / volume)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::fit;
    use crate::fit::outcome::Residuals;
    use crate::scan::Scan;
    use crate::shapes::Sampling;

    #[test]
    fn a_point_that_is_far_from_the_surface_is_told_unless_it_is_on_a_rod() {
        let directions = Sampling::Fibonacci.directions(500, 0).unwrap();
        let points = directions.iter().map(|n| (2.0 * n).into()).collect();
        let options = FitOptions::default();
        let mut fitted = fit(&Scan::from_points(points), &options).unwrap();
        let mut told = |largest: f64, rms: f64, is_rod: bool| {
            fitted.residuals = Residuals { rms, max: largest };
            check(&fitted, &options, is_rod).unwrap()
        };
        assert_eq!(told(0.4, 0.03, false), []);
        let [
            FitWarning::NotFollowed {
                largest,
                share,
                is_along_ray: true,
            },
        ] = told(0.6, 0.03, false)[..]
        else {
            panic!("not told");
        };
        assert!(largest == 0.6 && (share - 0.3).abs() < 1e-9);
        assert_eq!(told(0.6, 0.03, true), []);
        // So far does noise take points that rays graze, and so do steps, but not along normals.
        assert_eq!(told(0.6, 0.07, false), []);
        let residuals = Residuals {
            rms: 0.07,
            max: 0.6,
        };
        assert!(not_followed(&residuals, 2.0, Off::Point).is_some());
        assert!(not_followed(&residuals, 2.0, Off::Voxel).is_none());
    }
}
