//! Samples grouped by the cells that they touch.

use crate::fit::samples::Sample;
use crate::sphere::Cover;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Samples that touch some of the same few cells.
#[derive(Clone)]
pub(crate) struct Group {
    /// The cells, ascending.
    pub(crate) cells: Vec<u16>,
    /// The samples' numbers.
    pub(crate) members: Vec<u32>,
    /// Share of each cell in the surface at each sample: one column per cell.
    pub(crate) shares: Vec<f64>,
}

impl Group {
    /// The shares of the cell at position `at` of `cells`.
    pub(crate) fn shares(&self, at: usize) -> &[f64] {
        &self.shares[at * self.members.len()..(at + 1) * self.members.len()]
    }
}

/// Samples handled by one task.
const CHUNK: usize = 1 << 12;

/// Groups the samples, in an order that depends on the samples alone.
pub(crate) fn group(cover: &Cover, samples: &[Sample]) -> Vec<Group> {
    let chunks: Vec<Vec<Part>> = samples
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(number, chunk)| parts(cover, chunk, number * CHUNK))
        .collect();
    let mut numbers: HashMap<Vec<u16>, usize> = HashMap::new();
    let mut found: Vec<Found> = Vec::new();
    for part in chunks.into_iter().flatten() {
        let number = *numbers.entry(part.cells.clone()).or_insert_with(|| {
            found.push(Found {
                cells: part.cells.clone(),
                parts: Vec::new(),
            });
            found.len() - 1
        });
        found[number].parts.push(part);
    }
    merge(&mut found);
    found
        .into_par_iter()
        .with_min_len(16)
        .map(Found::group)
        .collect()
}

/// Samples that touch exactly the same cells.
struct Part {
    cells: Vec<u16>,
    members: Vec<u32>,
    /// Shares of the cells at the first sample, at the second, ...
    shares: Vec<f64>,
}

/// The parts that the samples of a chunk fall in; the first of them is sample number `first`.
fn parts(cover: &Cover, chunk: &[Sample], first: usize) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let mut shares = Vec::new();
    let mut last = 0;
    for (number, &[x, y, z, _]) in (first as u32..).zip(chunk) {
        cover.shares(&Vector3::new(x, y, z), &mut shares);
        let is_of = |part: &Part| {
            let cells = part.cells.iter();
            part.cells.len() == shares.len() && cells.zip(&shares).all(|(a, (b, _))| a == b)
        };
        // Neighbours in the list are mostly neighbours on the sphere.
        if !parts.get(last).is_some_and(is_of) {
            last = parts.iter().position(is_of).unwrap_or_else(|| {
                parts.push(Part {
                    cells: shares.iter().map(|&(cell, _)| cell).collect(),
                    members: Vec::new(),
                    shares: Vec::new(),
                });
                parts.len() - 1
            });
        }
        let part = &mut parts[last];
        part.members.push(number);
        part.shares.extend(shares.iter().map(|&(_, share)| share));
    }
    parts
}

/// Parts of which all touch some of the same cells.
struct Found {
    cells: Vec<u16>,
    parts: Vec<Part>,
}

/// Moves samples to groups that have their cells and few more, where they count with shares of 0: so
/// there are fewer and larger groups. (Round a corner of four cells, samples touch four, two or one.)
fn merge(found: &mut Vec<Found>) {
    let cells = found.iter().flat_map(|group| &group.cells).max();
    let mut with_cell = vec![Vec::new(); cells.map_or(0, |&most| usize::from(most) + 1)];
    for (number, group) in found.iter().enumerate() {
        for &cell in &group.cells {
            with_cell[usize::from(cell)].push(number);
        }
    }
    let mut fewest_first: Vec<usize> = (0..found.len()).collect();
    fewest_first.sort_by_key(|&number| found[number].cells.len());
    for number in fewest_first {
        let own = &found[number].cells;
        let larger = with_cell[usize::from(own[0])]
            .iter()
            .copied()
            .filter(|&other| {
                let cells = &found[other].cells;
                cells.len() > own.len() && own.iter().all(|cell| cells.contains(cell))
            })
            .min_by_key(|&other| (found[other].cells.len(), other));
        if let Some(larger) = larger {
            let parts = std::mem::take(&mut found[number].parts);
            found[larger].parts.extend(parts);
        }
    }
    found.retain(|group| !group.parts.is_empty());
}

impl Found {
    fn group(self) -> Group {
        let count = self.parts.iter().map(|part| part.members.len()).sum();
        let mut shares = vec![0.0; self.cells.len() * count];
        let mut members = Vec::with_capacity(count);
        for part in &self.parts {
            let width = part.cells.len();
            for (at, cell) in part.cells.iter().enumerate() {
                let column = self.cells.iter().position(|own| own == cell);
                let start = column.map_or(0, |column| column * count) + members.len();
                let values = part.shares[at..].iter().step_by(width);
                for (share, value) in shares[start..].iter_mut().zip(values) {
                    *share = *value;
                }
            }
            members.extend_from_slice(&part.members);
        }
        Group {
            cells: self.cells,
            members,
            shares,
        }
    }
}
