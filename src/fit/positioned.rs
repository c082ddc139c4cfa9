//! Fits positions over the sphere, and makes a fitted grain of what goes through itself nowhere.

use super::candidate::{Candidate, Search, Work};
use super::context::Context;
use super::error::FitError;
use super::options::{FitOptions, Seams};
use super::outcome::{Fitted, KindChoice, Residuals, Rival};
use super::position::{PositionFit, fit_position_if};
use super::sound;
use super::warning::FitWarning;
use crate::model::{Grain, InvalidGrain, NoInterval, PositionGrain, Surface};
use crate::scan::Scan;

/// The fewest cells: a surface that is folded is fitted once more with half its cells, but no fewer than these.
const FEWEST_CELLS: usize = 6;

/// Fits positions over the sphere, where `is_worth` says so of what they may become.
pub(super) fn positioned(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
    kind: KindChoice,
    is_worth: &(dyn Fn(Rival) -> bool + Sync),
) -> Result<Fitted, FitError> {
    let mut fit = fit_position_if(scan, options, context, is_worth)?;
    let cells_of = |fit: &PositionFit| fit.surface.coefficients().len();
    let mut grain = checked(&fit);
    // Fewer cells may not go through themselves.
    if grain.is_err() && options.segments.is_none() && cells_of(&fit) > FEWEST_CELLS {
        let fewer = FitOptions {
            max_segments: Some((cells_of(&fit) / 2).max(FEWEST_CELLS)),
            ..options.clone()
        };
        fit = fit_position_if(scan, &fewer, context, is_worth)?;
        grain = checked(&fit);
    }
    let (grain, cells) = (grain?, cells_of(&fit));
    let (degree, radius) = (fit.surface.degree(), fit.radius);
    let grain = Grain::from(grain);
    let candidate = Candidate {
        heldout_rms: Some(fit.held_out.rms),
        ..Candidate::unfitted(degree, cells, grain.coefficient_count())
    };
    let errors = match are_few(&fit, grain.coefficient_count()) {
        true => Err(NoInterval::FewPoints),
        false => fit.errors,
    };
    let mut warnings = fit.warnings;
    if fit.turned_over > 0 {
        warnings.push(FitWarning::TurnedOver {
            samples: fit.turned_over,
        });
    }
    let fitted = Fitted {
        grain,
        kind,
        search: Search {
            seams: Seams::Blended,
            chosen: 0,
            candidates: vec![candidate],
            limit: fit.limit,
            tolerance: fit.tolerance,
            noise: None,
            work: Work::default(),
        },
        reference: fit.reference,
        points: fit.samples,
        mean_radius: radius,
        residuals: Residuals {
            rms: fit.distance.rms,
            max: fit.distance.max,
        },
        asymmetry: None,
        estimate: None,
        whole: None,
        warnings,
        measured: None,
        posterior: None,
        samples: Some(fit.fitted_to),
        edged: None,
        errors: Some(errors),
    };
    let fitted = fitted.measured();
    sound::check_positions(&fitted)?;
    Ok(fitted.beside_polyhedron())
}

/// Whether a cloud has fewer points than coefficients: volumes of smooth bodies with half a percent of noise are then up to 12
/// standard errors off.
fn are_few(fit: &PositionFit, coefficients: usize) -> bool {
    !fit.reference.kind.has_faces() && fit.samples < coefficients
}

/// The grain that was fitted, if its surface does not go through itself.
fn checked(fit: &PositionFit) -> Result<PositionGrain, FitError> {
    let grain = PositionGrain::new(fit.frame, fit.surface.clone()).map_err(FitError::NoSurface)?;
    let folded_at = match grain.check() {
        Ok(()) => None,
        Err(InvalidGrain::Folded { direction }) => Some(grain.point(&direction.into())),
        Err(error) => return Err(FitError::NoSurface(error)),
    };
    match folded_at.or(fit.crossing) {
        Some(place) => Err(FitError::GoesThroughItself { place }),
        None => Ok(grain),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::position::fit_position;
    use crate::mesh::Mesh;
    use nalgebra::Point3;

    #[test]
    fn a_surface_that_goes_through_itself_is_refused_with_the_place() {
        let ball = Scan::from_mesh(Mesh::radial(8, |_| 1.0)).unwrap();
        let options = FitOptions::default().with_segments(1).with_degree(1);
        let mut fit = fit_position(&ball, &options, &Context::default()).unwrap();
        assert!(checked(&fit).is_ok());
        let place = Point3::new(0.5, 0.0, 1.0);
        fit.crossing = Some(place);
        let refused = checked(&fit).unwrap_err();
        assert_eq!(refused, FitError::GoesThroughItself { place });
        let told = refused.to_string();
        assert!(told.contains("near (0.5000, 0.0000, 1.0000)"), "{told}");
    }
}
