//! The rounds: forecast, joint fit, better forecast.

use super::between_nodes::BetweenNodes;
use super::forest::{Bounds, Forest, Plan};
use super::joint::{Joint, Solved};
use super::local_fit::LocalFits;
use super::nodes::{Sampler, nodes_per_side};
use super::{Blend, Outcome, Round, Settings, Target};
use crate::fit::MAX_COEFFICIENTS;
use crate::model::Blended;
use crate::sphere::{CapBasis, Cover, CubeCell, MAX_FACE_PARTS, coefficient_count};
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Degree of covers whose cells are all alike. They fit together better than their cells' own fits
/// tell, so they are candidates of their own: of the bean, 18 cells of degree 3 meet .1 % of the mean
/// radius, for which the cells chosen one by one need 414 coefficients instead of 288.
const EVEN_DEGREE: usize = 3;

/// A surface this far within the limit has coefficients to spare.
const WIDE_OF_THE_LIMIT: f64 = 0.7;

/// Most joint fits of covers that are forecast.
const MOST_ROUNDS: usize = 8;

/// Squared error of the joint fit per sum of the squared errors of the cells' own fits, before a fit has
/// told: .1 to .35 on smooth grains ...
const FIRST_RATIO: f64 = 0.25;

/// ... and .34 to .63 on texture.
const FIRST_RATIO_OF_TEXTURE: f64 = 0.45;

/// Covers of other trees may come to this share of the least ratio told so far: 0.89 and more on stones and kernels.
const LEAST_OF_RATIO: f64 = 0.85;

/// Squared error between the directions of a fit per squared error at them, before it is known.
const FIRST_BETWEEN: f64 = 1.05;

/// Forecasts aim at this share of the squared error that is good enough: .975 of the RMS.
const AIM: f64 = 0.95;

/// A round more must save this share of the coefficients.
const LEAST_SAVING: f64 = 0.03;

/// Where a cover is cut by its own errors, cells with less than this share of the largest of them stay whole.
const LEAST_CUT: f64 = 1.0 / 16.0;

/// Quadtrees grow from the cells of faces cut in so many parts: other numbers are these times powers of
/// two, or cost more than 2916 coefficients from the start.
const ROOTS: [u16; 5] = [1, 3, 5, 7, 9];

/// The search for a surface.
pub(super) struct Search<'a> {
    target: &'a dyn Target,
    settings: &'a Settings,
    blend: Blend,
    degrees: RangeInclusive<usize>,
    bases: Vec<CapBasis>,
    fits: LocalFits,
    sampler: Sampler,
    trees: Vec<Tree>,
    rounds: Vec<Round>,
    best: Option<Found>,
    /// Squared error between the directions of a fit per squared error at them.
    between: f64,
    /// The least squared error of a joint fit per sum of its cells' own that a fit has told.
    least_ratio: f64,
}

/// A quadtree and what is known of its covers.
struct Tree {
    forest: Forest,
    /// The cheapest cover that is forecast to be good enough.
    plan: Plan,
    fitted: Vec<Plan>,
}

/// A fitted surface.
struct Found {
    surface: Blended,
    coefficients: usize,
    /// Which of the rounds.
    round: usize,
    between: BetweenNodes,
}

impl<'a> Search<'a> {
    pub(super) fn new(target: &'a dyn Target, settings: &'a Settings, blend: Blend) -> Self {
        let degrees = match settings.degree {
            Some(degree) => degree..=degree,
            None => settings.max_degree.min(1)..=settings.max_degree,
        };
        let most = *degrees.end();
        Self {
            target,
            settings,
            blend,
            degrees,
            bases: (0..=most).map(CapBasis::new).collect(),
            fits: LocalFits::new(most),
            sampler: Sampler::default(),
            trees: Vec::new(),
            rounds: Vec::new(),
            best: None,
            between: FIRST_BETWEEN,
            least_ratio: f64::INFINITY,
        }
    }

    /// Fits the cheapest cover forecast, and those that are cheaper still once the forecast is better.
    pub(super) fn run(mut self) -> Option<Outcome> {
        self.plant();
        while self.rounds.len() < MOST_ROUNDS {
            let Some(next) = self.cheapest() else { break };
            self.fit(next)?;
        }
        if self.settings.segments.is_none() {
            self.refine()?;
            self.try_uniform()?;
        }
        let Found {
            surface,
            round,
            between,
            ..
        } = self.best?;
        Some(Outcome {
            max: between.largest(&surface, self.target),
            surface,
            rounds: self.rounds,
            chosen: round,
            rms: between.rms,
            met: between.rms <= self.settings.limit,
        })
    }

    /// The integral of the squared error that is good enough.
    fn goal(&self) -> f64 {
        4.0 * PI * self.settings.limit.max(0.0).powi(2)
    }

    fn bounds(&self) -> Bounds {
        Bounds {
            cells: self.settings.max_segments,
            coefficients: MAX_COEFFICIENTS,
        }
    }

    /// The degree of covers whose cells are all alike.
    fn even_degree(&self) -> usize {
        EVEN_DEGREE.clamp(*self.degrees.start(), *self.degrees.end())
    }

    /// Grows the quadtrees that may have the cheapest cover.
    fn plant(&mut self) {
        if let Some(segments) = self.settings.segments {
            let parts = (segments / 6).isqrt() as u16;
            self.add_tree(parts.clamp(1, MAX_FACE_PARTS), true, self.degrees.clone());
            return;
        }
        for parts in ROOTS {
            let cells = 6 * usize::from(parts).pow(2);
            let least = cells * coefficient_count(*self.degrees.start());
            let so_far = self.trees.iter().map(|tree| tree.plan.coefficients).min();
            let bounds = self.bounds();
            let is_within = cells <= bounds.cells && least <= bounds.coefficients;
            if so_far.is_none_or(|cost| is_within && least < cost) {
                self.add_tree(parts, false, self.degrees.clone());
            }
        }
        let even = self.even_degree();
        if self.degrees != (even..=even) {
            self.add_tree(1, false, even..=even);
        }
    }

    fn add_tree(&mut self, parts: u16, is_fixed: bool, degrees: RangeInclusive<usize>) {
        let mut forest = Forest::new(self.target, &mut self.fits, parts, is_fixed, degrees);
        let ratio = match self.settings.is_textured {
            true => FIRST_RATIO_OF_TEXTURE,
            false => FIRST_RATIO,
        };
        let (goal, bounds) = (AIM * self.goal() / ratio, self.bounds());
        let plan = forest.within(self.target, &mut self.fits, goal, &bounds);
        self.trees.push(Tree {
            forest,
            plan,
            fitted: Vec::new(),
        });
    }

    /// The tree with the cheapest cover that is worth a fit. Covers that the bounds keep from being good
    /// enough come last, the nearest first, and none that cannot win.
    fn cheapest(&self) -> Option<usize> {
        let met = self
            .best
            .as_ref()
            .filter(|found| self.is_met(found.between.rms));
        let most = met.map(|found| (1.0 - LEAST_SAVING) * found.coefficients as f64);
        let open = self.trees.iter().enumerate().filter(|(_, tree)| {
            let is_new = !tree.fitted.contains(&tree.plan);
            let is_cheap = most.is_none_or(|most| (tree.plan.coefficients as f64) < most);
            is_new && is_cheap && (tree.plan.is_enough || self.may_win(&tree.plan))
        });
        let rank = |tree: &Tree| match tree.plan.is_enough {
            true => (0, tree.plan.coefficients as f64),
            false => (1, tree.plan.error),
        };
        open.min_by(|(_, one), (_, other)| {
            let [(late, own), (later, others)] = [one, other].map(|tree| rank(tree));
            late.cmp(&later).then(own.total_cmp(&others))
        })
        .map(|(at, _)| at)
    }

    /// Whether a cover that is not forecast to be good enough may come nearer than the best so far.
    fn may_win(&self, plan: &Plan) -> bool {
        self.best.as_ref().is_none_or(|best| {
            let least = LEAST_OF_RATIO * self.least_ratio * plan.error;
            !self.is_met(best.between.rms) && least < 4.0 * PI * best.between.rms * best.between.rms
        })
    }

    fn is_met(&self, rms: f64) -> bool {
        rms <= self.settings.limit
    }

    /// Fits the plan of a tree, and makes its next one. What a first fit tells of cells goes for those of the other trees
    /// too.
    fn fit(&mut self, at: usize) -> Option<()> {
        let plan = self.trees[at].plan.clone();
        let rms = self.solve(&plan.cells, &plan.degrees)?;
        let (goal, bounds) = (self.goal(), self.bounds());
        let error = plan.error;
        self.trees[at].fitted.push(plan);
        if error > 0.0 {
            let ratio = 4.0 * PI * rms * rms / error;
            self.least_ratio = self.least_ratio.min(ratio);
            let degrees = self.trees[at].forest.degrees();
            for (other, tree) in self.trees.iter_mut().enumerate() {
                let is_alike = tree.fitted.is_empty() && tree.forest.degrees() == degrees;
                if other == at || is_alike {
                    tree.plan = tree.forest.within(
                        self.target,
                        &mut self.fits,
                        AIM * goal / ratio,
                        &bounds,
                    );
                }
            }
        }
        Some(())
    }

    /// Where no forecast was good enough, cuts the cells that err most in four, as long as that helps: along an edge of a
    /// body that lies between cells, the blend errs as neither cell's own fit shows.
    fn refine(&mut self) -> Option<()> {
        while let Some((cells, degrees)) = self.finer() {
            let before = self.best.as_ref().map(|best| best.between.rms);
            self.solve(&cells, &degrees)?;
            if self.best.as_ref().map(|best| best.between.rms) == before {
                break;
            }
        }
        Some(())
    }

    /// The best cover with the cells that err most cut in four. `None` if it is good enough, or that would exceed the
    /// bounds.
    fn finer(&self) -> Option<(Vec<CubeCell>, Vec<usize>)> {
        let best = self
            .best
            .as_ref()
            .filter(|best| !self.is_met(best.between.rms))?;
        let largest = best.between.squares.iter().copied().fold(0.0, f64::max);
        let fair = self.goal() / best.between.squares.len() as f64;
        let most = fair.max(LEAST_CUT * largest);
        let coefficients = best.surface.coefficients().iter().map(Vec::len);
        let cover = best.surface.cover().cells().iter();
        let (mut cells, mut degrees) = (Vec::new(), Vec::new());
        for ((cell, size), square) in cover.zip(coefficients).zip(&best.between.squares) {
            let before = cells.len();
            match *square > most && 2 * cell.parts <= MAX_FACE_PARTS {
                true => cells.extend(cell.quarters()),
                false => cells.push(*cell),
            }
            degrees.resize(degrees.len() + cells.len() - before, size.isqrt() - 1);
        }
        let bounds = self.bounds();
        let sizes = degrees.iter().map(|&degree| coefficient_count(degree));
        let is_within = cells.len() <= bounds.cells && sizes.sum::<usize>() <= bounds.coefficients;
        (is_within && cells.len() > best.between.squares.len()).then_some((cells, degrees))
    }

    /// Fits cells of one size and degree, and fewer of them as long as they do.
    fn try_uniform(&mut self) -> Option<()> {
        let degree = self.even_degree();
        let worth = match self.settings.degree {
            Some(_) => self.settings.limit,
            None => WIDE_OF_THE_LIMIT * self.settings.limit,
        };
        while let Some(best) = self
            .best
            .as_ref()
            .filter(|found| found.between.rms <= worth)
        {
            let saving = (1.0 - LEAST_SAVING) * best.coefficients as f64;
            let most = (saving as usize / coefficient_count(degree)).min(self.bounds().cells);
            let parts = (most / 6).isqrt().min(MAX_FACE_PARTS.into());
            if parts == 0 {
                break;
            }
            let cells = CubeCell::uniform(parts as u16);
            let degrees = vec![degree; cells.len()];
            let rms = self.solve(&cells, &degrees)?;
            if !self.is_met(rms) {
                break;
            }
        }
        Some(())
    }

    /// Fits a cover, keeps the surface if it is the best so far, and gives its error.
    fn solve(&mut self, cells: &[CubeCell], degrees: &[usize]) -> Option<f64> {
        let sides: Vec<(CubeCell, usize)> = cells
            .iter()
            .zip(degrees)
            .map(|(cell, &degree)| (*cell, nodes_per_side(cell, degree)))
            .collect();
        self.sampler.sample(self.target, &sides);
        let samples: Vec<_> = sides
            .iter()
            .map(|(cell, side)| self.sampler.of(cell, *side))
            .collect();
        let cover = Cover::with_margin(cells.to_vec(), self.blend.margin).ok()?;
        let joint = Joint::new(&cover, degrees, &self.bases, &samples, self.blend.own);
        let Solved {
            coefficients,
            squared,
        } = joint.solve()?;
        let count = coefficients.iter().map(Vec::len).sum();
        let seen = (squared / (4.0 * PI)).sqrt();
        let surface = Blended::new(cover, coefficients).ok()?;
        let mut rms = seen * self.between.sqrt();
        let is_first = self.best.is_none();
        let mut between = None;
        if is_first || self.is_met(seen) || self.is_better(count, rms) {
            let found = BetweenNodes::of(&surface, self.target, &mut self.sampler, &sides);
            rms = found.rms;
            if seen > 0.0 && (is_first || self.is_met(seen)) {
                self.between = (rms / seen).powi(2).clamp(1.0, 4.0);
            }
            between = Some(found);
        }
        let round = self.rounds.len();
        self.rounds.push(Round {
            cells: cells.len(),
            degree: degrees.iter().copied().max().unwrap_or(0),
            coefficients: count,
            rms,
        });
        if let Some(between) = between.filter(|between| self.is_better(count, between.rms)) {
            self.best = Some(Found {
                surface,
                coefficients: count,
                round,
                between,
            });
        }
        Some(rms)
    }

    /// Whether a surface of so many coefficients and such an error is better than the best so far.
    fn is_better(&self, coefficients: usize, rms: f64) -> bool {
        self.best.as_ref().is_none_or(|best| {
            match (self.is_met(best.between.rms), self.is_met(rms)) {
                (true, true) => coefficients < best.coefficients,
                (met, is_met) => is_met || (!met && rms < best.between.rms),
            }
        })
    }
}
