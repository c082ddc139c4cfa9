//! Integrals over a surface that is analytic on the whole sphere, ring by ring.
//!
//! N Gauss nodes in z and 2 N equal steps of azimuth on each ring integrate harmonics of degree <= 2N - 1
//! exactly (dΩ = dz dphi).

use super::sums::{Integrals, MAX_EVALUATIONS, Sums};
use crate::model::{Node, Surface};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Rings whose nodes are held at once.
const TOGETHER: usize = 64;

/// The nodes of the rule of so many rings, ring after ring.
pub(in crate::measure) fn ring_nodes(count: usize) -> impl Iterator<Item = Vec<Node>> {
    let step = TAU / (2 * count) as f64;
    let circle: Vec<_> = (0..2 * count)
        .map(|i| (step * i as f64).sin_cos())
        .collect();
    let rule = GaussLegendre::new(count);
    let heights: Vec<_> = rule.on(-1.0, 1.0).collect();
    heights.into_iter().map(move |(z, weight)| {
        let s = ((1.0 - z) * (1.0 + z)).sqrt();
        let at = |(sin, cos): &(f64, f64)| (Vector3::new(s * cos, s * sin, z), weight * step);
        circle.iter().map(at).collect()
    })
}

/// Volume and moments of harmonics of this degree are exact to rounding from the
/// first number of rings on, for r⁵ times two components of the direction is of degree 5 L + 2; rings are
/// added until mean radius and area change by less than the tolerance, or [`MAX_EVALUATIONS`] are spent.
/// The error told is that change.
pub(super) fn integrate_rings(
    surface: &(impl Surface + ?Sized),
    degree: usize,
    tolerance: f64,
) -> Integrals {
    let mut count = 5 * degree / 2 + 2;
    let mut found = sums(surface, count);
    let mut evaluations = 2 * count * count;
    loop {
        count = count * 3 / 2 + 4;
        evaluations += 2 * count * count;
        let finer = sums(surface, count);
        let error = found.difference(&finer, &finer);
        let next = count * 3 / 2 + 4;
        let is_spent = evaluations + 2 * next * next > MAX_EVALUATIONS;
        if error <= tolerance || error.is_nan() || is_spent {
            return finer.integrals(error, evaluations);
        }
        found = finer;
    }
}

fn sums(surface: &(impl Surface + ?Sized), count: usize) -> Sums {
    let mut rings = ring_nodes(count);
    let mut all = Sums::default();
    loop {
        let nodes: Vec<Node> = rings.by_ref().take(TOGETHER).flatten().collect();
        if nodes.is_empty() {
            return all;
        }
        all = all + Sums::of(surface.elements(&nodes));
    }
}
