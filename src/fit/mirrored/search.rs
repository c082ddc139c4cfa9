//! The search for the degree of an expansion with mirror images.
//!
//! **Rule.** The lowest degree whose held-out RMS e is within the limit, e^2 <= tolerance^2 + noise^2,
//! else the least held-out RMS. A degree needs two points per coefficient in each image, for the points
//! of a symmetric scan come in images of each other, and only one of them tells of the surface; else
//! the largest degree that the points support takes its place.
//!
//! **Held-out error.** Every point is predicted from all others, its images included.

use crate::fit::candidate::{Candidate, Rejection, Search, Work, choose};
use crate::fit::context::{Context, Stage};
use crate::fit::error::FitError;
use crate::fit::linear::Factorization;
use crate::fit::options::FitOptions;
use crate::fit::outcome::Residuals;
use crate::fit::prepare::{CellGrid, PreparedScan, Sample};
use crate::fit::segments::{
    FittedLevel, HeldOut, LARGEST_MISS, Levels, SAMPLES_PER_COEFFICIENT, leave_one_out,
};
use crate::measure::grain_properties;
use crate::model::{Mirrored, StarSurface};
use crate::sphere::{CapBasis, Places, Symmetry, coefficient_count};
use nalgebra::Vector3;

/// Degree of the local fits that tell of the noise, and of those that tell of the asymmetry.
pub(crate) const LOCAL_DEGREE: usize = 3;

/// Degrees up to which the expansion is fitted at first: each costs half as much as the next.
const STEPS: [usize; 5] = [4, 6, 9, 12, 16];

/// Distance from a mirror, in radians, within which a sample lies on it: rounding makes 1e-15.
const ON_MIRROR: f64 = 1e-9;

/// The expansion with mirror images that a search chose.
pub(crate) struct MirroredFit {
    pub(crate) surface: Mirrored,
    /// Distinct points.
    pub(crate) points: usize,
    pub(crate) residuals: Residuals,
    /// Root mean square difference between the images, in the scan's unit.
    pub(crate) asymmetry: f64,
    pub(crate) search: Search,
}

/// Searches the degrees asked for.
pub(crate) fn search(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<MirroredFit, FitError> {
    context.enter(Stage::Searching { done: 0, all: None })?;
    let whole = CellGrid::new([1]);
    let samples = prepared.samples(&whole);
    let samples = samples.rows();
    let symmetry = options.symmetry;
    let folded = fold(samples, symmetry);
    let probes = match prepared.probes(&whole) {
        Some(thinned) => &fold(thinned.rows(), symmetry),
        None => &folded,
    };
    let (degrees, top) = (options.degrees(), options.top_degree());
    let noise = options.degree.is_none().then(|| {
        let degree = top.min(LOCAL_DEGREE);
        let levels = Levels::new(prepared, &[1], degree);
        let level = levels.level(levels.noise_parts, degree);
        FittedLevel::new(&level).residual_variance().sqrt()
    });
    // Points that are all met tell of no noise.
    let noise = noise.filter(|noise| *noise > 0.0);
    let tolerance = options.tolerance.length(prepared.mean_radius);
    let limit = tolerance.hypot(noise.unwrap_or(0.0));

    let is_step = |&step: &usize| step < top && !options.exhaustive && options.degree.is_none();
    let mut steps = STEPS.into_iter().filter(is_step).chain([top]);
    let mut up_to = |degree: usize| {
        let step = steps.find(|&step| step >= degree).unwrap_or(top);
        Expansions::new(&folded, probes, symmetry, &CapBasis::new(step))
    };
    let mut expansions = up_to(degrees[0]);
    let mut candidates: Vec<Candidate> = Vec::new();
    let is_enough = |c: &Candidate| {
        c.rejected.is_none() && c.heldout_rms.is_some_and(|heldout| heldout <= limit)
    };
    for &degree in &degrees {
        let can_win = options.exhaustive || !candidates.iter().any(is_enough);
        if can_win && degree > expansions.degree {
            expansions = up_to(degree);
        }
        candidates.push(if can_win {
            expansions.candidate(degree, prepared)
        } else {
            Candidate::skipped(degree, 1)
        });
    }
    let chosen = choose(&candidates, limit);
    let surface = expansions.surface(candidates[chosen].degree);
    let is_skipped = |c: &&Candidate| c.rejected == Some(Rejection::Skipped);
    let candidates_skipped = candidates.iter().filter(is_skipped).count();
    let work = Work {
        candidates: candidates.len() - candidates_skipped,
        candidates_skipped,
        segments: 1,
        segments_skipped: 0,
    };
    Ok(MirroredFit {
        residuals: residuals(&surface, samples),
        surface,
        points: samples.len(),
        asymmetry: asymmetry(samples, symmetry),
        search: Search {
            candidates,
            chosen,
            limit,
            tolerance,
            noise,
            work,
        },
    })
}

fn fold(samples: &[Sample], symmetry: Symmetry) -> Vec<Sample> {
    let fold = |&[x, y, z, radius]: &Sample| {
        let [x, y, z] = symmetry.fold(&Vector3::new(x, y, z)).into();
        [x, y, z, radius]
    };
    samples.iter().map(fold).collect()
}

/// The expansions of every degree that the folded samples support.
struct Expansions {
    symmetry: Symmetry,
    /// The largest degree asked for.
    degree: usize,
    /// By degree.
    coefficients: Vec<Vec<f64>>,
    held_out: Vec<HeldOut>,
}

impl Expansions {
    fn new(folded: &[Sample], probes: &[Sample], symmetry: Symmetry, basis: &CapBasis) -> Self {
        let cap = symmetry.cap();
        let mut factorization = Factorization::new(basis.degree());
        factorization.add_samples(basis, &cap, folded);
        let triangle = factorization.triangle();
        let top = supported_degree(folded.len() / symmetry.images())
            .min(triangle.full_rank_degree().unwrap_or(0))
            .min(basis.degree());
        let mut places = Places::default();
        cap.locate(probes, &mut places);
        let mut values = vec![0.0; coefficient_count(basis.degree()) * probes.len()];
        basis.evaluate(&places, &mut values, probes.len());
        Self {
            symmetry,
            degree: basis.degree(),
            coefficients: (0..=top).map(|degree| triangle.solve(degree)).collect(),
            held_out: leave_one_out(&triangle, top, probes, &mut values),
        }
    }

    /// The largest degree up to the given one.
    fn at_most(&self, degree: usize) -> usize {
        degree.min(self.coefficients.len() - 1)
    }

    fn surface(&self, degree: usize) -> Mirrored {
        let coefficients = self.coefficients[self.at_most(degree)].clone();
        Mirrored::new(self.symmetry, coefficients)
            .expect("finite samples give finite coefficients, (L + 1)^2 of them")
    }

    fn candidate(&self, degree: usize, prepared: &PreparedScan<'_>) -> Candidate {
        let fitted = self.at_most(degree);
        let held_out = self.held_out[fitted];
        let found = grain_properties(&self.surface(fitted)).properties;
        Candidate {
            area_error: Some(found.area / prepared.reference.area - 1.0),
            volume_error: Some(found.volume / prepared.reference.volume - 1.0),
            heldout_rms: Some((held_out.squared / held_out.count.max(1) as f64).sqrt()),
            rejected: match held_out.worst {
                _ if fitted < degree => Some(Rejection::Unsupported { degree }),
                worst if worst > LARGEST_MISS => Some(Rejection::Misses { worst }),
                _ => None,
            },
            ..Candidate::unfitted(degree, 1, coefficient_count(degree))
        }
    }
}

/// The largest degree for which there are two samples per coefficient.
fn supported_degree(samples: usize) -> usize {
    (samples / SAMPLES_PER_COEFFICIENT)
        .isqrt()
        .saturating_sub(1)
}

fn residuals(surface: &Mirrored, samples: &[Sample]) -> Residuals {
    let radius = |x, y, z| surface.radius(&Vector3::new(x, y, z));
    Residuals::of(
        samples
            .iter()
            .map(|&[x, y, z, seen]| seen - radius(x, y, z)),
    )
}

/// Root mean square difference of the radius between mirror images, over the directions of the samples.
///
/// The residuals round the expansion that is common to all images are fitted again in each image; what
/// such a fit follows beyond the scatter of the samples is by how much the image differs from the mean
/// of all. With k images, the mean square difference of two is 2 k / (k - 1) times that from the mean.
fn asymmetry(samples: &[Sample], symmetry: Symmetry) -> f64 {
    let images = by_image(samples, symmetry);
    let all: usize = images.iter().map(Vec::len).sum();
    let degree = supported_degree(all / images.len().max(1)).min(LOCAL_DEGREE);
    let (basis, cap) = (CapBasis::new(degree), symmetry.cap());
    let mut factorization = Factorization::new(degree);
    for image in &images {
        factorization.add_samples(&basis, &cap, image);
    }
    let triangle = factorization.triangle();
    let common = triangle.solve(degree.min(triangle.full_rank_degree().unwrap_or(0)));

    let squared: f64 = images
        .iter()
        .map(|image| {
            let residual = |&[x, y, z, radius]: &Sample| {
                let value = basis.value(&cap, &common, &Vector3::new(x, y, z));
                [x, y, z, radius - value]
            };
            let residuals: Vec<Sample> = image.iter().map(residual).collect();
            factorization.clear();
            factorization.add_samples(&basis, &cap, &residuals);
            let triangle = factorization.triangle();
            let degree = degree.min(supported_degree(image.len()));
            let count = coefficient_count(degree);
            let followed: f64 = (0..count).map(|i| triangle.projection(i).powi(2)).sum();
            let variance = triangle.residual_variance(degree, image.len());
            followed - count as f64 * variance.unwrap_or(0.0)
        })
        .sum();
    let k = images.len() as f64;
    (2.0 * k / (k - 1.0).max(1.0) * squared.max(0.0) / all as f64).sqrt()
}

/// The folded samples of each image that holds any; those on a mirror belong to both sides.
fn by_image(samples: &[Sample], symmetry: Symmetry) -> Vec<Vec<Sample>> {
    let mut images = vec![Vec::new(); 8];
    for (sample, folded) in samples.iter().zip(fold(samples, symmetry)) {
        let sides = [0, 1, 2].map(|i| {
            let is_mirrored = symmetry.fold(&-Vector3::ith(i, 1.0))[i] > 0.0;
            let on_both = is_mirrored && folded[i] < ON_MIRROR;
            let is_far = is_mirrored && sample[i] < 0.0;
            [on_both || !is_far, on_both || is_far]
        });
        for (image, own) in images.iter_mut().enumerate() {
            if (0..3).all(|i| sides[i][image >> i & 1]) {
                own.push(folded);
            }
        }
    }
    images.retain(|image| !image.is_empty());
    images
}

#[cfg(test)]
mod tests;
