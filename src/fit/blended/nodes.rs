//! Where the target is sampled: a product of Gauss rules on every cell.

use super::Target;
use crate::sphere::{CubeCell, GaussLegendre};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Nodes per side of a cell are at least so many per face: a large cell of low degree is not judged by
/// few nodes.
const LEAST_PER_FACE: f64 = 20.0;

/// Nodes per side and degree plus one, beside one more: some six nodes per coefficient. With three, the
/// error between the nodes is up to three times the fitted.
const NODES_PER_DEGREE: f64 = 2.2;

/// The samples of a cell, row by row.
#[derive(Clone)]
pub(super) struct Samples {
    /// Nodes per side.
    pub(super) side: usize,
    pub(super) directions: Vec<Vector3<f64>>,
    /// Solid angle times the target's weight.
    pub(super) weights: Vec<f64>,
    pub(super) radii: Vec<f64>,
}

/// An even number of nodes per side, so that quarters of the cell have the same.
pub(super) fn nodes_per_side(cell: &CubeCell, degree: usize) -> usize {
    let for_degree = NODES_PER_DEGREE * (degree + 1) as f64 + 1.0;
    let for_size = LEAST_PER_FACE / f64::from(cell.parts);
    let side = for_degree.max(for_size).ceil() as usize;
    side.next_multiple_of(2)
}

/// The samples of all cells that have been part of a cover, by nodes per side.
#[derive(Default)]
pub(super) struct Sampler {
    known: HashMap<(CubeCell, usize), Samples>,
    rules: HashMap<usize, GaussLegendre>,
}

impl Sampler {
    /// Samples the target where it is not known yet, in one call.
    pub(super) fn sample(&mut self, target: &dyn Target, wanted: &[(CubeCell, usize)]) {
        let mut new: Vec<((CubeCell, usize), Samples)> = Vec::new();
        for &(cell, side) in wanted {
            if self.known.contains_key(&(cell, side)) {
                continue;
            }
            let rule = self
                .rules
                .entry(side)
                .or_insert_with(|| GaussLegendre::new(side));
            let (directions, solid_angles): (Vec<_>, Vec<_>) =
                cell.rectangle().nodes(rule).into_iter().unzip();
            let weights = solid_angles
                .iter()
                .zip(&directions)
                .map(|(solid_angle, n)| solid_angle * target.weight(n))
                .collect();
            let samples = Samples {
                side,
                directions,
                weights,
                radii: Vec::new(),
            };
            new.push(((cell, side), samples));
        }
        let all: Vec<Vector3<f64>> = new
            .iter()
            .flat_map(|(_, samples)| &samples.directions)
            .copied()
            .collect();
        if all.is_empty() {
            return;
        }
        let radii = target.radii(&all);
        let mut rest = radii.as_slice();
        for (key, mut samples) in new {
            let (own, others) = rest.split_at(samples.directions.len());
            samples.radii = own.to_vec();
            rest = others;
            self.known.insert(key, samples);
        }
    }

    /// The samples of a cell that has been sampled.
    pub(super) fn of(&self, cell: &CubeCell, side: usize) -> &Samples {
        &self.known[&(*cell, side)]
    }
}
