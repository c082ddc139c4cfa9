//! Fits positions over the sphere, and makes a fitted grain of what goes through itself nowhere.

use super::candidate::{Candidate, Search, Work};
use super::context::Context;
use super::error::FitError;
use super::kind::choice::{KindChoice, Rival};
use super::options::{FEWEST_CELLS, FitOptions};
use super::outcome::sound::{self, Off, not_followed};
use super::outcome::{Fitted, Residuals};
use super::points::scatter::scatter;
use super::position::{Distance, PositionFit, fit_position_if};
use super::prepare::ReferenceKind;
use super::warning::FitWarning;
use crate::model::{Grain, InvalidGrain, NoStandardErrors, PositionGrain, Surface};
use crate::scan::Scan;

/// How many times farther held-out points are told to be than points from the surfaces through their neighbours. Of twenty clouds
/// of bananas, cups, mushrooms and the like nineteen are within 1.4, and one, of which the inner radius is a seventh too large, is
/// at 2.8.
const FAR: f64 = 2.0;

/// Numbers of even cells that are tried at last, of voxels whose steps a radius would follow.
const EVEN_CELLS: [usize; 3] = [24, 6, 1];

/// Fits positions over the sphere, where `is_worth` says so of what they may become.
pub(super) fn positioned(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
    kind: KindChoice,
    is_worth: &(dyn Fn(Rival) -> bool + Sync),
) -> Result<Fitted, FitError> {
    let fitted = |options: &FitOptions| {
        let fit = fit_position_if(scan, options, context, is_worth)?;
        let grain = checked(&fit);
        Ok::<_, FitError>((fit, grain))
    };
    let cells_of = |fit: &PositionFit| fit.surface.coefficients().len();
    let (mut fit, mut grain) = fitted(options)?;
    let is_free = options.segments.is_none();
    // Fewer cells may not go through themselves, ...
    while is_free && grain.is_err() && !fit.is_hopeless && cells_of(&fit) > FEWEST_CELLS {
        (fit, grain) = fitted(&FitOptions {
            max_segments: Some((cells_of(&fit) / 2).max(FEWEST_CELLS)),
            ..options.clone()
        })?;
    }
    // ... and of few voxels even ones, or harmonics of the whole sphere, may be smooth where others follow the steps.
    let is_of_voxels = fit.reference.kind == ReferenceKind::Voxels;
    for segments in EVEN_CELLS {
        if is_free && is_of_voxels && grain.is_err() {
            (fit, grain) = fitted(&options.clone().with_segments(segments))?;
        }
    }
    let (grain, cells) = (grain?, cells_of(&fit));
    let (degree, radius) = (fit.surface.degree(), fit.radius);
    let grain = Grain::from(grain);
    let candidate = Candidate {
        heldout_rms: Some(fit.held_out.rms),
        ..Candidate::unfitted(degree, cells, grain.coefficient_count())
    };
    let residuals = Residuals {
        rms: fit.distance.rms,
        max: fit.distance.max,
    };
    // Far points that no face joins to others may be strays.
    let may_be_stray = fit.reference.kind == ReferenceKind::Crust;
    let off = match fit.reference.kind {
        ReferenceKind::Voxels => Off::Voxel,
        _ => Off::Point,
    };
    let not_followed = not_followed(&residuals, radius, off).filter(|_| !may_be_stray);
    let errors = match not_followed {
        _ if are_few(&fit, grain.coefficient_count()) => Err(NoStandardErrors::FewPoints),
        Some(_) => Err(NoStandardErrors::NotFollowed),
        None => fit.errors,
    };
    let mut warnings = fit.warnings;
    warnings.extend(far_from_neighbours(scan, &fit.held_out, fit.tolerance));
    warnings.extend(not_followed);
    if fit.turned_over > 0 {
        warnings.push(FitWarning::TurnedOver {
            samples: fit.turned_over,
        });
    }
    let fitted = Fitted {
        grain,
        kind,
        search: Search {
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
        residuals,
        asymmetry: None,
        estimate: None,
        whole: None,
        warnings,
        measured: None,
        posterior: None,
        samples: Some(fit.fitted_to),
        edged: None,
        errors: Some(errors),
        step: scan.step,
    };
    let fitted = fitted.measured();
    sound::check_positions(&fitted)?;
    Ok(fitted.beside_polyhedron())
}

/// How far held-out points are, where that is much farther than the points scatter.
fn far_from_neighbours(scan: &Scan, held_out: &Distance, good: f64) -> Option<FitWarning> {
    if !scan.triangles().is_empty() || held_out.rms <= FAR * good {
        return None;
    }
    let places: Vec<_> = scan.points().iter().map(|point| point.coords).collect();
    let scatter = scatter(&places)?.max(good);
    let rms = held_out.rms;
    (rms > FAR * scatter).then_some(FitWarning::FarFromNeighbours { rms, scatter })
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
    use crate::shapes::Sampling;
    use nalgebra::Point3;

    #[test]
    fn what_points_that_were_held_out_are_off_is_told_beside_what_points_scatter_by() {
        let signs = (0..).map(|i: i32| f64::from(i * i % 7 - 3) / 2.0);
        let directions = Sampling::Fibonacci.directions(1000, 0).unwrap();
        let places = directions.iter().zip(signs);
        let noisy = places.map(|(n, sign)| Point3::from(n * (1.0 + 0.01 * sign)));
        let cloud = Scan::from_points(noisy.collect());
        let told = |scan: &Scan, rms: f64, good: f64| {
            let max = rms;
            far_from_neighbours(scan, &Distance { rms, max }, good)
        };
        match told(&cloud, 0.04, 1e-3) {
            Some(FitWarning::FarFromNeighbours { rms: 0.04, scatter }) => {
                assert!((scatter - 0.006).abs() < 0.001, "{scatter}");
            }
            other => panic!("{other:?}"),
        }
        assert_eq!(told(&cloud, 0.009, 1e-3), None);
        assert_eq!(told(&cloud, 0.04, 0.03), None);
        let faces = Scan::from_mesh(Mesh::radial(8, |_| 1.0)).unwrap();
        assert_eq!(told(&faces, 0.04, 1e-3), None);
    }

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
