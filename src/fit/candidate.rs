//! The candidates of a search, and what became of them.

use crate::sphere::coefficient_count;

/// One setting of the search and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Largest degree of the segments' expansions.
    pub degree: usize,
    /// Number of segments: 1 of one expansion, that of the cells, or k^2.
    pub segments: usize,
    /// Coefficients of all segments together.
    pub coefficients: usize,
    /// Segments fitted at a lower degree, because their samples do not support this one.
    pub reduced_segments: usize,
    /// Area against the reference surface: signed, relative. `None` if not fitted.
    pub area_error: Option<f64>,
    /// Volume against the reference surface: signed, relative. `None` if not fitted.
    pub volume_error: Option<f64>,
    /// Root mean square error of points that were left out one by one, in the scan's unit: along rays, of positions along normals.
    /// Of blended cells that were not chosen it is forecast from the estimate. `None` if not fitted.
    pub heldout_rms: Option<f64>,
    /// Root mean square difference of the radius from the estimate, over all directions, in the scan's unit.
    /// `None` of candidates that are fitted to the points themselves.
    pub estimate_rms: Option<f64>,
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

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// Every candidate: by segments and then by degree, or the rounds of a refinement.
    pub candidates: Vec<Candidate>,
    /// Index of the chosen one.
    pub chosen: usize,
    /// The error that was good enough, in the scan's unit: the RMS difference from the estimate, or the
    /// held-out RMS of candidates that are fitted to the points themselves.
    pub limit: f64,
    /// The error that was asked for, in the scan's unit. Where it is a share of the mean radius, this is told before the
    /// fit by the triangles between the points.
    pub tolerance: f64,
    /// Standard deviation of the points' noise, in the scan's unit. `None` where it was not estimated.
    pub noise: Option<f64>,
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

impl Candidate {
    /// A candidate of which nothing is known but its size.
    pub(crate) fn unfitted(degree: usize, segments: usize, coefficients: usize) -> Self {
        Self {
            degree,
            segments,
            coefficients,
            reduced_segments: 0,
            area_error: None,
            volume_error: None,
            heldout_rms: None,
            estimate_rms: None,
            rejected: None,
        }
    }

    /// A candidate of k x k segments that cannot win.
    pub(crate) fn skipped(degree: usize, k: usize) -> Self {
        Self {
            rejected: Some(Rejection::Skipped),
            ..Self::unfitted(degree, k * k, k * k * coefficient_count(degree))
        }
    }
}

impl Search {
    /// The chosen candidate.
    pub fn choice(&self) -> &Candidate {
        &self.candidates[self.chosen]
    }
}

/// The candidate with the fewest coefficients that is not rejected and whose held-out RMS is within the limit; of
/// several with the same count, the one that deviates least from the reference surface; where there is none,
/// the least held-out RMS. Rejected candidates are chosen only where there is no other.
pub(crate) fn choose(candidates: &[Candidate], limit: f64) -> usize {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A candidate with so many coefficients, this held-out RMS and these deviations of area and volume.
    fn candidate(coefficients: usize, rms: f64, [area, volume]: [f64; 2]) -> Candidate {
        Candidate {
            heldout_rms: Some(rms),
            area_error: Some(area),
            volume_error: Some(volume),
            ..Candidate::unfitted(2, 4, coefficients)
        }
    }

    #[test]
    fn the_fewest_coefficients_within_the_limit_win() {
        let candidates = [
            candidate(36, 0.1, [0.0; 2]),
            candidate(16, 0.5, [0.1; 2]),
            candidate(9, 0.6, [0.0; 2]),
        ];
        assert_eq!(choose(&candidates, 0.5), 1);
        assert_eq!(choose(&candidates, 0.6), 2);
    }

    #[test]
    fn of_as_many_coefficients_the_least_deviation_wins_whatever_its_sign() {
        let candidates = [
            candidate(16, 0.1, [-0.05, 0.0]),
            candidate(16, 0.4, [0.01, -0.02]),
            candidate(16, 0.2, [0.0, 0.04]),
        ];
        assert_eq!(choose(&candidates, 0.5), 1);
    }

    #[test]
    fn beyond_the_limit_the_least_error_wins_and_rejected_ones_only_where_all_are() {
        let tears = Some(Rejection::Tears { by: 0.2 });
        let mut candidates = [
            candidate(9, 0.1, [0.0; 2]),
            candidate(16, 0.8, [0.0; 2]),
            candidate(36, 0.7, [0.1; 2]),
        ];
        candidates[0].rejected = tears;
        assert_eq!(choose(&candidates, 0.5), 2);
        for candidate in &mut candidates {
            candidate.rejected = tears;
        }
        assert_eq!(choose(&candidates, 0.5), 0);
    }
}
