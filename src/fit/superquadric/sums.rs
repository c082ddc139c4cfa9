//! Sums over points: of losses, and of the products of slopes that normal equations are made of.
//!
//! Products are added up in blocks of a fixed size, each of two sets of numbers that distances depend on; only then do
//! they go to the places of the parameters, of which several numbers may be one.

use super::distance::{OCTANTS, ReadyBody, TOUCHED, places};
use super::form::Form;
use super::loss::LossSum;
use super::soft_minimum::{Entry, SoftMinimum};
use super::weighing::Weighing;
use nalgebra::{DMatrix, DVector, Vector3};

/// Products of slopes, by row and column.
type Block = [[f64; TOUCHED]; TOUCHED];

/// The sums of some points.
pub(super) struct Sums {
    form: Form,
    pub(super) loss: f64,
    /// By set of numbers.
    gradients: Vec<[f64; TOUCHED]>,
    /// By pair of sets, the second no later than the first.
    blocks: Vec<Block>,
}

/// Sets of numbers of a body: one, or one of each octant if they differ.
fn sets(form: Form) -> usize {
    match form {
        Form::Single => 1,
        Form::Poly8 | Form::Poly12 => OCTANTS,
    }
}

/// The place of a pair of sets among all.
fn pair(first: usize, second: usize) -> usize {
    first * (first + 1) / 2 + second
}

impl Sums {
    /// Those of bodies and points.
    pub(super) fn new(bodies: &[ReadyBody], points: &[Vector3<f64>], weighing: &Weighing) -> Self {
        let count = bodies.len() * sets(weighing.form);
        let mut sums = Self {
            form: weighing.form,
            loss: 0.0,
            gradients: vec![[0.0; TOUCHED]; count],
            blocks: vec![[[0.0; TOUCHED]; TOUCHED]; pair(count, 0)],
        };
        let mut distance = SoftMinimum::new();
        let mut loss = LossSum::new(weighing.loss);
        for point in points {
            distance.set(bodies, weighing.sharpness, point);
            let weight = loss.add(distance.value);
            sums.add(&distance, weight);
        }
        sums.loss = loss.total();
        sums
    }

    fn set(&self, entry: &Entry) -> usize {
        match self.form {
            Form::Single => entry.body,
            Form::Poly8 | Form::Poly12 => entry.body * OCTANTS + entry.octant,
        }
    }

    #[inline(always)]
    fn add(&mut self, distance: &SoftMinimum, weight: f64) {
        for (index, entry) in distance.entries.iter().enumerate() {
            let set = self.set(entry);
            let weighted = entry.slopes.map(|slope| slope * weight);
            for (sum, slope) in self.gradients[set].iter_mut().zip(weighted) {
                *sum += slope * distance.value;
            }
            for other in &distance.entries[..=index] {
                let block = pair(set, self.set(other));
                for (row, slope) in self.blocks[block].iter_mut().zip(weighted) {
                    for (sum, other) in row.iter_mut().zip(other.slopes) {
                        *sum += slope * other;
                    }
                }
            }
        }
    }

    /// Adds the sums of slopes and of their products at the places of the parameters.
    pub(super) fn place(&self, gradient: &mut DVector<f64>, matrix: &mut DMatrix<f64>) {
        let places = |set: usize| {
            let sets = sets(self.form);
            let from = set / sets * self.form.parameters();
            places(self.form, set % sets).map(|place| from + place)
        };
        for (first, slopes) in self.gradients.iter().enumerate() {
            let rows = places(first);
            for (row, slope) in rows.into_iter().zip(slopes) {
                gradient[row] += slope;
            }
            for second in 0..=first {
                let block = &self.blocks[pair(first, second)];
                for (row, sums) in rows.into_iter().zip(block) {
                    for (column, sum) in places(second).into_iter().zip(sums) {
                        matrix[(row, column)] += sum;
                    }
                }
            }
        }
    }
}
