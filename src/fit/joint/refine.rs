//! The refinement: cells are split, or their degree is raised, only where the samples ask for it.

use super::Cloud;
use super::inverse::BlockInverse;
use super::normal::{Normal, Prior};
use super::prior::Parent;
use super::system::{Coefficients, System};
use crate::fit::prepare::PreparedScan;
use crate::fit::samples::Sample;
use crate::fit::search::{Candidate, Rejection};
use crate::sphere::{CapBasis, Cover, CubeCell, MAX_FACE_PARTS, coefficient_count};

/// Degree of the cells at first, where a larger one is allowed: the source's.
const FIRST_DEGREE: usize = 3;

/// The parts of a cell with few samples may have a lower degree, down to this one.
const LEAST_DEGREE: usize = 1;

/// Samples per coefficient that the parts of a split cell must keep; what they leave open, the prior
/// and the overlap with other cells decide.
const SAMPLES_PER_COEFFICIENT: f64 = 0.9;

/// What is left of the squared error of a cell once it is refined. At degree 3, halving the width
/// divides the error by 8 to 16.
const LEFT_BY_A_SPLIT: f64 = 0.03;

/// Splitting a cell also lowers the error of its neighbours, with which it is blended, so the cells
/// marked are those that would bring the sum of squares to this many times what is allowed, or to
/// what is allowed where it is not above that.
const SPREAD: f64 = 2.5;

/// A degree is raised where its coefficients are below this share of those of the degree below:
/// (1 - 0.6) per degree and 2L + 3 coefficients outdo the 3 (L + 1)^2 coefficients of a split. Else,
/// at a crease, the cell is split.
const SMOOTH: f64 = 0.6;

/// A cell is refined, whatever its variance, where the mean residual in one of its patches is above
/// this many tolerances and this many standard errors: a beak or a crease is a small part of a cell.
const LARGEST_LOCAL_ERROR: [f64; 2] = [3.0, 3.5];

/// Patches along an edge of a cell.
const PATCHES: usize = 4;

/// A round must lower the held-out RMS by this share, or the refinement ends.
const WORTH_A_ROUND: f64 = 0.01;

/// Rounds at most; each can halve the cells or raise their degree.
const MOST_ROUNDS: usize = 24;

/// Floor of the share of a sample that is not spent on coefficients.
const LEAST_SPARE: f64 = 0.1;

/// Cells whose variances differ by less than this share are refined together: those of a symmetric
/// body differ by rounding only, which must not decide.
pub(super) const TWINS: f64 = 1e-6;

/// What a refinement is made from.
pub(crate) struct Refinement<'a> {
    pub(crate) samples: &'a [Sample],
    /// The bases up to the largest degree.
    pub(crate) bases: &'a [CapBasis],
    /// Error of the model, as RMS, that is good enough.
    pub(crate) tolerance: f64,
    /// Standard deviation of the samples' noise, as far as it is known.
    pub(crate) noise: f64,
    /// Cells at most.
    pub(crate) most_cells: usize,
}

/// A cover with its fit.
pub(crate) struct Round<'a> {
    pub(crate) system: System<'a>,
    pub(crate) normal: Normal,
    pub(crate) prior: Prior,
    pub(super) coefficients: Coefficients,
    pub(super) inverse: BlockInverse,
    /// Residuals of the samples.
    pub(super) residuals: Vec<f64>,
    /// Variance of the samples round the surface: of all, and per cell.
    pub(crate) variance: f64,
    variances: Vec<f64>,
    /// Cells in which the residuals of a patch are far from zero.
    misfits: Vec<bool>,
    /// Root mean square of the leave-one-out errors.
    heldout_rms: f64,
    rejected: Option<Rejection>,
}

impl Round<'_> {
    /// The problem that the round solved.
    pub(super) fn problem(&self) -> (&System<'_>, &Normal, &Prior) {
        (&self.system, &self.normal, &self.prior)
    }

    /// The round as a candidate, whose area and volume are not known yet.
    pub(crate) fn candidate(&self) -> Candidate {
        Candidate {
            heldout_rms: Some(self.heldout_rms),
            rejected: self.rejected,
            ..self.system.candidate()
        }
    }
}

impl<'a> Refinement<'a> {
    pub(super) fn new(prepared: &'a PreparedScan, cloud: &'a Cloud<'a>, noise: f64) -> Self {
        Self {
            samples: cloud.probes(),
            bases: prepared.bases(prepared.top_degree()),
            tolerance: prepared.tolerance,
            noise,
            most_cells: prepared.most_segments,
        }
    }

    fn top_degree(&self) -> usize {
        self.bases.len() - 1
    }

    /// Refines from one cell per face, of the given degree if one is asked for; gives every round,
    /// the last one being the best.
    pub(crate) fn run(
        &mut self,
        parent: &Parent,
        degree: Option<usize>,
        progress: &dyn Fn(usize),
    ) -> Vec<Round<'a>> {
        let mut cells = CubeCell::uniform(1);
        let degree = degree.unwrap_or(FIRST_DEGREE).min(self.top_degree());
        let mut degrees = vec![degree; cells.len()];
        let mut rounds: Vec<Round<'a>> = Vec::new();
        for number in 0..MOST_ROUNDS {
            progress(number);
            let round = self.round(parent, cells, degrees, rounds.last());
            let last = rounds
                .last()
                .map_or(f64::INFINITY, |round| round.heldout_rms);
            if round.heldout_rms > last {
                break;
            }
            // What the local fits took for noise may be what they could not follow.
            self.noise = self.noise.min(round.variance.sqrt());
            let worth_going_on = (round.heldout_rms > self.limit()
                || round.misfits.contains(&true))
                && round.heldout_rms < (1.0 - WORTH_A_ROUND) * last;
            let next = worth_going_on.then(|| self.next(&round)).flatten();
            rounds.push(round);
            match next {
                Some(next) => (cells, degrees) = next,
                None => break,
            }
        }
        rounds
    }

    /// Held-out RMS that is good enough.
    pub(super) fn limit(&self) -> f64 {
        self.tolerance.hypot(self.noise)
    }

    /// By what a variance of samples round the surface exceeds that of noise and tolerance.
    pub(crate) fn excess(&self, variance: f64) -> f64 {
        variance - self.noise.powi(2) - self.tolerance.powi(2)
    }

    /// The problem of a round with lower degrees.
    pub(super) fn lowered(
        &self,
        parent: &Parent,
        round: &Round<'a>,
        degrees: Vec<usize>,
    ) -> (System<'a>, Normal, Prior) {
        let normal = round.normal.lowered(&degrees);
        let system = round.system.lowered(degrees);
        let mut prior = parent.prior(&system, self.bases);
        prior.weights.clone_from(&round.prior.weights);
        (system, normal, prior)
    }

    /// The fit on some cells. The weights of the prior are first those that the last round learnt.
    pub(crate) fn round(
        &self,
        parent: &Parent,
        cells: Vec<CubeCell>,
        degrees: Vec<usize>,
        last: Option<&Round<'_>>,
    ) -> Round<'a> {
        let cover = Cover::new(cells).expect("faces, split in quarters, tile the sphere");
        let system = System::new(cover, self.bases, degrees, self.samples);
        let normal = system.normal();
        let mut prior = parent.prior(&system, self.bases);
        if let Some(last) = last {
            prior.weights.clone_from(&last.prior.weights);
        }
        let (coefficients, factor) = normal.clone().solve(&prior);
        let inverse = factor.inverse();
        let errors = system.errors(&coefficients, &inverse);
        let spare = system.cell_means(|sample| errors.spare[sample].max(LEAST_SPARE));
        let mut variances = system.cell_means(|sample| errors.residuals[sample].powi(2));
        for (variance, spare) in variances.iter_mut().zip(&spare) {
            *variance /= spare;
        }
        let count = self.samples.len() as f64;
        let sum: f64 = variances.iter().zip(&system.held).map(|(v, h)| v * h).sum();
        let variance = sum / count;
        let heldout_rms = errors.heldout_rms();
        let rejected = errors.rejection(self.samples);
        prior.learn(&coefficients, variance);
        let misfits = self.misfits(&system, &errors.residuals);
        Round {
            system,
            normal,
            prior,
            coefficients,
            inverse,
            variance,
            residuals: errors.residuals,
            variances,
            misfits,
            heldout_rms,
            rejected,
        }
    }

    /// The cells of the next round and their degrees: of those above the tolerance, the worst are
    /// refined, as many as it takes for all to come within it. `None` if none can be.
    fn next(&self, round: &Round<'_>) -> Option<(Vec<CubeCell>, Vec<usize>)> {
        let System {
            cover,
            degrees,
            held,
            ..
        } = &round.system;
        let cells = cover.cells();
        let mut worst_first: Vec<usize> = (0..cells.len()).collect();
        worst_first.sort_by(|&a, &b| round.variances[b].total_cmp(&round.variances[a]));
        let noise = self.noise.powi(2);
        let mut sum: f64 = (0..cells.len())
            .map(|cell| held[cell] * (round.variances[cell] - noise))
            .sum();
        let good_enough = self.samples.len() as f64 * self.tolerance.powi(2);
        let allowed = match sum > SPREAD * good_enough {
            true => SPREAD * good_enough,
            false => good_enough,
        };
        let mut count = cells.len();
        let mut parts: Vec<Vec<CubeCell>> = cells.iter().map(|&cell| vec![cell]).collect();
        let mut degrees = degrees.clone();
        let mut refined = false;
        let mut last_refined = f64::INFINITY;
        for cell in worst_first {
            let (variance, held) = (round.variances[cell], held[cell]);
            let is_twin = variance >= (1.0 - TWINS) * last_refined;
            // What the variance of so many samples may differ by chance.
            let chance = noise * (2.0 / held).sqrt();
            let is_enough = sum <= allowed && !is_twin;
            if !round.misfits[cell] && (is_enough || self.excess(variance) <= chance) {
                continue;
            }
            let supports =
                |degree, held| held >= SAMPLES_PER_COEFFICIENT * coefficient_count(degree) as f64;
            let degree = degrees[cell];
            if degree < self.top_degree()
                && supports(degree + 1, held)
                && self.is_smooth(round, cell)
            {
                degrees[cell] = degree + 1;
            } else if count + 3 <= self.most_cells
                && 2 * cells[cell].parts <= MAX_FACE_PARTS
                && let Some(lower) = (LEAST_DEGREE.min(degree)..=degree)
                    .rev()
                    .find(|&lower| supports(lower, held / 4.0))
            {
                parts[cell] = cells[cell].quarters().to_vec();
                degrees[cell] = lower;
                count += 3;
            } else {
                continue;
            }
            refined = true;
            last_refined = variance;
            sum -= held * (variance - noise) * (1.0 - LEFT_BY_A_SPLIT);
        }
        refined.then(|| {
            parts
                .into_iter()
                .zip(degrees)
                .flat_map(|(parts, degree)| parts.into_iter().map(move |part| (part, degree)))
                .unzip()
        })
    }

    /// The cells in which the mean residual of a patch is larger than tolerance and noise explain.
    fn misfits(&self, system: &System<'_>, residuals: &[f64]) -> Vec<bool> {
        let [tolerances, errors] = LARGEST_LOCAL_ERROR;
        let is_misfit = |patch: &Vec<u32>| {
            let count = patch.len() as f64;
            let sum: f64 = patch.iter().map(|&member| residuals[member as usize]).sum();
            let limit = (tolerances * self.tolerance).hypot(errors * self.noise / count.sqrt());
            !patch.is_empty() && (sum / count).abs() > limit
        };
        patches(system, self.samples)
            .iter()
            .map(|patches| patches.iter().any(is_misfit))
            .collect()
    }

    /// Whether the coefficients of a cell fall off with the degree.
    fn is_smooth(&self, round: &Round<'_>, cell: usize) -> bool {
        let size = |degree: usize| -> f64 {
            round.coefficients[cell][degree * degree..coefficient_count(degree)]
                .iter()
                .map(|c| c * c)
                .sum()
        };
        let degree = round.system.degrees[cell];
        degree == 0 || size(degree) <= SMOOTH * SMOOTH * size(degree - 1)
    }
}

/// The samples in each of the patches of each cell: a sample lies in the cell with the largest share.
pub(super) fn patches(system: &System<'_>, samples: &[Sample]) -> Vec<Vec<Vec<u32>>> {
    let cells = system.cover.cells();
    let mut patches = vec![vec![Vec::new(); PATCHES * PATCHES]; cells.len()];
    for ((number, &[x, y, z, _]), cell) in (0..).zip(samples).zip(system.nearest()) {
        let cell = usize::from(cell);
        patches[cell][cells[cell].patch(&[x, y, z], PATCHES)].push(number);
    }
    patches
}
