//! The linear map that makes a grain rounder: of three strengths the one under which its points are most likely.
//!
//! Maps are compared at a low degree, which does not follow points that stand alone, as a high one does with nearly as
//! many coefficients as points. So these are left out here. Only maps that this does not tell apart are compared at the
//! full degree, those of small clouds by what a first step promises there: their matrices take ten times as long.

use super::cloud::Cloud;
use super::outliers::{ROUNDS, alone};
use super::posterior::{Posterior, is_factored, is_small};
use super::spectrum::Spectrum;
use super::spectrum_fit::SpectrumFit;
use super::spectrum_search::{Count, first_step, fit_spectrum};
use crate::fit::context::{Cancelled, Context};
use crate::fit::points::without::without;
use crate::fit::prepare::Sample;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Strengths of the map: T = diag(semi-axes)^-k.
const STRENGTHS: [f64; 3] = [1.0, 0.5, 0.0];

/// Axes that differ by less than this need no map.
const ROUND: f64 = 1.03;

/// Degree at which maps of so many points are compared: of few points a lower one tells maps apart as well as a higher one, in
/// half of the time, and then leads to a spectrum that is a tenth nearer to the truth (of 98 points of 13 textured bodies).
fn compared_degree(points: usize) -> usize {
    match points {
        0..=50 => 12,
        51..=100 => 16,
        101..=200 => 20,
        _ => 24,
    }
}

/// Maps that differ by less than this per point in the logarithm of the likelihood are compared again: those of small
/// clouds by the exact likelihood, those of others at the full degree.
const CLOSE: f64 = 0.1;

/// The same for the exact likelihood at the low degree: those that it does not tell apart are compared at the full one, for
/// of a clean, textured grain what the low degree leaves passes for noise.
const TIED: f64 = 0.03;

/// Points on which maps are compared.
const COMPARED_POINTS: usize = 2000;

/// A cloud after the map under which its points are most likely.
pub(super) struct Stretched {
    pub(super) cloud: Cloud,
    /// Its fit, of a low degree or the first.
    pub(super) fit: SpectrumFit,
    /// Points that stand alone and were left out.
    pub(super) outliers: usize,
}

/// A cloud after a map, and its fit.
struct Mapped {
    cloud: Cloud,
    fit: SpectrumFit,
}

/// Compares maps; `first` is the degree that the cloud is fitted at next.
pub(super) fn likeliest_stretch(
    samples: &[Sample],
    counts: Option<&[f64]>,
    axes: Vector3<f64>,
    first: usize,
    may_stand_alone: bool,
    context: &Context<'_>,
) -> Result<Stretched, Cancelled> {
    let compared = first.min(compared_degree(samples.len()));
    let mean = (axes.x * axes.y * axes.z).cbrt();
    let stretch = |strength: f64| axes.map(|axis| (mean / axis).powf(strength));
    let strengths = match axes.max() > ROUND * axes.min() {
        true => &STRENGTHS[..],
        false => &STRENGTHS[2..],
    };
    let maps_of = |samples: &[Sample]| -> Vec<Mapped> {
        let maps = strengths.par_iter().map(|&strength| {
            let cloud = Cloud::new(samples, counts, stretch(strength), axes / mean);
            let every = cloud.len().div_ceil(COMPARED_POINTS);
            let part = (compared < first).then(|| cloud.every(every));
            let part = part.as_ref().unwrap_or(&cloud);
            let fit = fitted(part, compared, Spectrum::start());
            Mapped { cloud, fit }
        });
        maps.collect()
    };
    let is_whole = counts.is_none() && samples.len() <= COMPARED_POINTS;
    let (mut maps, outliers) = match may_stand_alone && is_whole {
        true => without_outliers(samples, maps_of),
        false => (maps_of(samples), 0),
    };
    tell_apart(&mut maps, compared, first, context)?;
    let best = best(&maps);
    let Mapped { cloud, fit } = maps.swap_remove(best);
    Ok(Stretched {
        cloud,
        fit,
        outliers,
    })
}

/// The maps of what is left where the points that stand alone in the best of them are left out, and their number.
fn without_outliers(
    samples: &[Sample],
    maps_of: impl Fn(&[Sample]) -> Vec<Mapped>,
) -> (Vec<Mapped>, usize) {
    let mut maps = maps_of(samples);
    let mut samples = Cow::Borrowed(samples);
    let mut outliers = 0;
    for _ in 0..ROUNDS {
        let best = &maps[best(&maps)];
        let posterior = Posterior::with(&best.cloud, Arc::clone(&best.fit.sums));
        let alone = alone(&posterior, &best.fit);
        if alone.is_empty() {
            break;
        }
        outliers += alone.len();
        samples = Cow::Owned(without(&samples, alone));
        maps = maps_of(&samples);
    }
    (maps, outliers)
}

/// Drops maps that are clearly worse, and fits closer those that are left, as far as it takes to tell them apart.
fn tell_apart(
    maps: &mut Vec<Mapped>,
    compared: usize,
    first: usize,
    context: &Context<'_>,
) -> Result<(), Cancelled> {
    let points = maps[0].cloud.len();
    let is_small = is_small(points);
    let points = points.min(COMPARED_POINTS) as f64;
    keep(maps, CLOSE * points);
    if maps.len() == 1 || compared == first {
        return Ok(());
    }
    if is_small {
        maps.par_iter_mut().try_for_each(|map| {
            context.check()?;
            let posterior = Posterior::new(&map.cloud, compared, true);
            map.fit = first_step(&posterior, map.fit.spectrum);
            Ok(())
        })?;
        keep(maps, TIED * points);
        if maps.len() == 1 || maps.iter().all(|map| map.fit.is_enough()) {
            return Ok(());
        }
    }
    maps.par_iter_mut().try_for_each(|map| {
        context.check()?;
        map.fit = match is_small {
            true => {
                let posterior = Posterior::new(&map.cloud, first, true);
                first_step(&posterior, map.fit.spectrum.raised(compared, first))
            }
            false => fitted(&map.cloud, first, map.fit.spectrum),
        };
        Ok(())
    })
}

fn fitted(cloud: &Cloud, degree: usize, start: Spectrum) -> SpectrumFit {
    let posterior = Posterior::new(cloud, degree, is_factored(cloud.len(), degree));
    fit_spectrum(&posterior, start, None, Count::Even)
}

/// Drops the maps that the best one is better than by more than this.
fn keep(maps: &mut Vec<Mapped>, margin: f64) {
    let close = maps[best(maps)].fit.cost + margin;
    maps.retain(|map| map.fit.cost <= close);
}

/// Which is the first of those under which the points are most likely.
fn best(maps: &[Mapped]) -> usize {
    let cost = |at: usize| maps[at].fit.cost;
    let least = |best, at| if cost(at) < cost(best) { at } else { best };
    (1..maps.len()).fold(0, least)
}
