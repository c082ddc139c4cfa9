//! The estimate: the radius in harmonics of the whole sphere, told from noise by its own spectrum.
//!
//! 1. A linear map along the grain's axes makes it rounder: of three strengths the one under which the points are
//!    most likely is taken.
//! 2. Coefficients have a prior variance per degree, a power law, and noise is the same along the normals of an
//!    ellipsoid that is like the grain; the parameters of both are those under which the points are most likely.
//!    No degree has to be chosen: it is high enough when the last degrees carry nothing.
//! 3. Points that stand alone are left out, and those that lie off the surface to one side, and the estimate is made again.
//! 4. Where what it leaves of the points is detail, they are followed [more closely](mod@closer), as far as others are then missed by less.
//! 5. Clouds of more than 30 000 points, and uneven ones of more than 3000, are reduced to patch means, with one correction.
//!
//! The posterior covariance says how well every functional of the radius is known.

mod blur;
mod bump;
mod closer;
mod cloud;
mod conjugate_gradients;
mod curvature;
mod degrees;
mod dense;
mod dimension_errors;
mod dimensions;
mod draws;
mod errors;
mod flattened;
mod functionals;
mod held_out;
mod information;
mod known_errors;
mod layered;
mod left_out;
mod leverage;
mod likelihood;
mod local;
mod map;
mod newton;
mod one_sided;
mod outcome;
mod outliers;
mod patches;
mod plateau;
mod posterior;
mod rims;
mod spectrum;
mod spectrum_fit;
mod spectrum_search;
mod stopping;
mod sums;
mod surface;
mod texture;
mod tilt;
mod tips;
#[cfg(test)]
mod trial;
mod unresolved;
mod vicinity;

pub use local::RadiusError;
pub(crate) use outcome::Estimate;

use crate::fit::context::{Cancelled, Context};
use crate::fit::points::without::without;
use crate::fit::prepare::{Origin, Sample};
use closer::closer;
use cloud::Cloud;
use degrees::{Degrees, first_degree};
use map::likeliest_stretch;
use nalgebra::Vector3;
use one_sided::one_sided;
use outcome::{Dense, Derived};
use outliers::strays;
use patches::{Patches, patches_per_edge};
use posterior::Posterior;
use spectrum_fit::SpectrumFit;
use std::borrow::Cow;
use std::sync::Arc;
use stopping::SETTLED;

/// Estimates the radius, and makes the estimate again without points that lie off it to [one side](one_sided()). `axes`: semi-axes of
/// the ellipsoid of equal second moments, along the grain's own axes.
pub(crate) fn estimate(
    samples: &[Sample],
    axes: Vector3<f64>,
    origin: Origin,
    context: &Context<'_>,
) -> Result<Estimate, Cancelled> {
    let may_stand_alone = origin != Origin::LargeFaces;
    let whole = with_neighbours(samples, axes, may_stand_alone, context)?;
    if origin != Origin::Points {
        return Ok(whole);
    }
    let fewest = ((1.0 - one_sided::MOST) * samples.len() as f64) as usize;
    let mut kept = Cow::Borrowed(samples);
    let mut found: Option<Estimate> = None;
    for _ in 0..one_sided::ROUNDS {
        let left_out = one_sided(&kept, found.as_ref().unwrap_or(&whole));
        if left_out.is_empty() {
            break;
        }
        kept = without(&kept, left_out).into();
        if kept.len() < fewest {
            return Ok(whole);
        }
        let one_sided = samples.len() - kept.len();
        let again = with_neighbours(&kept, axes, may_stand_alone, context)?;
        found = Some(Estimate { one_sided, ..again });
    }
    Ok(found.unwrap_or(whole))
}

/// Estimates the radius, as [`by_degrees`] does. Where points that were left out are neighbours, on one side of the surface, they
/// are no strays but a part of the grain that was taken off point by point: they are put back, and all are held.
fn with_neighbours(
    samples: &[Sample],
    axes: Vector3<f64>,
    may_stand_alone: bool,
    context: &Context<'_>,
) -> Result<Estimate, Cancelled> {
    let found = by_degrees(samples, axes, may_stand_alone, context)?;
    if found.outliers == 0 || found.dense.is_some() {
        return Ok(found);
    }
    let Some(strays) = strays(samples, &found) else {
        return Ok(found);
    };
    let outliers = strays.len();
    let found = by_degrees(&without(samples, strays), axes, false, context)?;
    Ok(Estimate { outliers, ..found })
}

/// Estimates the radius from samples in the grain's own frame, without points that stand alone.
fn by_degrees(
    samples: &[Sample],
    axes: Vector3<f64>,
    may_stand_alone: bool,
    context: &Context<'_>,
) -> Result<Estimate, Cancelled> {
    let per_edge = patches_per_edge(samples, &axes);
    let patches = per_edge.map(|per_edge| Patches::new(samples, &axes, per_edge));
    let (reduced, counts) = match &patches {
        Some(patches) => (patches.means.as_slice(), Some(patches.counts.as_slice())),
        None => (samples, None),
    };
    let first = first_degree(reduced.len());
    let stretched = likeliest_stretch(reduced, counts, axes, first, may_stand_alone, context)?;
    let Degrees {
        mut cloud,
        patches,
        degree,
        mut fit,
        outliers,
        ..
    } = Degrees::new(stretched, patches, first, may_stand_alone).searched(context)?;
    let dense = patches.map(|patches| correct(&mut cloud, &patches, &mut fit));
    let found = Estimate {
        cloud,
        degree,
        coefficients: fit.coefficients,
        spectrum: fit.spectrum,
        unlearnt: fit.unlearnt,
        outliers,
        one_sided: 0,
        sums: fit.sums,
        factor: fit.factor,
        dense,
        derived: Derived::default(),
    };
    closer(found, context)
}

/// Adds the patch means of the residuals, and solves again.
fn correct(cloud: &mut Cloud, patches: &Patches, fit: &mut SpectrumFit) -> Dense {
    let residuals = fit.residuals(patches.places(), cloud);
    let within = patches.spread_of(&cloud.along_normals(patches.places(), &residuals));
    let residuals = patches.means_of(&residuals);
    let posterior = Posterior::with(cloud, Arc::clone(&fit.sums));
    cloud.radii = posterior.radii(&fit.coefficients);
    for (radius, residual) in cloud.radii.iter_mut().zip(residuals) {
        *radius += residual;
    }
    let posterior = Posterior::with(cloud, Arc::clone(&fit.sums));
    let given = posterior.given(&fit.spectrum);
    fit.coefficients = given.mean(Some(&fit.coefficients), SETTLED).0;
    Dense {
        points: patches.points(),
        residuals: within + posterior.mean_square(&fit.coefficients),
    }
}
