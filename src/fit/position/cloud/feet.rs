//! The foot points of samples on a surface: where each lies nearest, and how far from it.

use super::super::foot::foot_step;
use super::super::map::is_upright;
use super::{Cloud, Distances};
use crate::model::{Position, area_normal};
use nalgebra::Vector3;

/// Halvings of the steps of directions whose triangles would turn over, before they stay.
const HALVINGS: usize = 12;

impl Cloud<'_> {
    /// Moves every direction towards the foot point of its sample on a surface, by a step of Gauss and Newton; steps
    /// by which a triangle would turn over are halved.
    pub(in crate::fit::position) fn project(&mut self, surface: &Position) {
        let vertices = self.vertices();
        let before = self.directions[..vertices].to_vec();
        let steps = foot_steps(surface, &before, &self.points[..vertices]);
        let moved = |at: usize, factor: f64| (before[at] + steps[at] * factor).normalize();
        for at in 0..vertices {
            self.directions[at] = moved(at, 1.0);
        }
        let mut factors = vec![1.0; vertices];
        let mesh = self.mesh;
        let triangles = &mesh.triangles;
        // Triangles of which a corner has moved since they were looked at.
        let mut open: Vec<usize> = (0..triangles.len()).collect();
        for halving in 0.. {
            let mut is_held = vec![false; vertices];
            for &triangle in &open {
                if !is_upright(self.images(triangle)) {
                    for corner in triangles[triangle] {
                        is_held[corner as usize] = true;
                    }
                }
            }
            let mut is_done = true;
            for at in 0..vertices {
                if !is_held[at] || factors[at] == 0.0 {
                    continue;
                }
                factors[at] = match halving < HALVINGS {
                    true => 0.5 * factors[at],
                    false => 0.0,
                };
                self.directions[at] = match factors[at] {
                    0.0 => before[at],
                    factor => moved(at, factor),
                };
                is_done = false;
            }
            if is_done {
                break;
            }
            let has_moved = |corners: &[u32; 3]| corners.iter().any(|&at| is_held[at as usize]);
            open = (0..triangles.len())
                .filter(|&triangle| has_moved(&triangles[triangle]))
                .collect();
        }
        let inside = self.inside.iter();
        let between: Vec<Vector3<f64>> = inside
            .map(|place| place.between(self.images(place.triangle)).normalize())
            .collect();
        let steps = foot_steps(surface, &between, &self.points[vertices..]);
        for ((direction, between), step) in self.directions[vertices..]
            .iter_mut()
            .zip(between)
            .zip(steps)
        {
            *direction = (between + step).normalize();
        }
        self.weigh();
    }

    /// Goes back to directions that the samples have had.
    pub(in crate::fit::position) fn turn_back(&mut self, directions: &[Vector3<f64>]) {
        self.directions.copy_from_slice(directions);
        self.weigh();
    }

    /// Distances from the surface of the samples that are asked for.
    pub(in crate::fit::position) fn distances(
        &self,
        surface: &Position,
        is_asked: impl Fn(usize) -> bool,
    ) -> Distances {
        let asked: Vec<usize> = (0..self.points.len()).filter(|&at| is_asked(at)).collect();
        let squares = self.squared_distances(surface, &asked);
        self.mean_of(asked.into_iter().zip(squares))
    }

    /// Squared distances of samples from the surface, taken after one more step to each foot point.
    pub(in crate::fit::position) fn squared_distances(
        &self,
        surface: &Position,
        samples: &[usize],
    ) -> Vec<f64> {
        let of_samples = |all: &[Vector3<f64>]| samples.iter().map(|&at| all[at]).collect();
        let directions: Vec<Vector3<f64>> = of_samples(&self.directions);
        let points: Vec<Vector3<f64>> = of_samples(&self.points);
        let found = surface.points_and_tangents(&directions);
        let steps = found.iter().zip(&directions).zip(&points);
        let nearer: Vec<Vector3<f64>> = steps
            .map(|(((foot, slopes), n), point)| {
                (n + foot_step(n, &(point - foot), slopes)).normalize()
            })
            .collect();
        let feet = surface.points_and_tangents(&nearer);
        let squared = |foot: &Vector3<f64>, point: &Vector3<f64>| (foot - point).norm_squared();
        let both = found.iter().zip(&feet).zip(&points);
        both.map(|((one, other), point)| squared(&one.0, point).min(squared(&other.0, point)))
            .collect()
    }

    /// Root of the mean of the squared distances of some samples, and the largest.
    pub(in crate::fit::position) fn mean_of(
        &self,
        squares: impl Iterator<Item = (usize, f64)>,
    ) -> Distances {
        let (mut sum, mut weight, mut max) = (0.0, 0.0, 0.0_f64);
        for (at, squared) in squares {
            sum += self.weights[at] * squared;
            weight += self.weights[at];
            max = max.max(squared);
        }
        Distances {
            rms: (sum / weight).sqrt(),
            max: max.sqrt(),
        }
    }

    /// Samples at which the surface is turned inside out.
    pub(in crate::fit::position) fn turned_over(&self, surface: &Position) -> usize {
        let found = surface.points_and_tangents(&self.directions);
        let samples = found.iter().zip(&self.directions).zip(&self.normals);
        samples
            .filter(|(((_, slopes), n), normal)| area_normal(n, slopes).dot(normal) < 0.0)
            .count()
    }
}

/// The steps of directions to the foot points of their points.
fn foot_steps(
    surface: &Position,
    directions: &[Vector3<f64>],
    points: &[Vector3<f64>],
) -> Vec<Vector3<f64>> {
    let found = surface.points_and_tangents(directions).into_iter();
    let pairs = found.zip(directions).zip(points);
    pairs
        .map(|(((foot, slopes), n), point)| foot_step(n, &(point - foot), &slopes))
        .collect()
}
