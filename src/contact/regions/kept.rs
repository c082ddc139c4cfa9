//! What is kept for the next cut: what is near the other surface, or in it.

use super::clip::Crossing;
use super::patch::Patch;
use crate::disjoint_sets::DisjointSets;
use std::collections::BTreeMap;

/// Triangles of both surfaces.
pub(super) struct Kept {
    is_near: [Vec<bool>; 2],
    is_kept: [Vec<bool>; 2],
}

impl Kept {
    pub(super) fn new(patches: &[Patch; 2], near: &[[u32; 2]], crossing: &Crossing) -> Self {
        let mut is_near = [0, 1].map(|side| vec![false; patches[side].triangles.len()]);
        for pair in near {
            for side in 0..2 {
                is_near[side][pair[side] as usize] = true;
            }
        }
        let is_kept = [0, 1].map(|side| {
            let inside = |corner: &u32| crossing.inside[side][*corner as usize];
            let all = patches[side].triangles.iter().zip(&is_near[side]);
            all.map(|(corners, is_near)| *is_near || corners.iter().any(inside))
                .collect()
        });
        Self { is_near, is_kept }
    }

    pub(super) fn count(&self) -> usize {
        self.is_kept
            .iter()
            .flatten()
            .filter(|is_kept| **is_kept)
            .count()
    }

    /// The triangles of both surfaces, by the parts that hang together.
    pub(super) fn parts(&self, patches: &[Patch; 2], near: &[[u32; 2]]) -> Vec<[Vec<u32>; 2]> {
        let offset = self.is_kept[0].len() as u32;
        let mut sets = DisjointSets::new(self.is_kept.iter().map(Vec::len).sum());
        for &[one, two] in near {
            sets.join(one, offset + two);
        }
        let kept = |side: usize| {
            let all = (0..)
                .zip(&self.is_kept[side])
                .filter(|(_, is_kept)| **is_kept);
            all.map(|(triangle, _)| triangle)
        };
        for (side, patch) in patches.iter().enumerate() {
            let mut first = vec![None; patch.vertices.len()];
            for triangle in kept(side) {
                let own = triangle + offset * side as u32;
                for corner in patch.triangles[triangle as usize] {
                    sets.join(*first[corner as usize].get_or_insert(own), own);
                }
            }
        }
        let mut parts: BTreeMap<u32, [Vec<u32>; 2]> = BTreeMap::new();
        for side in 0..2 {
            for triangle in kept(side) {
                let set = sets.of(triangle + offset * side as u32);
                parts.entry(set).or_default()[side].push(triangle);
            }
        }
        parts
            .into_values()
            .filter(|part| part.iter().all(|side| !side.is_empty()))
            .collect()
    }

    /// What is known of the vertices of a patch for sure: those of what is left out lie outside, and those far from
    /// the other surface where they are.
    pub(super) fn known(
        &self,
        side: usize,
        patch: &Patch,
        crossing: &Crossing,
    ) -> Vec<Option<bool>> {
        let mut known: Vec<Option<bool>> = crossing.inside[side]
            .iter()
            .map(|is_inside| Some(*is_inside))
            .collect();
        for (triangle, corners) in patch.triangles.iter().enumerate() {
            if self.is_near[side][triangle] {
                corners
                    .iter()
                    .for_each(|&corner| known[corner as usize] = None);
            }
        }
        for (triangle, corners) in patch.triangles.iter().enumerate() {
            if !self.is_kept[side][triangle] {
                corners
                    .iter()
                    .for_each(|&corner| known[corner as usize] = Some(false));
            }
        }
        known
    }
}
