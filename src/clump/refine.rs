//! Spheres fitted to the parts of the surface that they stand for.

use crate::measure::{Ball, EvenPlace};
use nalgebra::{Matrix4, Point3, Vector3, Vector4};
use rayon::prelude::*;

/// Rounds of assigning and fitting.
const ROUNDS: usize = 30;

/// Share of the trace that is added to the equations of a sphere, at first and at least: on a small part of the surface,
/// centre and radius can hardly be told apart.
const DAMPING: f64 = 1e-3;

/// It is so many times as much after a step that comes nearer, and after one that does not.
const AFTER_NEARER: f64 = 0.5;
const AFTER_OTHER: f64 = 4.0;

/// No sphere becomes larger than so many times the largest that the body holds: flat parts of a surface are those of
/// endless spheres.
const OVERHANG: f64 = 1.5;

/// Lengths of a step that are tried, each half the one before, until the centre may be there.
const HALVINGS: i32 = 4;

/// In each round every place goes to the sphere that is nearest to it, and each sphere takes a step of Levenberg and
/// Marquardt to the least sum of squared distances from its places: the hard union's own distances, for those of
/// a smoothed one would shrink the spheres. Steps after which the sum over all is no less are taken back, and those to where
/// a centre may not be are shortened. `largest` is the radius of the largest sphere that the body holds.
pub(super) fn refine(
    places: &[EvenPlace],
    spheres: &[Ball],
    largest: f64,
    may_be: impl Fn(&Point3<f64>) -> bool + Sync,
) -> Vec<Ball> {
    let largest = OVERHANG * largest;
    let within = |(from, to): (&Ball, Ball)| {
        let way = to.centre - from.centre;
        let mut centres = (0..HALVINGS).map(|times| from.centre + way * 0.5_f64.powi(times));
        Ball {
            centre: centres.find(&may_be).unwrap_or(from.centre),
            radius: to.radius.clamp(0.0, largest),
        }
    };
    let mut best = Assigned::new(places, spheres.to_vec());
    let mut damping = DAMPING;
    for _ in 0..ROUNDS {
        let steps = best.spheres.par_iter().zip(step(places, &best, damping));
        let next = Assigned::new(places, steps.map(within).collect());
        match next.sum < best.sum {
            true => {
                best = next;
                damping = (AFTER_NEARER * damping).max(DAMPING);
            }
            false => damping *= AFTER_OTHER,
        }
    }
    best.spheres
}

/// Spheres, and of each place which one is nearest.
struct Assigned {
    spheres: Vec<Ball>,
    owners: Vec<Owner>,
    /// Of squared distances.
    sum: f64,
}

impl Assigned {
    fn new(places: &[EvenPlace], spheres: Vec<Ball>) -> Self {
        let owners: Vec<Owner> = places.par_iter().map(|at| owner(at, &spheres)).collect();
        Self {
            sum: owners.iter().map(|owner| owner.distance.powi(2)).sum(),
            owners,
            spheres,
        }
    }
}

/// The sphere that is nearest to a place, and how far outside of it the place is.
struct Owner {
    index: usize,
    distance: f64,
}

fn owner(at: &EvenPlace, spheres: &[Ball]) -> Owner {
    let mut owner = Owner {
        index: 0,
        distance: f64::INFINITY,
    };
    for (index, ball) in spheres.iter().enumerate() {
        let distance = (at.place - ball.centre.coords).norm() - ball.radius;
        if distance < owner.distance {
            owner = Owner { index, distance };
        }
    }
    owner
}

fn step(places: &[EvenPlace], from: &Assigned, damping: f64) -> Vec<Ball> {
    let spheres = &from.spheres;
    let mut equations = vec![(Matrix4::zeros(), Vector4::zeros()); spheres.len()];
    for (at, &Owner { index, distance }) in places.iter().zip(&from.owners) {
        let from = at.place - spheres[index].centre.coords;
        let away = from / from.norm().max(f64::MIN_POSITIVE);
        let row = Vector4::new(away.x, away.y, away.z, 1.0);
        equations[index].0 += row * row.transpose();
        equations[index].1 += row * distance;
    }
    let moved = |(ball, (matrix, side)): (&Ball, &(Matrix4<f64>, Vector4<f64>))| {
        let damped = matrix + Matrix4::identity() * (damping * matrix.trace());
        let Some(factor) = damped.cholesky() else {
            return *ball;
        };
        let step = factor.solve(side);
        Ball {
            centre: ball.centre + Vector3::new(step.x, step.y, step.z),
            radius: ball.radius + step.w,
        }
    };
    spheres.iter().zip(&equations).map(moved).collect()
}
