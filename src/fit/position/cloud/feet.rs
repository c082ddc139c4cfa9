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
        let found = surface.points_and_tangents(&self.directions);
        let steps: Vec<Vector3<f64>> = found
            .iter()
            .enumerate()
            .map(|(at, (point, slopes))| {
                foot_step(&self.directions[at], &(self.points[at] - point), slopes)
            })
            .collect();
        let vertices = self.vertices();
        let before = self.directions.clone();
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
        for at in vertices..self.points.len() {
            let place = &self.inside[at - vertices];
            let between = place.between(self.images(place.triangle)).normalize();
            let (point, slopes) = surface.point_and_tangents(&between);
            let step = foot_step(&between, &(self.points[at] - point), &slopes);
            self.directions[at] = (between + step).normalize();
        }
        self.weigh();
    }

    /// Goes back to directions that the samples have had.
    pub(in crate::fit::position) fn turn_back(&mut self, directions: &[Vector3<f64>]) {
        self.directions.copy_from_slice(directions);
        self.weigh();
    }

    /// Distances of the samples from the surface, those asked for, taken after one more step to each foot point.
    pub(in crate::fit::position) fn distances(
        &self,
        surface: &Position,
        is_asked: impl Fn(usize) -> bool,
    ) -> (Distances, Vec<f64>) {
        let found = surface.points_and_tangents(&self.directions);
        let nearer: Vec<Vector3<f64>> = found
            .iter()
            .enumerate()
            .map(|(at, (point, slopes))| {
                let n = &self.directions[at];
                (n + foot_step(n, &(self.points[at] - point), slopes)).normalize()
            })
            .collect();
        let feet = surface.points_and_tangents(&nearer);
        let squares: Vec<f64> = (0..self.points.len())
            .map(|at| {
                let squared = |point: &Vector3<f64>| (self.points[at] - point).norm_squared();
                squared(&found[at].0).min(squared(&feet[at].0))
            })
            .collect();
        let (mut sum, mut weight, mut max) = (0.0, 0.0, 0.0_f64);
        for at in (0..squares.len()).filter(|&at| is_asked(at)) {
            sum += self.weights[at] * squares[at];
            weight += self.weights[at];
            max = max.max(squares[at]);
        }
        let distances = Distances {
            rms: (sum / weight).sqrt(),
            max: max.sqrt(),
        };
        (distances, squares)
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
