//! Degrees that a cell can do without.
//!
//! In a joint least-squares fit with the inverse matrix Z, leaving out a cell's coefficients c above
//! some degree raises the squared error by c' Zcc^-1 c, with Zcc their part of Z: exact for one cell,
//! and nearly additive for several.

use super::inverse::BlockInverse;
use super::refine::{Refinement, Round, TWINS};
use crate::sphere::coefficient_count;
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Share of what is left of the tolerance that lower degrees may cost by this count. Neighbours that
/// lose a degree together cost up to three times as much.
const SHARE: f64 = 0.3;

/// The degrees of the cells once those steps have gone that cost the least error per coefficient, as
/// far as the tolerance allows.
pub(crate) fn prune(refinement: &Refinement<'_>, round: &Round<'_>) -> Vec<usize> {
    let mut degrees = round.system.degrees.clone();
    let mut left = -refinement.excess(round.variance) * refinement.samples.len() as f64 * SHARE;
    let mut steps: Vec<Step> = round
        .coefficients
        .iter()
        .enumerate()
        .flat_map(|(cell, own)| steps(cell, own, &round.inverse))
        .collect();
    steps.sort_by(|a, b| {
        a.cost_per_coefficient()
            .total_cmp(&b.cost_per_coefficient())
    });
    let neighbours = round.system.neighbours();
    let alike = |a: &Step, b: &Step| {
        b.cost_per_coefficient() <= (1.0 + TWINS) * a.cost_per_coefficient() && a.to == b.to
    };
    for twins in steps.chunk_by(alike) {
        let possible = |step: &&Step| degrees[step.cell] == step.to + 1;
        let possible: Vec<&Step> = twins.iter().filter(possible).collect();
        // Neighbours make up for each other: what one loses costs more once another has lost.
        let lowered = |cell: usize| {
            let neighbours = neighbours[cell].iter();
            neighbours
                .filter(|&&other| {
                    degrees[usize::from(other)] < round.system.degrees[usize::from(other)]
                })
                .count()
        };
        let cost: f64 = possible
            .iter()
            .map(|step| step.cost * (1 + lowered(step.cell)) as f64)
            .sum();
        if cost <= left {
            left -= cost;
            for step in possible {
                degrees[step.cell] = step.to;
            }
        }
    }
    degrees
}

/// A cell's degree lowered by one.
struct Step {
    cell: usize,
    to: usize,
    cost: f64,
}

impl Step {
    fn cost_per_coefficient(&self) -> f64 {
        self.cost / (2 * self.to + 3) as f64
    }
}

/// The steps from a cell's degree down to 0, each with what it adds to the squared error.
fn steps(cell: usize, own: &[f64], inverse: &BlockInverse) -> Vec<Step> {
    let block = inverse.diagonal(cell);
    let mut steps = Vec::new();
    let mut before = 0.0;
    for to in (0..own.len().isqrt() - 1).rev() {
        let from = coefficient_count(to);
        let size = own.len() - from;
        let Ok(part) = block.submatrix(from, from, size, size).llt(Side::Lower) else {
            break;
        };
        let c = Mat::from_fn(size, 1, |i, _| own[from + i]);
        let x = part.solve(&c);
        let cost: f64 = (0..size).map(|i| c[(i, 0)] * x[(i, 0)]).sum();
        steps.push(Step {
            cell,
            to,
            cost: cost - before,
        });
        before = cost;
    }
    steps
}
