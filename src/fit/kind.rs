//! Which kind of surface a scan is given: a radius, or the position of points over the sphere.
//!
//! A radius first: it takes fewer coefficients where both do. Where it hides area, ends above its limit, is steep, or is far
//! from points that lie on smooth surfaces with their neighbours, the position is fitted too, as far as it may still be better, and the one with fewer coefficients at the limit is kept.
//! Of voxels the position alone, for a radius follows their steps as if they were texture.

use super::context::Context;
use super::error::FitError;
use super::options::{FitOptions, Kind, Seams};
use super::outcome::{Fitted, KindChoice, Rival};
use super::position::MOST_COEFFICIENTS;
use super::positioned::positioned;
use super::prepare::PreparedScan;
use super::rod::rod;
use super::scatter::{FAR, scatter};
use super::warning::FitWarning;
use crate::measure::{Deviation, feet};
use crate::model::{Grain, StarSurface, Surface};
use crate::scan::Scan;
use crate::sphere::{Symmetry, cube_grid};
use nalgebra::{Point3, Vector3};
use std::sync::OnceLock;

/// Cosine of the angle between a direction and the normal there below which a radius is steep, and ...
const STEEP: f64 = 0.2;

/// ... the share of directions in which it may be.
const STEEP_SHARE: f64 = 0.005;

/// Cells along a cube's edge of the directions looked at.
const LOOKED_AT: usize = 24;

/// What a radius does not see is far from it in few places: the mean of all distances is then less than this share of
/// their RMS. Of noise it is .80 (Geary 1935).
const LONG_TAILS: f64 = 0.74;

/// So many times larger than their scatter their noise is something else. Of bodies with noise it is 1.5 at most, of a
/// blackberry whose bumps are taken for noise 2.1.
const NOISY: f64 = 1.8;

/// A radius that hides area so counts as so many times farther off ...
const HIDING: f64 = 2.0;

/// ... if what it hides is more than this share of the area. Of stones of which it hid .01 and .05 % its area was within .2 %, that
/// of positions .5 and .7 % too small.
const HIDDEN_SHARE: f64 = 0.002;

/// Share of the points that a radius may have left out as dust, if it sees all else.
const MOST_DUST: f64 = 0.03;

/// Most vertices of a scan whose distances from a radius are compared with those from a position.
const MOST_COMPARED: usize = 4000;

/// Fits a grain to a scan, of the kind that the options ask for or that suits it.
///
/// # Errors
/// [`FitError`] if the options are out of range, the scan is not one closed surface, or the fit was cancelled.
pub fn fit_scan(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    options.check()?;
    let star = || {
        let fitted = PreparedScan::new(scan, options.symmetry)?.fit(options, context);
        fitted.map_err(|error| not_alike(error, options.symmetry))
    };
    match options.kind {
        Kind::Star => star(),
        Kind::Position => positioned(scan, options, context, KindChoice::Asked, &|_| true),
        Kind::Auto if scan.scatter > 0.0 && is_of_any_kind(options) => {
            match positioned(scan, options, context, KindChoice::Voxels, &|_| true) {
                Err(FitError::Cancelled) => Err(FitError::Cancelled),
                Err(position) => star().map_err(|radius| match radius {
                    FitError::Cancelled => FitError::Cancelled,
                    radius => neither(radius, position),
                }),
                found => found,
            }
        }
        Kind::Auto => match star() {
            Err(error) => match unseen(&error, options) {
                None => Err(error),
                Some(choice) => match positioned(scan, options, context, choice, &|_| true) {
                    Err(FitError::NoFaces) => Err(error),
                    Err(
                        position @ (FitError::NoInside
                        | FitError::OffCrust { .. }
                        | FitError::FarFromPoints { .. }),
                    ) => rod(scan, options, context).unwrap_or(Err(neither(error, position))),
                    found => found,
                },
            },
            Ok(fitted)
                if is_of_any_kind(options)
                    && (does_not_see(&fitted)
                        || is_unbounded(options)
                            && (is_far(&fitted) || is_rougher(&fitted, options))) =>
            {
                compared(scan, fitted, options, context)
            }
            found => found,
        },
    }
}

/// Why a mirrored surface is far from the points.
fn not_alike(error: FitError, symmetry: Symmetry) -> FitError {
    match error {
        FitError::FarFromPoints { share } if symmetry != Symmetry::NONE => {
            FitError::NotAlike { symmetry, share }
        }
        error => error,
    }
}

/// Why no kind can be fitted.
fn neither(radius: FitError, position: FitError) -> FitError {
    if radius == position {
        return radius;
    }
    FitError::NoKind {
        radius: radius.into(),
        position: position.into(),
    }
}

/// Whether nothing was asked for that only a radius has.
fn is_of_any_kind(options: &FitOptions) -> bool {
    options.seams == Seams::Blended && options.symmetry == Symmetry::NONE
}

/// Whether nothing was asked for that bounds the search of a radius, which may then be far from points that it sees.
fn is_unbounded(options: &FitOptions) -> bool {
    let usual = FitOptions::default();
    options.max_degree == usual.max_degree
        && options.max_segments == usual.max_segments
        && options.degree.is_none()
        && options.segments.is_none()
}

/// Why positions may be fitted where no radius can.
fn unseen(error: &FitError, options: &FitOptions) -> Option<KindChoice> {
    match *error {
        FitError::NotStarShaped { share } => {
            (!options.is_of_points()).then_some(KindChoice::Hidden { share })
        }
        FitError::Scattered { .. }
        | FitError::Strays { .. }
        | FitError::SecondSurface { .. }
        | FitError::FarFromPoints { .. }
        | FitError::FarBeyondPoints { .. }
        | FitError::NotPositive { .. } => is_of_any_kind(options).then_some(KindChoice::NoRadius),
        _ => None,
    }
}

/// The share of the area that a radius hides.
fn hidden_share(fitted: &Fitted) -> f64 {
    let hidden = fitted.warnings.iter().find_map(|warning| match warning {
        FitWarning::NotStarShaped { share } => Some(*share),
        _ => None,
    });
    hidden.unwrap_or(0.0)
}

/// Whether a radius hides some area, or ends above its limit, with no more coefficients than positions may have.
fn is_far(fitted: &Fitted) -> bool {
    let is_beyond = |warning: &FitWarning| matches!(warning, FitWarning::LimitNotMet { .. });
    let warns = hidden_share(fitted) > 0.0 || fitted.warnings.iter().any(is_beyond);
    warns && !is_outnumbered(fitted)
}

/// Whether a radius hides much of the area, or is steep.
fn does_not_see(fitted: &Fitted) -> bool {
    if hidden_share(fitted) > HIDDEN_SHARE {
        return true;
    }
    let Some(star) = fitted.grain.star() else {
        return false;
    };
    let (directions, _) = cube_grid(LOOKED_AT);
    let is_steep = |n: &&Vector3<f64>| {
        let (radius, gradient) = star.radius_and_gradient(n);
        radius < STEEP * radius.hypot(gradient.norm())
    };
    let steep = directions.iter().filter(is_steep).count();
    steep as f64 > STEEP_SHARE * directions.len() as f64
}

/// Whether a radius has more coefficients than positions may have: they are then farther off, unless it does not see all.
fn is_outnumbered(fitted: &Fitted) -> bool {
    fitted.grain.coefficient_count() > MOST_COEFFICIENTS
}

/// Whether a radius does not follow a body that is smooth among neighbours: held-out points are much farther from it than
/// from the surfaces through their neighbours, or what they scatter by is much less than the noise that is told.
fn is_rougher(star: &Fitted, options: &FitOptions) -> bool {
    let is_far = |rms: f64, limit: f64| rms * held_out_over_fitted(star) > FAR * limit;
    let good = options.tolerance.length(star.mean_radius);
    if is_outnumbered(star) || !is_far(star.residuals.rms, good) {
        return false;
    }
    let estimate = star.posterior.as_ref();
    let Some(points) = estimate.and_then(|estimate| estimate.points()) else {
        return false;
    };
    let Some(scatter) = scatter(&points) else {
        return false;
    };
    // So far faces lie within a smooth surface through their corners.
    let sag = star.reference.bulge / star.reference.area;
    let limit = scatter.max(sag).max(good);
    let is_noisy = star.search.noise.is_some_and(|noise| noise > NOISY * limit);
    if is_noisy || !is_far(star.residuals.rms, limit) {
        return is_noisy;
    }
    let frame = star.grain.frame();
    let points: Vec<_> = points.iter().map(|point| frame.to_scan(point)).collect();
    is_far(normal_distances(&star.grain, &points).rms(), limit)
}

/// The better of a radius and of positions; the radius where no positions can be fitted.
fn compared(
    scan: &Scan,
    mut star: Fitted,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    // Not the limit of its search: that is the laxer, the worse the estimate is.
    let limit = options.tolerance.length(star.mean_radius);
    let distances = normal_distances(&star.grain, scan.points());
    let own = Rival {
        coefficients: star.grain.coefficient_count(),
        rms: distances.rms() * held_out_over_fitted(&star),
    };
    let is_hiding = hidden_share(&star) > HIDDEN_SHARE
        && distances.mean_absolute < LONG_TAILS * distances.rms();
    let times = if is_hiding { HIDING } else { 1.0 };
    let weighed = Rival {
        rms: times * own.rms,
        ..own
    };
    let outdone = OnceLock::new();
    let is_worth = |forecast: Rival| {
        let is_outdone = weighed.is_better(&forecast, limit);
        if is_outdone {
            outdone.get_or_init(|| forecast);
        }
        !is_outdone
    };
    let mut fitted = match positioned(scan, options, context, KindChoice::Asked, &is_worth) {
        Err(FitError::Cancelled) => return Err(FitError::Cancelled),
        Err(_) => {
            if let Some(forecast) = outdone.into_inner() {
                let kept = own;
                star.kind = KindChoice::Outdoes { kept, forecast };
            }
            return Ok(star);
        }
        Ok(fitted) => fitted,
    };
    if is_of_dust(&fitted, &star, scan) {
        return Ok(star);
    }
    let kept = Rival {
        coefficients: fitted.grain.coefficient_count(),
        rms: fitted.search.choice().heldout_rms.unwrap_or(f64::INFINITY),
    };
    fitted.kind = KindChoice::Compared { kept, rival: own };
    Ok(fitted)
}

/// Whether positions are nearer to all points only because they reach out to dust that a radius left out: they do not follow
/// the points then, and the radius sees all others. Ten hairs beside an ellipsoid of 6000 points were fitted as body.
fn is_of_dust(positions: &Fitted, star: &Fitted, scan: &Scan) -> bool {
    let is_far = |warning: &FitWarning| matches!(warning, FitWarning::FarFromNeighbours { .. });
    let all = scan.points().len();
    let left_out = all.saturating_sub(star.points) as f64 / all as f64;
    positions.warnings.iter().any(is_far)
        && hidden_share(star) <= HIDDEN_SHARE
        && left_out > 0.0
        && left_out <= MOST_DUST
}

impl Rival {
    /// Of two within the limit the one with fewer coefficients is better, else the nearer one.
    fn is_better(&self, other: &Self, limit: f64) -> bool {
        match (self.rms <= limit, other.rms <= limit) {
            (true, true) => self.coefficients <= other.coefficients,
            _ => self.rms <= other.rms,
        }
    }
}

/// How many times farther points are from a fitted radius that are held out, by the radial distances of both; with the
/// mean of their leverages, for on a steep flank, where single points decide the radius, they do not decide the distance.
fn held_out_over_fitted(star: &Fitted) -> f64 {
    let choice = star.search.choice();
    let held_out = match (&star.posterior, choice.estimate_rms) {
        (Some(estimate), Some(rms)) => Some(rms.hypot(estimate.held_out_by_mean())),
        _ => choice.heldout_rms,
    };
    let times = held_out.map_or(1.0, |rms| rms / star.residuals.rms);
    if times.is_finite() {
        times.max(1.0)
    } else {
        1.0
    }
}

/// Distances of points from a surface, along its normals.
fn normal_distances(grain: &Grain, points: &[Point3<f64>]) -> Deviation {
    let every = points.len().div_ceil(MOST_COMPARED).max(1);
    let some: Vec<_> = points.iter().step_by(every).copied().collect();
    let feet = feet(grain, &some);
    Deviation::of(feet.iter().map(|foot| (foot.distance, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, SynthOptions, synthesize};

    /// Whether a fit of the maize of such a degree is rougher than its points, which have so much noise.
    fn is_rough(degree: usize, noise: f64, told: Option<f64>) -> bool {
        let options = SynthOptions::clean(Body::Maize)
            .with_points(1538)
            .with_noise(noise);
        let scan = Scan::from_points(synthesize(&options).unwrap().points);
        let own = FitOptions::default().with_segments(1).with_degree(degree);
        let prepared = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
        let mut fitted = prepared.fit(&own, &Context::default()).unwrap();
        if let Some(told) = told {
            fitted.search.noise = Some(told * fitted.mean_radius);
        }
        is_rougher(&fitted, &FitOptions::default())
    }

    #[test]
    fn a_radius_that_does_not_follow_smooth_points_is_rougher_than_these() {
        assert!(is_rough(4, 0.0, None));
        assert!(!is_rough(20, 0.0, None));
        assert!(!is_rough(12, 0.02, None));
    }

    /// Points of a maize and five that stand alone.
    fn dusty() -> Scan {
        let options = SynthOptions::clean(Body::Maize).with_points(1538);
        let mut points = synthesize(&options).unwrap().points;
        points.extend((0..5).map(|i| Point3::new(9.0, -7.0 + 3.0 * f64::from(i), 8.0)));
        Scan::from_points(points)
    }

    #[test]
    fn positions_that_reach_out_to_dust_are_no_better_than_a_radius() {
        let scan = dusty();
        let star = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
        let star = star
            .fit(&FitOptions::default(), &Context::default())
            .unwrap();
        assert_eq!(star.points, 1538);
        let mut positions = star.clone();
        assert!(!is_of_dust(&positions, &star, &scan));
        let (rms, scatter) = (0.5, 0.01);
        positions
            .warnings
            .push(FitWarning::FarFromNeighbours { rms, scatter });
        assert!(is_of_dust(&positions, &star, &scan));
        // Of 100 that were left out more than dust may be missing.
        let mut less = star.clone();
        less.points -= 100;
        assert!(!is_of_dust(&positions, &less, &scan));
        let mut hiding = star;
        hiding
            .warnings
            .push(FitWarning::NotStarShaped { share: 0.01 });
        assert!(!is_of_dust(&positions, &hiding, &scan));
    }

    #[test]
    fn noise_that_neighbours_do_not_have_is_none() {
        assert!(is_rough(12, 0.02, Some(0.08)));
        assert!(!is_rough(12, 0.02, Some(0.025)));
    }
}
