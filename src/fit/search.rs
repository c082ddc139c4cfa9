//! The search over segment count and degree.
//!
//! **Rule.** Among the candidates that are not rejected, take the fewest coefficients whose held-out
//! RMS is within the limit; of several with the same count, the one that deviates least from the
//! reference surface (|area error| + |volume error|). Where none is within the limit, take the least
//! held-out RMS. The limit is the tolerance, or the scan's noise floor where that is larger. The
//! reference deviations alone do not decide: the reference is a polyhedron that is itself off by up
//! to some percent, and coarse steppy surfaces meet its area by accident.
//!
//! **Held-out error.** Every sample is predicted from all samples but itself (leave-one-out, in
//! closed form: residual / (1 - leverage)); of clouds above 16 384 points, one point in each of
//! 13 824 patches of directions.
//!
//! **Noise floor.** 1.1 times the standard deviation of the samples round a local fit with some 32
//! samples per segment: a model within it adds less than half the noise to the truth.
//!
//! **Skipping.** Levels are fitted from coarse to fine. Once a candidate is within the limit, those
//! with more coefficients cannot win and are not fitted; a level is factored only up to the largest
//! degree that still can.

use super::joint::Joined;
use super::level::{FittedLevel, LARGEST_MISS};
use super::mirrored::MirroredFit;
use super::options::Seams;
use super::prepare::PreparedScan;
use super::segment::SegmentFit;
use crate::sphere::coefficient_count;
use std::fmt;

/// One setting of the search and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments, n_s = k^2.
    pub segments: usize,
    /// (degree + 1)^2 n_s.
    pub coefficients: usize,
    /// Segments fitted at a lower degree, because their samples do not support this one.
    pub reduced_segments: usize,
    /// Area against the reference surface: signed, relative. `None` if not fitted.
    pub area_error: Option<f64>,
    /// Volume against the reference surface: signed, relative. `None` if not fitted.
    pub volume_error: Option<f64>,
    /// Root mean square of the radial leave-one-out errors, in the scan's unit. `None` if not fitted.
    pub heldout_rms: Option<f64>,
    /// Why this candidate cannot be chosen, if so.
    pub rejected: Option<Rejection>,
}

/// Why a candidate cannot be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rejection {
    /// It has more coefficients than one that is good enough already, and was not fitted.
    Skipped,
    /// No segment holds the samples that this degree needs.
    Unsupported {
        /// The degree.
        degree: usize,
    },
    /// It misses a held-out sample by too much.
    Misses {
        /// The largest error relative to the radius.
        worst: f64,
    },
    /// Its segments do not meet: between samples, at least one of them is far off.
    Tears {
        /// The largest difference at a seam, relative to the radius.
        by: f64,
    },
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Skipped => write!(
                f,
                "skipped: one with fewer coefficients is within the limit"
            ),
            Self::Unsupported { degree } => {
                write!(f, "too few points for degree {degree}")
            }
            Self::Misses { worst } => {
                write!(f, "misses a point by {:.0} % of its radius", 100.0 * worst)
            }
            Self::Tears { by } => write!(f, "tears at a seam by {:.0} % of the radius", 100.0 * by),
        }
    }
}

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// How segments are joined.
    pub seams: Seams,
    /// Every candidate: by segments and then by degree, or the whole sphere by degree and then the
    /// rounds of the refinement.
    pub candidates: Vec<Candidate>,
    /// Index of the chosen one.
    pub chosen: usize,
    /// The held-out RMS that was good enough, in the scan's unit.
    pub limit: f64,
    /// Standard deviation of the samples round a local fit, in the scan's unit.
    pub noise: f64,
    /// Points that stand apart from the fitted surface and were left out.
    pub outliers: usize,
    /// What the search did and what it could leave out.
    pub work: Work,
}

/// A count of work done and avoided.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Candidates fitted.
    pub candidates: usize,
    /// Candidates that could not win and were not fitted.
    pub candidates_skipped: usize,
    /// Segments factored.
    pub segments: usize,
    /// Segments of levels of which no candidate could win.
    pub segments_skipped: usize,
}

impl Search {
    /// The chosen candidate.
    pub fn choice(&self) -> &Candidate {
        &self.candidates[self.chosen]
    }

    /// Whether the candidates are rounds of one refinement.
    pub(crate) fn is_blended(&self) -> bool {
        self.seams == Seams::Blended
    }

    /// What a user should know of the choice: whole sentences.
    pub(crate) fn warnings(&self) -> impl Iterator<Item = String> {
        let outliers = (self.outliers > 0).then(|| {
            let [stand, were] = match self.outliers {
                1 => ["point stands", "was"],
                _ => ["points stand", "were"],
            };
            format!(
                "{} {stand} apart from the fitted surface and from the neighbours, and {were} left \
                 out.",
                self.outliers
            )
        });
        outliers.into_iter().chain(self.warning())
    }

    /// What is wrong with the choice, if anything: a whole sentence.
    fn warning(&self) -> Option<String> {
        let reason = self.choice().rejected?;
        let advice = "Its area, volume and inertia are as good as their deviations say, but look at \
                      the mesh before relying on details of the surface.";
        Some(match reason {
            Rejection::Unsupported { degree } if self.choice().segments == 1 => format!(
                "There are too few points for degree {degree}; the surface was fitted at the largest \
                 degree that they support."
            ),
            Rejection::Unsupported { degree } => format!(
                "No segment holds the points that degree {degree} needs; each was fitted at the \
                 largest degree that its points support."
            ),
            _ if self.is_blended() || self.candidates.len() == 1 => {
                format!("This fit {reason}. {advice}")
            }
            _ => format!(
                "Every candidate misses a point or tears at a seam by more than {:.0} % of the \
                 radius; the one with the least held-out error was taken, and it {reason}. {advice}",
                100.0 * LARGEST_MISS
            ),
        })
    }
}

/// The findings of a search, and the fit of the chosen candidate.
pub struct Found {
    /// The findings.
    pub search: Search,
    pub(crate) fit: FoundFit,
}

/// The fit of a candidate.
pub(crate) enum FoundFit {
    /// Independent segments, each at every degree.
    Segments(Vec<SegmentFit>),
    /// A jointly fitted surface.
    Joined(Joined),
    /// One expansion and its mirror images.
    Mirrored(MirroredFit),
}

/// A local fit adds noise / sqrt(samples per coefficient); the limit leaves room for that.
const NOISE_MARGIN: f64 = 1.1;

/// Searches the prepared scan; tells `progress` how many levels are done.
pub(crate) fn search(prepared: &PreparedScan, progress: &dyn Fn(usize)) -> Found {
    let (degrees, parts) = (&prepared.degrees, &prepared.parts);
    let top = degrees[degrees.len() - 1];
    let mut work = Work::default();
    let mut fit = |k: usize, degree: usize| {
        work.segments += k * k;
        FittedLevel::new(&prepared.level(k, degree))
    };

    let only_one = degrees.len() * parts.len() == 1;
    let noise_level = (!only_one).then(|| (prepared.noise_parts, fit(prepared.noise_parts, top)));
    let noise = noise_level
        .as_ref()
        .map_or(0.0, |(_, level)| level.residual_variance().sqrt());
    let limit = prepared.tolerance.max(NOISE_MARGIN * noise);

    let mut candidates = Vec::with_capacity(degrees.len() * parts.len());
    let mut levels = Vec::with_capacity(parts.len());
    let mut enough = usize::MAX;
    for (done, &k) in parts.iter().enumerate() {
        progress(done);
        let within_reach =
            |degree: usize| prepared.exhaustive || k * k * coefficient_count(degree) <= enough;
        let reachable = degrees.iter().copied().filter(|&d| within_reach(d)).max();
        let level = reachable.map(|degree| match &noise_level {
            Some((noise_parts, level)) if *noise_parts == k => level.clone(),
            _ => fit(k, degree),
        });
        for &degree in degrees {
            candidates.push(match &level {
                Some(level) if within_reach(degree) => level.candidate(degree, &prepared.reference),
                _ => skipped(degree, k),
            });
        }
        for candidate in &candidates[candidates.len() - degrees.len()..] {
            if candidate.rejected.is_none() && candidate.heldout_rms.is_some_and(|rms| rms <= limit)
            {
                enough = enough.min(candidate.coefficients);
            }
        }
        levels.push(level);
    }

    let chosen = choose(&candidates, limit);
    let fitted = |c: &&Candidate| c.rejected != Some(Rejection::Skipped);
    work.candidates = candidates.iter().filter(fitted).count();
    work.candidates_skipped = candidates.len() - work.candidates;
    work.segments_skipped = levels
        .iter()
        .zip(parts)
        .filter(|(level, _)| level.is_none())
        .map(|(_, k)| k * k)
        .sum();
    let segments = levels
        .swap_remove(chosen / degrees.len())
        .map_or_else(Vec::new, |level| level.segments);
    let search = Search {
        seams: Seams::None,
        candidates,
        chosen,
        limit,
        noise,
        outliers: 0,
        work,
    };
    Found {
        search,
        fit: FoundFit::Segments(segments),
    }
}

pub(super) fn skipped(degree: usize, k: usize) -> Candidate {
    Candidate {
        degree,
        segments: k * k,
        coefficients: k * k * coefficient_count(degree),
        reduced_segments: 0,
        area_error: None,
        volume_error: None,
        heldout_rms: None,
        rejected: Some(Rejection::Skipped),
    }
}

/// The rule at the head of this file. Rejected candidates are chosen only where there is no other.
pub(super) fn choose(candidates: &[Candidate], limit: f64) -> usize {
    let heldout = |c: &Candidate| c.heldout_rms.unwrap_or(f64::INFINITY);
    let deviation = |c: &Candidate| {
        c.area_error.unwrap_or(f64::INFINITY).abs() + c.volume_error.unwrap_or(f64::INFINITY).abs()
    };
    let usable = candidates
        .iter()
        .enumerate()
        .filter(|(_, c)| c.rejected.is_none());
    let good = usable
        .clone()
        .filter(|(_, c)| heldout(c) <= limit)
        .min_by(|(_, a), (_, b)| {
            a.coefficients
                .cmp(&b.coefficients)
                .then(deviation(a).total_cmp(&deviation(b)))
        });
    let least =
        |a: &(usize, &Candidate), b: &(usize, &Candidate)| heldout(a.1).total_cmp(&heldout(b.1));
    good.or_else(|| usable.min_by(least))
        .or_else(|| candidates.iter().enumerate().min_by(least))
        .map_or(0, |(index, _)| index)
}
