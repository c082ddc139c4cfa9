//! Integrals over an expansion of the whole sphere, ring by ring.
//!
//! N Gauss nodes in z and 2 N equal steps of azimuth on each ring integrate harmonics of degree <= 2N - 1
//! exactly (dΩ = dz dphi). Directions of a ring share the sums over degrees, so a node costs L and not L²
//! operations.

use super::Integrals;
use super::integrals::{MAX_EVALUATIONS, Sums};
use crate::model::{Ray, Stretch, Whole};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// The rule of so many rings: the height of each and the solid angle of its nodes, and the places of the
/// nodes on the unit circle.
fn rings(count: usize) -> (Vec<(f64, f64)>, Vec<[f64; 2]>) {
    let nodes = 2 * count;
    let step = TAU / nodes as f64;
    let rule = GaussLegendre::new(count);
    let heights = rule.nodes().iter().zip(rule.weights());
    let circle = (0..nodes).map(|i| {
        let (sin, cos) = (step * i as f64).sin_cos();
        [cos, sin]
    });
    (
        heights.map(|(z, weight)| (*z, weight * step)).collect(),
        circle.collect(),
    )
}

/// The nodes of so many rings: unit vectors, and their weights in solid angle.
pub(super) fn ring_nodes(count: usize) -> Vec<(Vector3<f64>, f64)> {
    let (heights, circle) = rings(count);
    let nodes = heights.into_iter().flat_map(|(z, solid_angle)| {
        let s = ((1.0 - z) * (1.0 + z)).sqrt();
        let at = move |[cos, sin]: &[f64; 2]| (Vector3::new(s * cos, s * sin, z), solid_angle);
        circle.iter().map(at)
    });
    nodes.collect()
}

/// Integrates the body that is this one once stretched. Volume and moments are exact to rounding from the
/// first number of rings on, for r⁵ times two components of the direction is of degree 5 L + 2; rings are
/// added until mean radius and area change by less than the tolerance, or [`MAX_EVALUATIONS`] are spent.
/// The error told is that change.
pub(super) fn integrate_rings(surface: &Whole, stretch: &Stretch, tolerance: f64) -> Integrals {
    let mut count = 5 * surface.degree() / 2 + 2;
    let mut found = sums(surface, stretch, count);
    let mut evaluations = 2 * count * count;
    loop {
        count = count * 3 / 2 + 4;
        evaluations += 2 * count * count;
        let finer = sums(surface, stretch, count);
        let error = found.difference(&finer, &finer);
        let next = count * 3 / 2 + 4;
        let is_spent = evaluations + 2 * next * next > MAX_EVALUATIONS;
        if error <= tolerance || error.is_nan() || is_spent {
            return finer.integrals(error, evaluations);
        }
        found = finer;
    }
}

fn sums(surface: &Whole, stretch: &Stretch, count: usize) -> Sums {
    let (heights, circle) = rings(count);
    let ring = |&(z, solid_angle): &(f64, f64)| {
        let s = ((1.0 - z) * (1.0 + z)).sqrt();
        let places: Vec<_> = circle.iter().map(|at| at.map(|x| s * x)).collect();
        let values = surface.radii_and_gradients_at(z, &places);
        let mut sums = Sums::default();
        for ([x, y], (radius, gradient)) in places.into_iter().zip(values) {
            sums.add_ray(&stretch.ray(Ray {
                direction: Vector3::new(x, y, z),
                solid_angle,
                radius,
                gradient,
            }));
        }
        sums
    };
    let sums: Vec<Sums> = heights.par_iter().map(ring).collect();
    // In their order, so that the result does not depend on the threads.
    sums.into_iter()
        .fold(Sums::default(), |all, sums| all + sums)
}
