//! From a round of a refinement to the fit of all samples.

use super::normal::{Normal, Prior};
use super::system::System;
use super::{Cloud, Joined};
use crate::fit::Residuals;
use crate::fit::prepare::PreparedScan;
use crate::fit::samples::Sample;
use crate::fit::search::Candidate;
use crate::fit::spread::Spread;
use crate::measure::blended_properties;
use crate::model::Blended;

/// The fit of all samples of a cloud, and what is known of it, from the problem of a round.
pub(super) fn finish(
    prepared: &PreparedScan,
    cloud: &Cloud<'_>,
    (system, normal, prior): (&System<'_>, &Normal, &Prior),
    measured: bool,
) -> (Joined, Candidate) {
    let samples: &[Sample] = &cloud.samples;
    // Rounds are made with one sample per patch where the cloud is large.
    let whole = cloud.thinned.map(|_| {
        let bases = prepared.bases(prepared.top_degree());
        System::new(system.cover.clone(), bases, system.degrees.clone(), samples)
    });
    let (coefficients, factor) = match &whole {
        Some(whole) => whole.solve_refined(whole.normal(), prior),
        None => system.solve_refined(normal.clone(), prior),
    };
    let inverse = factor.inverse();
    let errors = system.errors(&coefficients, &inverse);
    let residuals = match &whole {
        Some(whole) => &whole.residuals(&coefficients),
        None => &errors.residuals,
    };
    let squared: f64 = residuals.iter().map(|e| e * e).sum();
    let spare = samples.len() as f64 - system.determined(prior, &inverse);
    let integrals = measured
        .then(|| Blended::new(system.cover.clone(), coefficients.clone()).ok())
        .flatten()
        .map(|surface| blended_properties(&surface).properties);
    let reference = &prepared.reference;
    let candidate = Candidate {
        area_error: integrals.map(|found| found.area / reference.area - 1.0),
        volume_error: integrals.map(|found| found.volume / reference.volume - 1.0),
        heldout_rms: Some(errors.heldout_rms()),
        rejected: errors.rejection(cloud.probes()),
        ..system.candidate()
    };
    let joined = Joined {
        cover: system.cover.clone(),
        residuals: Residuals {
            rms: (squared / samples.len() as f64).sqrt(),
            max: residuals.iter().fold(0.0, |most, e| e.abs().max(most)),
        },
        coefficients,
        spread: Spread {
            factor,
            variance: squared / spare.max(1.0),
            model_error: prepared.tolerance,
        },
    };
    (joined, candidate)
}
