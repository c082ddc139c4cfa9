//! The search that splits cells where the samples ask for it.

use super::finish::finish;
use super::outliers::outliers;
use super::prior::Parent;
use super::prune::prune;
use super::refine::{Refinement, Round};
use super::system::System;
use super::{Cloud, Joined, least_error, root, within};
use crate::fit::level::FittedLevel;
use crate::fit::options::Seams;
use crate::fit::prepare::PreparedScan;
use crate::fit::search::{Candidate, Found, FoundFit, Search, Work};
use crate::sphere::coefficient_count;
use std::borrow::Cow;

/// Degree of the local fits that tell of the noise.
const NOISE_DEGREE: usize = 3;

/// The rule at the head of [`super`].
pub(super) fn search(prepared: &PreparedScan, progress: &dyn Fn(usize)) -> Found {
    let mut work = Work::default();
    work.segments += prepared.noise_parts.pow(2);
    let degree = prepared.top_degree().min(NOISE_DEGREE);
    let mut noise = FittedLevel::new(&prepared.level(prepared.noise_parts, degree))
        .residual_variance()
        .sqrt();
    let mut limit = prepared.tolerance.hypot(noise);
    let (level, mut candidates) = root(prepared, limit, &mut work);
    let mut enough = within(&candidates, limit);
    let degrees = candidates.len();
    let mut outliers = 0;
    // One cell per face will not do with fewer coefficients than this.
    let least = 6 * coefficient_count(1);
    let refined = match enough {
        Some(root) if candidates[root].coefficients <= least => None,
        _ if prepared.most_segments < 6 => None,
        _ => {
            let cloud = Cloud::of(prepared);
            let refined = refine(prepared, &cloud, noise, progress, &mut work);
            Some(match &refined.cleaned {
                None => refined,
                Some(cleaned) => {
                    outliers = cloud.samples.len() - cleaned.samples.len();
                    refine(prepared, cleaned, noise, progress, &mut work)
                }
            })
        }
    };
    let mut chosen = enough.unwrap_or_else(|| least_error(&candidates));
    let mut fit = FoundFit::Segments(level.segments);
    if let Some(refined) = refined {
        noise = refined.noise;
        limit = prepared.tolerance.hypot(noise);
        enough = within(&candidates, limit);
        candidates.extend(refined.candidates);
        let last = candidates.len() - 1;
        let root = enough.or_else(|| best_root(&candidates[..degrees], &candidates[last]));
        let is_better = |root: usize| {
            candidates[root].coefficients <= candidates[last].coefficients
                || candidates[last].heldout_rms > Some(limit)
        };
        match root.filter(|&root| enough.is_none() || is_better(root)) {
            Some(root) => {
                chosen = root;
                outliers = 0;
            }
            None => {
                chosen = last;
                fit = FoundFit::Joined(refined.joined);
            }
        }
    }
    let search = Search {
        seams: Seams::Blended,
        candidates,
        chosen,
        limit,
        noise,
        outliers,
        work,
    };
    Found { search, fit }
}

/// Where the refined surface is rejected, the whole sphere that predicts the samples better, if one
/// does.
fn best_root(roots: &[Candidate], refined: &Candidate) -> Option<usize> {
    refined.rejected?;
    let root = least_error(roots);
    (roots.get(root)?.heldout_rms < refined.heldout_rms).then_some(root)
}

/// What a refinement comes to.
struct Refined<'a> {
    /// The rounds, the last of which is that of `joined`.
    candidates: Vec<Candidate>,
    joined: Joined,
    /// Standard deviation of the samples' noise, as far as the rounds have told.
    noise: f64,
    /// The cloud without outliers, if there are any.
    cleaned: Option<Cloud<'a>>,
}

fn refine<'a>(
    prepared: &'a PreparedScan,
    cloud: &Cloud<'a>,
    noise: f64,
    progress: &dyn Fn(usize),
    work: &mut Work,
) -> Refined<'a> {
    let mut refinement = Refinement::new(prepared, cloud, noise);
    let parent = Parent::new(refinement.bases, refinement.samples);
    let rounds = refinement.run(&parent, prepared.degree, progress);
    let mut count = |system: &System<'_>| {
        work.candidates += 1;
        work.segments += system.degrees.len();
    };
    rounds.iter().for_each(|round| count(&round.system));
    let noise = refinement.noise;
    let (last, before) = rounds.split_last().expect("there is a first round");
    let degrees = prune(&refinement, last);
    let pruned = (degrees != last.system.degrees).then(|| {
        let (system, normal, prior) = refinement.lowered(&parent, last, degrees);
        count(&system);
        finish(
            prepared,
            cloud,
            (&system, &normal, &prior),
            prepared.exhaustive,
        )
    });
    let pruned = pruned.filter(|(fewer, _)| refinement.excess(fewer.spread.variance) <= 0.0);
    let measured =
        |round: &Round<'_>| finish(prepared, cloud, round.problem(), prepared.exhaustive);
    let told = |round: &Round<'_>| match prepared.exhaustive {
        true => measured(round).1,
        false => round.candidate(),
    };
    let mut candidates: Vec<Candidate> = before.iter().map(told).collect();
    let (joined, candidate) = match pruned {
        Some(pruned) => {
            candidates.push(told(last));
            pruned
        }
        None => measured(last),
    };
    candidates.push(candidate);
    // Of large clouds, the thinned samples are free of outliers, and all others outvote them.
    let outliers = match cloud.thinned {
        None => outliers(last, &cloud.samples, noise, prepared.mean_radius),
        Some(_) => Vec::new(),
    };
    let cleaned = (!outliers.is_empty()).then(|| Cloud {
        samples: Cow::Owned(without(&cloud.samples, &outliers)),
        thinned: None,
    });
    Refined {
        candidates,
        joined,
        noise,
        cleaned,
    }
}

/// All but the samples at the given sorted positions.
fn without<T: Copy>(samples: &[T], left_out: &[usize]) -> Vec<T> {
    let mut left_out = left_out.iter().peekable();
    let kept = samples.iter().enumerate();
    kept.filter(|(at, _)| left_out.next_if_eq(&at).is_none())
        .map(|(_, sample)| *sample)
        .collect()
}
