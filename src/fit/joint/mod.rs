//! One least-squares fit of overlapping expansions, blended by a partition of unity, and the search
//! for the cells and degrees that it needs.
//!
//! **Rule.** The whole sphere is the root: if an expansion of it, up to the largest degree, is within
//! the limit, that of the lowest such degree is taken. Else it is cut in the six faces of a cube, and
//! cells are split (or their degree raised) where the samples scatter more than noise and tolerance
//! allow, until none does or the error no longer falls. Degrees that cost next to nothing are then
//! lowered again. The limit of a held-out RMS e is e^2 <= tolerance^2 + noise^2.
//!
//! **Outliers.** Samples that stand apart from the refined surface and from the others near by are left
//! out, and the refinement is done again.
//!
//! **Held-out error.** Every sample is predicted from all others (leave-one-out, in closed form).
//!
//! **Noise** is the standard deviation of the samples round independent local fits with some 32
//! samples each.

mod adaptive;
mod errors;
mod finish;
mod groups;
mod inverse;
mod normal;
mod outliers;
mod prior;
mod prune;
mod refine;
mod sparse;
mod system;
mod uniform;

pub(crate) use sparse::{BlockFactor, BlockMatrix};
pub(crate) use system::Coefficients;

use super::Residuals;
use super::level::FittedLevel;
use super::prepare::PreparedScan;
use super::samples::Sample;
use super::search::{Candidate, Found, Work};
use super::spread::Spread;
use crate::sphere::Cover;
use std::borrow::Cow;

/// A jointly fitted surface.
pub(crate) struct Joined {
    pub(crate) cover: Cover,
    pub(crate) coefficients: Coefficients,
    pub(crate) residuals: Residuals,
    pub(crate) spread: Spread,
}

/// The samples that a joint fit rests on.
struct Cloud<'a> {
    samples: Cow<'a, [Sample]>,
    /// Of a large cloud, one sample per patch of directions: they decide how cells are refined.
    thinned: Option<&'a [Sample]>,
}

impl<'a> Cloud<'a> {
    fn of(prepared: &'a PreparedScan) -> Self {
        Self {
            samples: Cow::Borrowed(prepared.samples().rows()),
            thinned: prepared.thinned().map(|samples| samples.rows()),
        }
    }

    /// The samples that decide how cells are refined, and that are predicted from all others.
    fn probes(&self) -> &[Sample] {
        self.thinned.unwrap_or(&self.samples)
    }
}

/// Searches the prepared scan; tells `progress` how many rounds are done.
pub(crate) fn search(prepared: &PreparedScan, progress: &dyn Fn(usize)) -> Found {
    match prepared.parts.first() {
        Some(&parts) => uniform::search(prepared, parts),
        None => adaptive::search(prepared, progress),
    }
}

/// The expansions of the whole sphere, as candidates: at all degrees, or up to a step of the degrees at
/// which one is within the limit.
fn root(prepared: &PreparedScan, limit: f64, work: &mut Work) -> (FittedLevel, Vec<Candidate>) {
    let top = prepared.top_degree();
    let mut up_to = |step: usize| {
        let level = FittedLevel::new(&prepared.level(1, step));
        let degrees = prepared.degrees.iter().filter(|&&degree| degree <= step);
        let candidates: Vec<Candidate> = degrees
            .map(|&degree| level.candidate(degree, &prepared.reference))
            .collect();
        work.segments += 1;
        work.candidates += candidates.len();
        (level, candidates)
    };
    let is_step = |&step: &usize| {
        step < top && !prepared.exhaustive && prepared.degrees.first() < Some(&step)
    };
    for step in ROOT_DEGREES.into_iter().filter(is_step) {
        let (level, candidates) = up_to(step);
        if within(&candidates, limit).is_some() {
            return (level, candidates);
        }
    }
    up_to(top)
}

/// Degrees up to which one expansion is fitted at first: each costs half as much as the next.
pub(crate) const ROOT_DEGREES: [usize; 5] = [4, 6, 9, 12, 16];

/// The first candidate that is good enough.
fn within(candidates: &[Candidate], limit: f64) -> Option<usize> {
    candidates
        .iter()
        .position(|c| c.rejected.is_none() && c.heldout_rms.is_some_and(|rms| rms <= limit))
}

/// The candidate with the least held-out error.
fn least_error(candidates: &[Candidate]) -> usize {
    let error = |at: &usize| candidates[*at].heldout_rms.unwrap_or(f64::INFINITY);
    (0..candidates.len())
        .min_by(|a, b| error(a).total_cmp(&error(b)))
        .unwrap_or(0)
}
