//! Loss, gradient and curvature of a fit: of all points, parts and prior.
//!
//! The unknowns are logarithms, angles and lengths in mean radii, all of order one, and those that the points do not
//! determine are damped; so the normal equations lose no digits that count, and their solution is a step only.

use super::bodies::{Body, USUAL_EXPONENT};
use super::distance::ReadyBody;
use super::form::EXPONENTS_FROM;
use super::sums::Sums;
use super::weighing::Weighing;
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;

/// Points that are added up together, whatever the number of threads.
const CHUNK: usize = 1024;

/// Loss, and its derivatives by the parameters of all bodies in turn.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations {
    pub(super) loss: f64,
    pub(super) gradient: DVector<f64>,
    /// The lower triangle; above it is not all.
    pub(super) matrix: DMatrix<f64>,
}

impl NormalEquations {
    /// Those of bodies and points.
    pub(super) fn new(bodies: &[Body], points: &[Vector3<f64>], weighing: &Weighing) -> Self {
        let ready: Vec<_> = bodies.iter().map(ReadyBody::new).collect();
        let chunks: Vec<Sums> = points
            .par_chunks(CHUNK)
            .map(|chunk| Sums::new(&ready, chunk, weighing))
            .collect();
        let parameters = bodies.len() * weighing.form.parameters();
        let mut found = Self {
            loss: 0.0,
            gradient: DVector::zeros(parameters),
            matrix: DMatrix::zeros(parameters, parameters),
        };
        for chunk in chunks {
            found.loss += chunk.loss;
            chunk.place(&mut found.gradient, &mut found.matrix);
        }
        found.add_prior(bodies, weighing);
        found
    }

    /// What exponents cost that are off the usual one.
    fn add_prior(&mut self, bodies: &[Body], weighing: &Weighing) {
        let ties = weighing.form.ties();
        for (index, body) in bodies.iter().enumerate() {
            for (number, tie) in ties.into_iter().enumerate().skip(EXPONENTS_FROM) {
                let place = index * weighing.form.parameters() + tie;
                let off = body.logs[number] - USUAL_EXPONENT;
                self.loss += 0.5 * weighing.prior * off * off;
                self.gradient[place] += weighing.prior * off;
                self.matrix[(place, place)] += weighing.prior;
            }
        }
    }
}

/// The distances of points from the nearest of the bodies.
pub(super) fn distances(bodies: &[Body], points: &[Vector3<f64>]) -> Vec<f64> {
    let ready: Vec<_> = bodies.iter().map(ReadyBody::new).collect();
    let nearest = |point: &Vector3<f64>| {
        let each = ready.iter().map(|body| body.distance(point).value);
        each.fold(f64::INFINITY, f64::min)
    };
    points.par_iter().with_min_len(CHUNK).map(nearest).collect()
}
