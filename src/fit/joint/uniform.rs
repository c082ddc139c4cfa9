//! Every degree asked for on one uniform cover.

use super::finish::finish;
use super::prior::Parent;
use super::refine::Refinement;
use super::{Cloud, Joined, least_error, root, within};
use crate::fit::options::Seams;
use crate::fit::prepare::PreparedScan;
use crate::fit::search::{Candidate, Found, FoundFit, Search, Work};
use crate::sphere::CubeCell;

/// Fits `parts` x `parts` cells per face of a cube, or the whole sphere where `parts` is 0.
pub(super) fn search(prepared: &PreparedScan, parts: usize) -> Found {
    let mut work = Work::default();
    let (candidates, chosen, fit) = if parts == 0 {
        let (level, candidates) = root(prepared, prepared.tolerance, &mut work);
        let chosen = within(&candidates, prepared.tolerance).unwrap_or(candidates.len() - 1);
        (candidates, chosen, FoundFit::Segments(level.segments))
    } else {
        let cells = CubeCell::uniform(parts as u16);
        let degrees = prepared.degrees.iter();
        let (mut fits, candidates): (Vec<Joined>, Vec<Candidate>) =
            degrees.map(|&degree| fit(prepared, &cells, degree)).unzip();
        work.candidates = fits.len();
        work.segments = fits.len() * cells.len();
        let chosen =
            within(&candidates, prepared.tolerance).unwrap_or_else(|| least_error(&candidates));
        (
            candidates,
            chosen,
            FoundFit::Joined(fits.swap_remove(chosen)),
        )
    };
    let search = Search {
        seams: Seams::Blended,
        candidates,
        chosen,
        limit: prepared.tolerance,
        noise: 0.0,
        outliers: 0,
        work,
    };
    Found { search, fit }
}

fn fit(prepared: &PreparedScan, cells: &[CubeCell], degree: usize) -> (Joined, Candidate) {
    let cloud = Cloud::of(prepared);
    let refinement = Refinement::new(prepared, &cloud, 0.0);
    let parent = Parent::new(refinement.bases, refinement.samples);
    let degrees = vec![degree; cells.len()];
    let round = refinement.round(&parent, cells.to_vec(), degrees, None);
    finish(prepared, &cloud, round.problem(), true)
}
