//! The best models that a few well-placed and well-weighted samples give.
//!
//! The samples are Gauss points that respect the edges ([`SamplingDensity`]); searched are the three exponents
//! of their density, over a fixed grid, and for each pair of the others the exponent of the radius at
//! which the volume is exact.

use super::study::{Figures, Study};
use grainform::fit::MirroredFitError;
use grainform::shapes::SamplingDensity;
use rayon::prelude::*;

/// Steps of the false position at the end of which the volume is exact to some 1e-6.
const STEPS: usize = 6;

/// Exponents of the radius that are searched.
const RADII: std::ops::RangeInclusive<i32> = -8..=4;

/// A sampling and what it comes to.
#[derive(Clone, Copy)]
pub(crate) struct Found {
    pub(crate) density: SamplingDensity,
    pub(crate) figures: Figures,
}

/// What is to be beaten.
pub(crate) struct Goal {
    /// LS error over that of the threshold.
    pub(crate) ls_ratio: f64,
    /// Relative error of the area against the exact one.
    pub(crate) area: f64,
    /// Relative error of the volume.
    pub(crate) volume: f64,
}

impl Goal {
    /// The figures as shares of the goals, named: those below one are better.
    fn shares(&self, figures: &Figures) -> [(&'static str, f64); 3] {
        [
            ("LS", figures.ls_ratio / self.ls_ratio),
            ("S", figures.area_error.abs() / self.area),
            ("V", figures.volume_error.abs() / self.volume),
        ]
    }

    /// The largest share: below one, all are better.
    pub(crate) fn worst(&self, figures: &Figures) -> f64 {
        let shares = self.shares(figures).into_iter();
        shares.map(|(_, share)| share).fold(0.0, f64::max)
    }

    /// The names of the figures that are better.
    pub(crate) fn better(&self, figures: &Figures) -> Vec<&'static str> {
        let shares = self.shares(figures).into_iter();
        let better = shares.filter_map(|(name, share)| (share < 1.0).then_some(name));
        better.collect()
    }
}

/// The model of a density.
pub(crate) fn found(
    study: &Study,
    [polar, azimuth]: [usize; 2],
    density: SamplingDensity,
) -> Result<Found, MirroredFitError> {
    let samples = density.sample(study.shape.as_ref(), polar, azimuth);
    let figures = study.figures(&study.model(&samples)?);
    Ok(Found { density, figures })
}

/// Every model of the search over pairs of exponents of the sine and the slope, in a fixed order.
pub(crate) fn search(
    study: &Study,
    samples: [usize; 2],
    sines: &[f64],
    slopes: &[f64],
) -> Result<Vec<Found>, MirroredFitError> {
    let pairs: Vec<(f64, f64)> = slopes
        .iter()
        .flat_map(|&slope| sines.iter().map(move |&sine| (sine, slope)))
        .collect();
    let found = |sine: f64, radius: f64, slope: f64| {
        let density = SamplingDensity {
            sine,
            radius,
            slope,
        };
        found(study, samples, density)
    };
    let per_pair: Result<Vec<Vec<Found>>, MirroredFitError> = pairs
        .into_par_iter()
        .map(|(sine, slope)| {
            let radii = RADII.map(f64::from);
            let mut all = radii
                .map(|radius| found(sine, radius, slope))
                .collect::<Result<Vec<_>, _>>()?;
            for i in 1..all.len() {
                let ends = [all[i - 1], all[i]];
                let [low, high] = ends.map(|found| found.figures.volume_error);
                if low.signum() != high.signum() {
                    all.push(exact_volume(ends, |radius| found(sine, radius, slope))?);
                }
            }
            Ok(all)
        })
        .collect();
    Ok(per_pair?.into_iter().flatten().collect())
}

/// The sampling between two whose volume is exact: by false position with the end that stays counting
/// half (Illinois).
fn exact_volume(
    ends: [Found; 2],
    found: impl Fn(f64) -> Result<Found, MirroredFitError>,
) -> Result<Found, MirroredFitError> {
    let mut best = ends[0];
    let [mut low, mut high] = ends.map(|end| (end.density.radius, end.figures.volume_error));
    for _ in 0..STEPS {
        best = found((low.0 * high.1 - high.0 * low.1) / (high.1 - low.1))?;
        let next = (best.density.radius, best.figures.volume_error);
        if next.1.abs() < 1e-7 {
            break;
        }
        if next.1.signum() == low.1.signum() {
            (low, high.1) = (next, high.1 / 2.0);
        } else {
            (high, low.1) = (next, low.1 / 2.0);
        }
    }
    Ok(best)
}
