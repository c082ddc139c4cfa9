//! Which kind of surface a scan is given: a radius, or the position of points over the sphere.
//!
//! A radius first: it takes fewer coefficients where both do. Where it hides area, ends above its limit, is steep, or is far
//! from points that lie on smooth surfaces with their neighbours, the position is fitted too, as far as it may still be better. Of two
//! within the limit the one with fewer coefficients is kept, else the nearer one.
//! Of voxels the position alone, for a radius follows their steps as if they were texture.

pub(super) mod choice;
pub(super) mod misfit;
pub(super) mod rod;

use super::context::Context;
use super::error::FitError;
use super::options::{FitOptions, Kind, Seams};
use super::outcome::Fitted;
use super::position::MOST_COEFFICIENTS;
use super::positioned::positioned;
use super::prepare::PreparedScan;
use super::warning::FitWarning;
use crate::scan::Scan;
use crate::sphere::Symmetry;
use choice::{KindChoice, Rival};
use misfit::{
    does_not_see, held_out_over_fitted, hidden_share, hides_much, is_hiding, missed,
    normal_distances, stands_out,
};
use rod::rod;
use std::sync::OnceLock;

/// A radius that hides area so counts as so many times farther off, when it is compared with positions.
const HIDING: f64 = 2.0;

/// Share of the points that a radius may have left out as dust, if it sees all else.
const MOST_DUST: f64 = 0.03;

/// Fits a grain to a scan, of the kind that the options ask for or that suits it.
///
/// # Errors
/// [`FitError`] if the options are out of range, the scan is not one closed surface, or the fit was cancelled.
pub fn fit_scan(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let mut fitted = of_kind(scan, options, context)?;
    fitted.grain = fitted.grain.with_unit(scan.unit().map(str::to_owned));
    Ok(fitted)
}

fn of_kind(scan: &Scan, options: &FitOptions, context: &Context<'_>) -> Result<Fitted, FitError> {
    options.check()?;
    let star = || {
        let fitted = PreparedScan::new(scan, options.symmetry)?.fit(options, context);
        fitted.map_err(|error| not_alike(error, options.symmetry))
    };
    match options.kind {
        Kind::Star => star().map(|star| {
            let missed = missed_by(&star, scan, options);
            star.without_errors_if_local(missed, scan)
        }),
        Kind::Position => positioned(scan, options, context, KindChoice::Asked, &|_| true),
        Kind::Auto if scan.is_of_voxels() && is_of_any_kind(options) => {
            match positioned(scan, options, context, KindChoice::Voxels, &|_| true) {
                Err(FitError::Cancelled) => Err(FitError::Cancelled),
                Err(position) => match star() {
                    Err(FitError::Cancelled) => Err(FitError::Cancelled),
                    Err(radius) => Err(neither(radius, position)),
                    Ok(star) => Ok(for_want_of_positions(star, position).without_errors(None)),
                },
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
            Ok(star) => star_or_positions(scan, star, options, context),
        },
    }
}

/// A radius, or positions if they follow the scan better.
fn star_or_positions(
    scan: &Scan,
    star: Fitted,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let missed = missed_by(&star, scan, options);
    let is_worse = || is_far(&star) || missed.is_some();
    let may_be_better = is_of_any_kind(options)
        && (does_not_see(&star) || options.is_unbounded() && !is_outnumbered(&star) && is_worse());
    match may_be_better {
        true => compared(scan, star, missed, options, context),
        false => Ok(star.without_errors_if_local(missed, scan)),
    }
}

/// How a radius that could have been of any kind does not follow the scan.
fn missed_by(star: &Fitted, scan: &Scan, options: &FitOptions) -> Option<FitWarning> {
    is_of_any_kind(options).then(|| missed(star, scan, options))?
}

/// A radius that is kept because no positions can be fitted.
fn for_want_of_positions(star: Fitted, error: FitError) -> Fitted {
    Fitted {
        kind: KindChoice::NoPositions(error.into()),
        ..star
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

/// Why positions may be fitted where no radius can.
fn unseen(error: &FitError, options: &FitOptions) -> Option<KindChoice> {
    match *error {
        FitError::NotStarShaped { share } => {
            (!options.is_degree_zero()).then_some(KindChoice::Hidden { share })
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

/// Whether a radius hides some area, or ends above its limit.
fn is_far(fitted: &Fitted) -> bool {
    let is_beyond = |warning: &FitWarning| matches!(warning, FitWarning::LimitNotMet { .. });
    hidden_share(fitted) > 0.0 || fitted.warnings.iter().any(is_beyond)
}

/// Whether a radius has more coefficients than positions may have: they are then farther off, unless it does not see all.
fn is_outnumbered(fitted: &Fitted) -> bool {
    fitted.grain.coefficient_count() > MOST_COEFFICIENTS
}

/// The better of a radius and of positions; the radius where no positions can be fitted.
fn compared(
    scan: &Scan,
    mut star: Fitted,
    missed: Option<FitWarning>,
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
    let is_hiding = is_hiding(&star, &distances);
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
        Err(error) => {
            if let Some(forecast) = outdone.into_inner() {
                let kept = own;
                star.kind = KindChoice::Outdoes { kept, forecast };
                return Ok(star.without_errors_if_local(missed, scan));
            }
            let star = for_want_of_positions(star, error);
            return Ok(match is_hiding || missed.is_some() {
                true => star.without_errors(missed),
                false => star,
            });
        }
        Ok(fitted) => fitted,
    };
    if is_of_dust(&fitted, &star, scan) {
        return Ok(star.without_errors_if_local(missed, scan));
    }
    let kept = Rival {
        coefficients: fitted.grain.coefficient_count(),
        rms: fitted.search.choice().heldout_rms.unwrap_or(f64::INFINITY),
    };
    fitted.kind = KindChoice::Compared { kept, rival: own };
    // What stands out of a closed surface is a part of it.
    if scan.triangles().is_empty() {
        fitted.warnings.extend(stands_out(&star, &distances));
    }
    Ok(fitted)
}

/// Whether positions are nearer to all points only because they reach out to dust that a radius left out: they do not follow
/// the points then, and the radius sees all others. Ten hairs beside an ellipsoid of 6000 points were fitted as body.
fn is_of_dust(positions: &Fitted, star: &Fitted, scan: &Scan) -> bool {
    let is_far = |warning: &FitWarning| matches!(warning, FitWarning::FarFromNeighbours { .. });
    let all = scan.points().len();
    let left_out = all.saturating_sub(star.points) as f64 / all as f64;
    positions.warnings.iter().any(is_far)
        && !hides_much(star)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, SynthOptions, synthesize};
    use nalgebra::Point3;

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
}
