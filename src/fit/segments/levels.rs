//! Samples made ready for the levels of a search.

use super::reduce::{ReducedCell, reduce_cells};
use super::segment::Level;
use crate::fit::prepare::{CellGrid, PreparedScan, Samples};
use crate::sphere::{AngularPartition, CapBasis};
use nalgebra::Point3;
use std::collections::HashSet;

/// Samples per segment of the level that tells of the noise.
const SAMPLES_PER_NOISE_SEGMENT: usize = 32;

/// Parts per angle of the finest level that tells of the noise.
const FINEST_NOISE_LEVEL: usize = 10;

/// What all levels of a search share.
pub(crate) struct Levels {
    /// Parts per angle of the level that tells of the noise.
    pub(crate) noise_parts: usize,
    grid: CellGrid,
    samples: Samples,
    /// Of a large cloud, one sample per patch of directions.
    probes: Option<Samples>,
    reduced: Vec<Option<ReducedCell>>,
    bases: Vec<CapBasis>,
}

impl Levels {
    /// The levels with the given parts per angle, up to a degree, and the one that tells of the noise.
    pub(crate) fn new(prepared: &PreparedScan<'_>, parts: &[usize], top_degree: usize) -> Self {
        let noise_parts = noise_parts(prepared.points());
        let grid = CellGrid::new(parts.iter().copied().chain([noise_parts]));
        let samples = prepared.samples(&grid);
        let bases: Vec<CapBasis> = (0..=top_degree).map(CapBasis::new).collect();
        Self {
            noise_parts,
            probes: prepared.probes(&grid),
            reduced: reduce_cells(&samples, &grid, &bases[top_degree]),
            samples,
            grid,
            bases,
        }
    }

    /// Distinct points.
    pub(crate) fn points(&self) -> usize {
        self.samples.rows().len()
    }

    /// The level with `k` parts per angle, up to `degree`.
    pub(crate) fn level(&self, k: usize, degree: usize) -> Level<'_> {
        Level {
            partition: AngularPartition::new(k),
            basis: &self.bases[degree],
            grid: &self.grid,
            samples: &self.samples,
            probes: self.probes.as_ref().unwrap_or(&self.samples),
            reduced: &self.reduced,
        }
    }
}

/// Parts per angle of the level that tells of the noise; points that coincide count once.
fn noise_parts(points: &[Point3<f64>]) -> usize {
    let enough = SAMPLES_PER_NOISE_SEGMENT * FINEST_NOISE_LEVEL.pow(2);
    let mut distinct = HashSet::with_capacity(enough);
    for point in points {
        distinct.insert([point.x, point.y, point.z].map(|x| (x + 0.0).to_bits()));
        if distinct.len() >= enough {
            break;
        }
    }
    (distinct.len() / SAMPLES_PER_NOISE_SEGMENT)
        .isqrt()
        .clamp(1, FINEST_NOISE_LEVEL)
}
