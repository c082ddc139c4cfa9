//! What is known of a cell before its samples are looked at: that it resembles its parent, an
//! expansion of the whole sphere.
//!
//! Coefficients of degree d differ from the parent's by a random amount of variance t_d, the same for
//! all cells, and samples from the surface by one of variance s. The most probable surface then
//! minimises, in units of s, the squared residuals plus (s / t_d) (c - parent)^2. Both variances are
//! estimated from a first fit (empirical Bayes). Where samples are plenty the prior moves nothing that
//! could be measured; where they are few or missing, a cell shrinks to its parent.

use super::normal::Prior;
use super::system::{Coefficients, System};
use crate::fit::factor::{Factorization, Triangle};
use crate::fit::samples::Sample;
use crate::sphere::{Cap, CapBasis, Places, coefficient_count, cube_grid};
use faer::linalg::solvers::SolveLstsq;
use faer::{Mat, MatRef};

/// Weight of the prior per coefficient in the first fit, in samples: far below what any well sampled
/// cell gives, far above rounding.
const FIRST_WEIGHT: f64 = 1e-3;

/// Weights are larger by 1 + this times the square of the coefficients per sample of a cell: nothing
/// that counts with four samples per coefficient, a firm hand with one sample for four.
const STARVED: f64 = 10.0;

/// ... but at most by this: a cell without samples is its parent.
const LARGEST_FACTOR: f64 = 1e6;

/// Largest degree of the parent: enough to bridge a hole by, too low to overshoot in one.
const LARGEST_DEGREE: usize = 4;

/// The parent's variance, in any direction, is at most that of one sample: over a wide gap a high
/// degree would swing.
const LARGEST_LEVERAGE: f64 = 1.0;

/// Directions along a cube's edge in which the parent's variance is looked at.
const PLACES_PER_EDGE: usize = 6;

/// Weights are kept within these bounds: the lower one bounds the condition of a cell without
/// samples, the upper one is that of a dense cell.
const WEIGHTS: [f64; 2] = [1e-4, 1e3];

/// The expansion of the whole sphere.
pub(crate) struct Parent {
    cap: Cap,
    basis: CapBasis,
    coefficients: Vec<f64>,
}

impl Parent {
    /// The fit of the whole sphere at the largest degree that is a parent's and that the samples
    /// determine.
    pub(crate) fn new(bases: &[CapBasis], samples: &[Sample]) -> Self {
        let basis = &bases[(bases.len() - 1).min(LARGEST_DEGREE)];
        let cap = Cap::new(0.0, 0.0, 2.0);
        let mut factorization = Factorization::new(basis.degree());
        factorization.add_samples(basis, &cap, samples);
        let triangle = factorization.triangle();
        let degree = firm_degree(&triangle, basis, &cap);
        Self {
            cap,
            basis: basis.clone(),
            coefficients: triangle.solve(degree),
        }
    }

    /// The parent as the prior of the cells of a cover.
    pub(crate) fn prior(&self, system: &System<'_>, bases: &[CapBasis]) -> Prior {
        let cells = system.degrees.iter().zip(&system.held);
        let mean = cells.clone().enumerate();
        let mean =
            mean.map(|(cell, (&degree, _))| self.within(system.cover.cap(cell), &bases[degree]));
        let factors = cells.map(|(&degree, held)| {
            let coefficients_per_sample = coefficient_count(degree) as f64 / held;
            (1.0 + STARVED * coefficients_per_sample.powi(2)).min(LARGEST_FACTOR)
        });
        Prior {
            mean: mean.collect(),
            weights: vec![FIRST_WEIGHT; bases.len()],
            factors: factors.collect(),
        }
    }

    /// Its coefficients on a smaller cap: exact for its own degree and above, the least-squares
    /// approximation below.
    fn within(&self, cap: &Cap, basis: &CapBasis) -> Vec<f64> {
        let degree = basis.degree();
        let nodes = spiral(cap, 2 * (degree.max(self.basis.degree()) + 2).pow(2));
        let mut places = Places::default();
        self.cap.locate(&nodes, &mut places);
        let mut radius = vec![0.0; nodes.len()];
        self.basis.values(&self.coefficients, &places, &mut radius);
        cap.locate(&nodes, &mut places);
        let count = coefficient_count(degree);
        let mut values = vec![0.0; count * nodes.len()];
        basis.evaluate(&places, &mut values, nodes.len());
        let functions = MatRef::from_column_major_slice(&values, nodes.len(), count);
        let solution = functions
            .qr()
            .solve_lstsq(Mat::from_fn(nodes.len(), 1, |i, _| radius[i]));
        (0..count).map(|j| solution[(j, 0)]).collect()
    }
}

/// The largest degree that the samples determine well in every direction.
fn firm_degree(triangle: &Triangle<'_>, basis: &CapBasis, cap: &Cap) -> usize {
    let Some(top) = triangle.full_rank_degree() else {
        return 0;
    };
    let (directions, _) = cube_grid(PLACES_PER_EDGE);
    let nodes: Vec<Sample> = directions.iter().map(|n| [n.x, n.y, n.z, 0.0]).collect();
    let mut places = Places::default();
    cap.locate(&nodes, &mut places);
    let rows = nodes.len();
    let mut values = vec![0.0; coefficient_count(basis.degree()) * rows];
    basis.evaluate(&places, &mut values, rows);
    triangle.whiten(&mut values, rows, coefficient_count(top));
    let is_firm = |degree: &usize| {
        (0..rows).all(|row| {
            let column = |j: usize| values[j * rows + row].powi(2);
            (0..coefficient_count(*degree)).map(column).sum::<f64>() <= LARGEST_LEVERAGE
        })
    };
    (1..=top).rev().find(is_firm).unwrap_or(0)
}

impl Prior {
    /// Sets the weights by what a first fit found: how far its coefficients are from the parent's, and
    /// the variance of the samples round it.
    pub(crate) fn learn(&mut self, coefficients: &Coefficients, variance: f64) {
        for (degree, weight) in self.weights.iter_mut().enumerate() {
            let (mut squared, mut count) = (0.0, 0);
            for (own, mean) in coefficients.iter().zip(&self.mean) {
                for j in degree * degree..coefficient_count(degree).min(own.len()) {
                    squared += (own[j] - mean[j]).powi(2);
                    count += 1;
                }
            }
            let ratio = variance * f64::from(count) / squared;
            if ratio.is_finite() {
                *weight = ratio.clamp(WEIGHTS[0], WEIGHTS[1]);
            }
        }
    }
}

/// Directions spread evenly over a cap.
fn spiral(cap: &Cap, count: usize) -> Vec<Sample> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let height = cap.height * (i as f64 + 0.5) / count as f64;
            let across = (height * (2.0 - height)).sqrt();
            let (s, c) = (golden_angle * i as f64).sin_cos();
            let [e1, e2] = cap.tangents;
            let n = cap.centre * (1.0 - height) + (e1 * c + e2 * s) * across;
            [n.x, n.y, n.z, 0.0]
        })
        .collect()
}
