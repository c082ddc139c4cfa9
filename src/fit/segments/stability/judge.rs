//! A fitted grain against the same fits in extended precision, segment by segment.

use super::extended::{Sample, fitted_radii, largest_radius};
use crate::fit::{FitOptions, Fitted, Seams};
use crate::model::{Segmented, StarGrain, Surface};
use crate::sphere::{Cap, CapBasis, coefficient_count};
use nalgebra::Point3;
use rayon::prelude::*;

/// Asks for the segments' own, independent expansions: k x k of them, all of one degree.
pub(super) fn options(k: usize, degree: usize) -> FitOptions {
    FitOptions::default()
        .with_seams(Seams::None)
        .with_degree(degree)
        .with_segments(k * k)
}

/// Agreement with extended precision, relative to the radius, that the fit promises wherever
/// the samples determine the answer.
pub(super) const PROMISE: f64 = 1e-12;

/// What became of the segments of a grain.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Verdict {
    /// Largest distance between the radii fitted in double and in extended precision, at the
    /// samples fitted, relative to the largest radius among them.
    pub(super) error: f64,
    /// Whether any segment was fitted at a lower degree than was asked for.
    pub(super) lowered: bool,
}

/// The distinct points of a scan in the frame of its grain, by segment.
///
/// # Panics
/// If the fit left points out as strays: a judge must see what the fit has seen.
pub(super) fn samples_by_segment(fitted: &Fitted, points: &[Point3<f64>]) -> Vec<Vec<Sample>> {
    let grain = fitted.grain.star().expect("a radius");
    let mut points: Vec<[f64; 3]> = points.iter().map(|&p| p.into()).collect();
    points.sort_unstable_by(|a, b| a.partial_cmp(b).expect("finite points"));
    points.dedup();
    assert_eq!(points.len(), fitted.points);
    let partition = segmented(grain).partition();
    let mut segments = vec![Vec::new(); partition.segments()];
    for point in points {
        let sample = Sample::new(&point.into(), &grain.frame());
        segments[partition.segment_of(&sample.direction)].push(sample);
    }
    segments
}

/// The surface of a grain, made of independent segments.
pub(super) fn segmented(grain: &StarGrain) -> &Segmented {
    grain.family().segmented().expect("independent segments")
}

/// Fits every segment again, at the degree and to the samples that the library took.
///
/// Which samples those were, the grain does not say: its segment's own, or those of the cap round
/// it where the former leave the answer open. The fit that comes nearer tells.
pub(super) fn judge(grain: &StarGrain, degree: usize, segments: &[Vec<Sample>]) -> Verdict {
    let all: Vec<&Sample> = segments.iter().flatten().collect();
    let verdict = |(segment, own): (usize, &Vec<Sample>)| {
        let cap = segmented(grain).partition().cap(segment);
        let coefficients = &grain.coefficients()[segment];
        let own = error(coefficients, &cap, own);
        let error = if own <= PROMISE {
            own
        } else {
            own.min(error(coefficients, &cap, &samples_of_cap(&cap, &all)))
        };
        let lowered = coefficients.len() < coefficient_count(degree);
        Verdict { error, lowered }
    };
    let worse = |a: Verdict, b: Verdict| Verdict {
        error: a.error.max(b.error),
        lowered: a.lowered || b.lowered,
    };
    segments
        .par_iter()
        .enumerate()
        .map(verdict)
        .reduce(Verdict::default, worse)
}

/// Largest distance of an expansion from the best one at the samples, relative to the largest
/// radius; infinite if the samples are too few to have been fitted, which takes two per coefficient.
fn error(coefficients: &[f64], cap: &Cap, samples: &[Sample]) -> f64 {
    if samples.len() < 2 * coefficients.len() {
        return f64::INFINITY;
    }
    let degree = coefficients.len().isqrt() - 1;
    let basis = CapBasis::new(degree);
    let exact = fitted_radii(degree, cap, samples);
    let distances = samples.iter().zip(exact).map(|(sample, exact)| {
        let fitted = basis.value(cap, coefficients, &sample.direction);
        assert!(fitted.is_finite() && exact.is_finite());
        (fitted - exact).abs()
    });
    distances.fold(0.0, f64::max) / largest_radius(samples)
}

/// How far beyond its rim, and with how few samples, the library takes what belongs to a cap.
const BEYOND_THE_RIM: f64 = 1.013;
const FEWEST_OF_CAP: usize = 12;

/// The samples of a whole cap, to a little beyond its rim; the nearest dozen where it holds fewer.
fn samples_of_cap(cap: &Cap, all: &[&Sample]) -> Vec<Sample> {
    let distance = |sample: &Sample| (sample.direction - cap.centre).norm_squared();
    let reach = 2.0 * BEYOND_THE_RIM * cap.height;
    let within: Vec<Sample> = all
        .iter()
        .filter(|s| distance(s) <= reach)
        .map(|&s| s.clone())
        .collect();
    if within.len() >= FEWEST_OF_CAP {
        return within;
    }
    let mut nearest = all.to_vec();
    nearest.sort_unstable_by(|a, b| {
        let by_distance = distance(a).total_cmp(&distance(b));
        by_distance.then(a.radius().total_cmp(&b.radius()))
    });
    nearest.truncate(FEWEST_OF_CAP);
    nearest.into_iter().cloned().collect()
}
