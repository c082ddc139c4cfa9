//! Loss, gradient and curvature of a fit: of all points, parts and prior.
//!
//! The unknowns are logarithms, angles and lengths in mean radii, all of order one, and those that the points do not
//! determine are damped; so the normal equations lose no digits that count, and their solution is a step only.

use super::bodies::{Body, Distance, USUAL_EXPONENT};
use super::form::{EXPONENTS_FROM, Form, NUMBERS};
use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;

/// Points that are added up together, whatever the number of threads.
const CHUNK: usize = 1024;

/// Parts with less than this share in a distance are left out of its slopes.
const LEAST_SHARE: f64 = 1e-4;

/// How far astray points are taken to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// All points but gross strays are of the body: nearly least squares.
    Wide,
    /// A good part of the points is not of the body.
    Narrow,
}

/// What a fit weighs points by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weighing {
    pub(super) form: Form,
    pub(super) reach: Reach,
    /// Distances beyond this count less: the scale of Cauchy's loss.
    pub(super) scale: f64,
    /// What the square of a logarithm of an exponent off the usual one costs.
    pub(super) prior: f64,
    /// How sharply the least of the parts' distances is taken, in one over mean radii.
    pub(super) sharpness: f64,
}

/// Loss, and its derivatives by the parameters of all bodies in turn.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations {
    pub(super) loss: f64,
    pub(super) gradient: DVector<f64>,
    /// The lower triangle only.
    pub(super) matrix: DMatrix<f64>,
}

/// The soft minimum of the distances to all bodies, and its slopes by parameter, ascending.
pub(super) struct Row {
    pub(super) value: f64,
    pub(super) entries: Vec<(usize, f64)>,
}

impl Row {
    pub(super) fn new() -> Self {
        Self {
            value: 0.0,
            entries: Vec::new(),
        }
    }

    /// -log(sum exp(-sharpness d)) / sharpness over the bodies' distances d: no more than the least, and smooth.
    pub(super) fn set(
        &mut self,
        bodies: &[(Body, [f64; NUMBERS])],
        distances: &mut Vec<Distance>,
        weighing: &Weighing,
        point: &Vector3<f64>,
    ) {
        distances.clear();
        distances.extend(
            bodies
                .iter()
                .map(|(body, numbers)| body.distance(numbers, point)),
        );
        let least = distances
            .iter()
            .map(|d| d.value)
            .fold(f64::INFINITY, f64::min);
        let is_one = distances.len() == 1;
        let share = |d: &Distance| match is_one {
            true => 1.0,
            false => (-weighing.sharpness * (d.value - least)).exp(),
        };
        let sum: f64 = distances.iter().map(share).sum();
        self.value = if is_one {
            least
        } else {
            least - sum.ln() / weighing.sharpness
        };
        self.entries.clear();
        let (ties, form) = (weighing.form.ties(), weighing.form);
        for (index, distance) in distances.iter().enumerate() {
            let share = share(distance) / sum;
            if share < LEAST_SHARE {
                continue;
            }
            let from = index * form.parameters();
            let numbers = distance.numbers.map(|number| ties[number]).into_iter();
            let places = numbers.chain(form.numbers()..form.parameters());
            let entries = places.zip(distance.slopes);
            self.entries
                .extend(entries.map(|(place, slope)| (from + place, slope * share)));
        }
    }
}

impl NormalEquations {
    fn zero(parameters: usize) -> Self {
        Self {
            loss: 0.0,
            gradient: DVector::zeros(parameters),
            matrix: DMatrix::zeros(parameters, parameters),
        }
    }

    /// Those of bodies and points.
    pub(super) fn new(bodies: &[Body], points: &[Vector3<f64>], weighing: &Weighing) -> Self {
        let parameters = bodies.len() * weighing.form.parameters();
        let prepared: Vec<_> = bodies.iter().map(|body| (*body, body.numbers())).collect();
        let chunks: Vec<Self> = points
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut sum = Self::zero(parameters);
                let mut row = Row::new();
                let mut distances = Vec::new();
                for point in chunk {
                    row.set(&prepared, &mut distances, weighing, point);
                    sum.add(&row, weighing.scale);
                }
                sum
            })
            .collect();
        let mut sum = Self::zero(parameters);
        for chunk in chunks {
            sum.loss += chunk.loss;
            sum.gradient += chunk.gradient;
            sum.matrix += chunk.matrix;
        }
        sum.add_prior(bodies, weighing);
        sum
    }

    fn add(&mut self, row: &Row, scale: f64) {
        let square = (row.value / scale).powi(2);
        let weight = 1.0 / (1.0 + square);
        self.loss += 0.5 * scale * scale * square.ln_1p();
        let parameters = self.gradient.len();
        let matrix = self.matrix.as_mut_slice();
        for (i, &(column, slope)) in row.entries.iter().enumerate() {
            let weighted = weight * slope;
            self.gradient[column] += weighted * row.value;
            let column = &mut matrix[column * parameters..][..parameters];
            for &(line, other) in &row.entries[i..] {
                column[line] += weighted * other;
            }
        }
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
    let prepared: Vec<_> = bodies.iter().map(|body| (*body, body.numbers())).collect();
    let nearest = |point: &Vector3<f64>| {
        let each = prepared.iter();
        each.map(|(body, numbers)| body.distance(numbers, point).value)
            .fold(f64::INFINITY, f64::min)
    };
    points.par_iter().with_min_len(CHUNK).map(nearest).collect()
}
