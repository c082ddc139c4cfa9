//! The estimate: the radius in harmonics of the whole sphere, told from noise by its own spectrum.
//!
//! 1. A linear map along the grain's axes makes it rounder: of three strengths the one under which the points are
//!    most likely is taken.
//! 2. Coefficients have a prior variance per degree, a power law; its parameters and the noise are those
//!    under which the points are most likely. No degree has to be chosen: it is high enough when the last
//!    degrees carry nothing.
//! 3. Points that stand alone are left out, and the estimate is made again.
//! 4. Clouds of more than 30 000 points are reduced to patch means, with one correction.
//!
//! The posterior covariance says how well every functional of the radius is known.

mod blur;
mod bump;
mod cloud;
mod conjugate_gradients;
mod curvature;
mod dense;
mod dimension_errors;
mod dimensions;
mod draws;
mod errors;
mod functionals;
mod information;
mod left_out;
mod leverage;
mod likelihood;
mod local;
mod map;
mod newton;
mod outcome;
mod outliers;
mod patches;
mod posterior;
mod rims;
mod spectrum;
mod spectrum_fit;
mod stopping;
mod sums;
mod surface;
mod texture;
mod tilt;
mod tips;
#[cfg(test)]
mod trial;
mod unresolved;

pub use local::RadiusError;
pub(crate) use outcome::Estimate;

use crate::fit::context::{Cancelled, Context};
use crate::fit::prepare::Sample;
use crate::sphere::{ScatteredHarmonics, coefficient_count};
use cloud::Cloud;
use map::rounder;
use nalgebra::Vector3;
use outcome::{Dense, LAST_DEGREES, last_power};
use outliers::{ROUNDS, alone};
use patches::{Patches, WHOLE_CLOUD};
use posterior::{Posterior, is_small};
use spectrum_fit::{Count, SpectrumFit, fit_spectrum};
use std::sync::{Arc, OnceLock};
use stopping::SETTLED;
use tilt::most_likely;

/// Degrees that are tried, as long as the last degrees of one carry something.
const DEGREES: [usize; 5] = [36, 48, 60, 72, 80];

/// A higher degree is kept if points that are left out are missed by this share less: else what the last degrees carried was
/// noise, of which the prior expected more. The likelihood does not tell: as far as it is known of so many points it is off by
/// a thousand in its logarithm, one way or the other.
const WORTH_A_DEGREE: f64 = 0.01;

/// Coefficients per point beyond which a higher degree is not tried.
const MOST_PER_POINT: f64 = 0.9;

/// Estimates the radius from samples in the grain's own frame; `axes`: semi-axes of the ellipsoid of equal second moments,
/// along the grain's own axes; `may_stand_alone`: whether a point may lie off the surface, as none does that was
/// taken from a face.
pub(crate) fn estimate(
    samples: &[Sample],
    axes: Vector3<f64>,
    may_stand_alone: bool,
    context: &Context<'_>,
) -> Result<Estimate, Cancelled> {
    let mut patches = (samples.len() > WHOLE_CLOUD).then(|| Patches::new(samples, &axes));
    let (reduced, counts) = match &patches {
        Some(patches) => (patches.means.as_slice(), Some(patches.counts.as_slice())),
        None => (samples, None),
    };
    let first = first_degree(reduced.len());
    let rounder = rounder(reduced, counts, axes, first, may_stand_alone, context)?;
    let (mut cloud, mut fit) = (rounder.cloud, rounder.fit);
    let compared = fit.sums.degree();
    let mut degree = first;
    if is_small(cloud.len()) {
        if fit.is_enough() {
            degree = compared;
        }
        fit.spectrum = fit.spectrum.raised(compared, degree);
    }
    let mut outliers = patches
        .as_ref()
        .map_or(rounder.outliers, |patches| patches.left_out);
    let mut rounds = 0;
    let mut lower: Option<(usize, SpectrumFit)> = None;
    // A fit of a higher degree to more points, from which that to fewer starts.
    let mut higher: Option<(usize, SpectrumFit)> = None;
    // The comparison of maps may have found the exact likelihood at this degree.
    let mut is_found = fit.factor.is_some() && compared == first;
    if !is_found {
        let tilt = most_likely(&fit.coefficients, &fit.unlearnt, &fit.spectrum);
        fit.spectrum = fit.spectrum.tilted(tilt);
    }
    loop {
        context.check()?;
        let is_factored = is_small(cloud.len());
        let posterior = match is_found {
            true => Posterior::with(&cloud, Arc::clone(&fit.sums)),
            false => Posterior::new(&cloud, degree, is_factored),
        };
        if !std::mem::take(&mut is_found) {
            let mut coefficients = std::mem::take(&mut fit.coefficients);
            coefficients.resize(coefficient_count(degree), 0.0);
            fit = fit_spectrum(&posterior, fit.spectrum, Some(coefficients), Count::Probed);
        }
        let are_told = patches.as_ref().is_none_or(Patches::are_some_thin);
        let alone = match may_stand_alone && rounds < ROUNDS && are_told {
            true => alone(&posterior, &fit),
            false => Vec::new(),
        };
        let left_out = match &mut patches {
            Some(patches) => patches.leave_out(&alone, |places| residuals(places, &cloud, &fit)),
            None => alone.len(),
        };
        if left_out > 0 {
            rounds += 1;
            outliers += left_out;
            cloud = match &patches {
                Some(patches) => Cloud::new(&patches.means, Some(&patches.counts), cloud.stretch),
                None => cloud.without(&alone),
            };
            // The lower degree was fitted to all points.
            if let Some((lower, before)) = lower.take() {
                higher = Some((degree, fit));
                (degree, fit) = (lower, before);
            }
            continue;
        }
        if let Some((lower, before)) = lower.take()
            && fit.held_out(&cloud) > (1.0 - WORTH_A_DEGREE) * before.held_out(&cloud)
        {
            (degree, fit) = (lower, before);
            break;
        }
        match next_degree(&fit, degree, cloud.len(), is_factored) {
            Some(next) => {
                let start = match higher.take().filter(|(higher, _)| *higher == next) {
                    Some((_, before)) => before,
                    None => SpectrumFit {
                        spectrum: fit.spectrum.raised(degree, next),
                        ..fit.clone()
                    },
                };
                lower = Some((degree, std::mem::replace(&mut fit, start)));
                degree = next;
            }
            None => break,
        }
    }
    let dense = patches.map(|patches| correct(&mut cloud, &patches, &mut fit));
    Ok(Estimate {
        cloud,
        degree,
        coefficients: fit.coefficients,
        spectrum: fit.spectrum,
        unlearnt: fit.unlearnt,
        outliers,
        sums: fit.sums,
        factor: fit.factor,
        dense,
        steady_spares: OnceLock::new(),
    })
}

/// The degree that a cloud of so many points is first fitted at.
fn first_degree(points: usize) -> usize {
    match points {
        0..=20 => 16,
        21..=100 => 30,
        _ => DEGREES[0],
    }
}

/// A higher degree, if the last ones carry something and the points are enough: the next one, or the highest at once where
/// even that is expected to carry something to its end.
fn next_degree(
    fit: &SpectrumFit,
    degree: usize,
    points: usize,
    is_factored: bool,
) -> Option<usize> {
    if is_factored || fit.hides(last_power(&fit.coefficients, degree)) {
        return None;
    }
    let most = MOST_PER_POINT * points as f64;
    let mut higher = DEGREES
        .into_iter()
        .filter(|&next| next > degree && coefficient_count(next) as f64 <= most);
    let highest = higher.clone().next_back()?;
    match fit.expects_little(highest - LAST_DEGREES, highest, points) {
        true => higher.next(),
        false => Some(highest),
    }
}

/// Measured less fitted radii of samples, in the cloud's stretched space and unit.
fn residuals(samples: &[Sample], cloud: &Cloud, fit: &SpectrumFit) -> Vec<f64> {
    let mapped = Cloud::mapped(samples, cloud.stretch, cloud.mean);
    let (directions, measured): (Vec<_>, Vec<_>) = mapped.into_iter().unzip();
    let mut fitted = vec![0.0; directions.len()];
    let harmonics = ScatteredHarmonics::new(fit.sums.degree(), &directions);
    harmonics.synthesis(&fit.coefficients, &mut fitted);
    let pairs = measured.iter().zip(fitted);
    pairs.map(|(measured, fitted)| measured - fitted).collect()
}

/// Adds the patch means of the residuals, and solves again.
fn correct(cloud: &mut Cloud, patches: &Patches, fit: &mut SpectrumFit) -> Dense {
    let residuals = residuals(patches.places(), cloud, fit);
    let within = patches.spread_of(&residuals);
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
