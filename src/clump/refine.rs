//! Spheres fitted to the parts of the surface that they stand for.

use crate::measure::{Ball, EvenPlace};
use nalgebra::{Matrix4, Vector3, Vector4};
use rayon::prelude::*;

/// Rounds of assigning and fitting.
const ROUNDS: usize = 20;

/// Share of the trace that is added to the equations of a sphere: on a small part of the surface, centre and radius can
/// hardly be told apart.
const DAMPING: f64 = 1e-3;

/// In each round every place goes to the sphere that is nearest to it, and each sphere takes a damped step of
/// Gauss and Newton to the least sum of squared distances from its places: the hard union's own distances, for those of
/// a smoothed one would shrink the spheres. Gives the spheres of the round with the least sum over all.
pub(super) fn refine(places: &[EvenPlace], spheres: Vec<Ball>) -> Vec<Ball> {
    let mut best = (f64::INFINITY, spheres.clone());
    let mut spheres = spheres;
    for _ in 0..=ROUNDS {
        let owners: Vec<Owner> = places.par_iter().map(|at| owner(at, &spheres)).collect();
        let sum = owners.iter().map(|owner| owner.distance.powi(2)).sum();
        if sum < best.0 {
            best = (sum, spheres.clone());
        }
        spheres = step(places, &owners, &spheres);
    }
    best.1
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

fn step(places: &[EvenPlace], owners: &[Owner], spheres: &[Ball]) -> Vec<Ball> {
    let mut equations = vec![(Matrix4::zeros(), Vector4::zeros()); spheres.len()];
    for (at, &Owner { index, distance }) in places.iter().zip(owners) {
        let from = at.place - spheres[index].centre.coords;
        let away = from / from.norm().max(f64::MIN_POSITIVE);
        let row = Vector4::new(away.x, away.y, away.z, 1.0);
        equations[index].0 += row * row.transpose();
        equations[index].1 += row * distance;
    }
    let moved = |(ball, (matrix, side)): (&Ball, &(Matrix4<f64>, Vector4<f64>))| {
        let damped = matrix + Matrix4::identity() * (DAMPING * matrix.trace());
        let Some(factor) = damped.cholesky() else {
            return *ball;
        };
        let step = factor.solve(side);
        Ball {
            centre: ball.centre + Vector3::new(step.x, step.y, step.z),
            radius: (ball.radius + step.w).max(0.0),
        }
    };
    spheres.iter().zip(&equations).map(moved).collect()
}
