//! The bodies of a mesh: what shares no point with the rest, and with it the inner surfaces that bound its hollows.

use crate::mesh::{Bounds, BoundsTree, Mesh, part, parts, winding_number};
use nalgebra::Point3;
use rayon::prelude::*;

/// Corners of a part by which it is told whether another holds it.
const PROBES: usize = 12;

/// How often a surface goes round what is within it, at least: less is that of an open one.
const ROUND: f64 = 0.9;

/// A mesh for each body. An inner surface is one that an odd number of others hold; the innermost of these is its body's.
pub(super) fn bodies(mesh: &Mesh) -> Vec<Mesh> {
    let lists = parts(mesh);
    let parts: Vec<Part> = lists
        .iter()
        .map(|triangles| Part::new(part(mesh, triangles)))
        .collect();
    let tree = BoundsTree::new(parts.iter().map(|part| part.bounds).collect());
    let holders: Vec<Vec<usize>> = parts
        .par_iter()
        .enumerate()
        .map(|(own, part)| {
            let near = tree.meeting(&part.bounds).map(|other| other as usize);
            let others = near.filter(|&other| other != own);
            let mut holders: Vec<usize> =
                others.filter(|&other| parts[other].holds(part)).collect();
            holders.sort_unstable();
            holders
        })
        .collect();
    let mut triangles = vec![Vec::new(); parts.len()];
    for (own, list) in lists.iter().enumerate() {
        let is_inner = holders[own].len() % 2 == 1;
        let innermost = holders[own]
            .iter()
            .max_by_key(|&&other| holders[other].len());
        let body = innermost.filter(|_| is_inner).unwrap_or(&own);
        triangles[*body].extend(list);
    }
    triangles.retain(|list| !list.is_empty());
    triangles.iter().map(|list| part(mesh, list)).collect()
}

struct Part {
    mesh: Mesh,
    bounds: Bounds,
    /// Opposite corners of the bounds.
    ends: [Point3<f64>; 2],
}

impl Part {
    fn new(mesh: Mesh) -> Self {
        let first = mesh.vertices.first().copied().unwrap_or_default();
        let ends = [first.coords; 2];
        let ends = mesh.vertices.iter().fold(ends, |[low, high], point| {
            [low.inf(&point.coords), high.sup(&point.coords)]
        });
        let ends = ends.map(Point3::from);
        Self {
            bounds: Bounds::new(ends, 0.0),
            mesh,
            ends,
        }
    }

    fn holds(&self, other: &Self) -> bool {
        let step = other.mesh.vertices.len().div_ceil(PROBES).max(1);
        let mut probes = other.mesh.vertices.iter().step_by(step);
        let is_within = |probe| winding_number(&self.mesh, probe).abs() > ROUND;
        other.ends.iter().all(|end| self.bounds.holds(end)) && probes.all(is_within)
    }
}
