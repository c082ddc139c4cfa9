//! What a surface was fitted to, and how well it is known by it from place to place: how far it and its curvature are from
//! those of the samples near by.
//!
//! Where cells are pulled two ways the surface may bend far more than the body, though it is nowhere far from it, and
//! ripples beside an edge are of no body: the surface is compared with a quadric
//!
//! ```text
//! h(u, v) = c0 + c1 u + c2 v - (k11 u^2 + 2 k12 u v + k22 v^2) / 2
//! ```
//!
//! fitted by least squares to the heights of the nearest samples over the tangent plane. All of the difference counts as
//! error, though part of it is the quadric's: it follows noise more than the surface does, and misses bends as narrow as its patch.
//! The error of the distance also holds what the samples' scatter leaves open of the quadric. Of a cell the largest error counts, for
//! such bends are narrow.

use crate::fit::outcome::local_cells::{PER_CELL, Squares, of_cells, tensor};
use crate::fit::points::neighbours::Neighbours;
use crate::measure::Curvature;
use crate::model::{Grain, Surface};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, Vector3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// What a surface was fitted to.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    /// In the scan's frame and unit.
    pub(crate) points: Vec<Point3<f64>>,
    /// Outward unit normals of the scan there.
    pub(crate) normals: Vec<Vector3<f64>>,
    /// Mean squares of the move of the surface there that all samples near by share, as the middles between voxels do.
    pub(crate) hidden: Vec<f64>,
}

/// Numbers of a quadric.
const NUMBERS: usize = 6;

/// Samples of a quadric at most, and at least.
const MOST: usize = 40;
const LEAST: usize = 12;

/// A surface that turns by more radians from sample to sample is not told to by them: it rounds an edge.
const LARGEST_TURN: f64 = 0.5;

/// Cosine to the surface's normal below which a sample is of another side of the body.
const SAME_SIDE: f64 = 0.5;

/// Singular values of the quadric that count, beside the largest.
const RANK: f64 = 1e-6;

impl Samples {
    /// Points, and the normals of a grain in their directions.
    pub(super) fn on_surface(points: &[Point3<f64>], grain: &Grain) -> Self {
        let centre = grain.frame().centre;
        let is_away = |point: &&Point3<f64>| **point != centre;
        let points: Vec<Point3<f64>> = points.iter().filter(is_away).copied().collect();
        let towards: Vec<Vector3<f64>> = points.iter().map(|point| point - centre).collect();
        let jets = grain.jets(&towards).into_iter().zip(&towards);
        Self {
            normals: jets
                .map(|(jet, n)| Curvature::new(n, &jet).normal)
                .collect(),
            hidden: vec![0.0; points.len()],
            points,
        }
    }

    /// Squares of the errors of a surface that was fitted to these samples, in the directions of cells.
    pub(super) fn local_errors(&self, grain: &Grain) -> Vec<Squares> {
        let places: Vec<Vector3<f64>> = self.points.iter().map(|point| point.coords).collect();
        let neighbours = Neighbours::new(&places);
        let centre = grain.frame().centre.coords;
        let towards = of_cells(grain);
        let jets = grain.jets(&towards);
        let squares: Vec<Squares> = towards
            .par_iter()
            .zip(&jets)
            .map(|(n, jet)| {
                let curvature = Curvature::new(n, jet);
                let place = centre + jet.place;
                let near = self.near(&neighbours, &place, &curvature.normal);
                let hidden = near.first().map_or(0.0, |&at| self.hidden[at]);
                let near: Vec<Vector3<f64>> = (near.into_iter())
                    .map(|at| self.points[at].coords - place)
                    .collect();
                // Of what no samples tell, all is in doubt.
                let told = quadric(&near, &curvature).unwrap_or(Quadric {
                    square: jet.place.norm_squared(),
                    tensor: Matrix3::zeros(),
                    spacing: f64::INFINITY,
                });
                let own = tensor(&curvature);
                let off = match own.norm() * told.spacing < LARGEST_TURN {
                    true => own - told.tensor,
                    false => own,
                };
                Squares {
                    place: told.square + hidden,
                    curvature: off.norm_squared(),
                }
            })
            .collect();
        let cells = squares.chunks_exact(PER_CELL);
        cells.flat_map(|own| [worst(own); PER_CELL]).collect()
    }

    /// The samples nearest to a place that are of its side of the body, from the nearest on.
    fn near(
        &self,
        neighbours: &Neighbours,
        place: &Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> Vec<usize> {
        let found = neighbours.nearest(place, MOST).into_iter();
        found
            .filter(|&at| self.normals[at].dot(normal) > SAME_SIDE)
            .collect()
    }
}

fn worst(own: &[Squares]) -> Squares {
    let most = |of: fn(&Squares) -> f64| own.iter().map(of).fold(0.0, f64::max);
    Squares {
        place: most(|squares| squares.place),
        curvature: most(|squares| squares.curvature),
    }
}

/// Iterations allowed for singular values, which take fewer than ten each.
const MOST_ROUNDS: usize = 1000;

/// What samples round a place of a surface tell.
struct Quadric {
    /// Of its distance from the place, and the variance of that.
    square: f64,
    /// Its curvature.
    tensor: Matrix3<f64>,
    /// Distance between the samples.
    spacing: f64,
}

/// The quadric of samples round a place of a surface; `None` if they do not tell it.
fn quadric(near: &[Vector3<f64>], at: &Curvature) -> Option<Quadric> {
    let [first, second] = &at.directions;
    let reach = near.iter().map(Vector3::norm).fold(0.0, f64::max);
    if near.len() < LEAST || reach <= 0.0 {
        return None;
    }
    let mut rows = DMatrix::zeros(near.len(), NUMBERS);
    let mut heights = DVector::zeros(near.len());
    for (i, step) in near.iter().enumerate() {
        let (u, v) = (step.dot(first) / reach, step.dot(second) / reach);
        let row = [1.0, u, v, -0.5 * u * u, -u * v, -0.5 * v * v];
        rows.row_mut(i).copy_from_slice(&row);
        heights[i] = step.dot(&at.normal) / reach;
    }
    let is_finite = rows.iter().chain(&heights).all(|entry| entry.is_finite());
    is_finite.then_some(())?;
    let svd = rows
        .clone()
        .try_svd(true, true, f64::EPSILON, MOST_ROUNDS)?;
    if svd.rank(RANK * svd.singular_values.max()) < NUMBERS {
        return None;
    }
    let told = svd.solve(&heights, 0.0).ok()?;
    let spare = (near.len() - NUMBERS) as f64;
    let variance = (&heights - &rows * &told).norm_squared() / spare;
    let first_row = svd.v_t.as_ref()?.column(0);
    let leverage = first_row.component_div(&svd.singular_values).norm_squared();
    let across = first * second.transpose() + second * first.transpose();
    let along = |direction: &Vector3<f64>, k: f64| direction * direction.transpose() * k;
    Some(Quadric {
        square: (told[0] * told[0] + variance * leverage) * reach * reach,
        spacing: reach * (PI / near.len() as f64).sqrt(),
        tensor: (along(first, told[3]) + across * told[4] + along(second, told[5])) / reach,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Position, PositionGrain};
    use crate::sphere::{cube_grid, harmonic_index};

    /// A ball whose points are X(n) = radius n.
    fn ball(radius: f64) -> Grain {
        let of_unit = radius * (4.0 * PI / 3.0).sqrt();
        let mut harmonics = vec![0.0; 12];
        for (axis, order) in [1, -1, 0].into_iter().enumerate() {
            harmonics[3 * harmonic_index(1, order) + axis] = of_unit;
        }
        let position = Position::whole(harmonics).unwrap();
        PositionGrain::new(Frame::SCAN, position).unwrap().into()
    }

    fn samples(of: impl Fn(&Vector3<f64>) -> f64) -> Samples {
        let (normals, _) = cube_grid(24);
        let points = normals.iter().map(|n| Point3::from(n * of(n)));
        Samples {
            points: points.collect(),
            hidden: vec![0.0; normals.len()],
            normals,
        }
    }

    #[test]
    fn what_samples_near_by_hide_together_is_part_of_the_error() {
        let mut samples = samples(|_| 1.0);
        let own = samples.local_errors(&ball(1.0));
        samples.hidden = (samples.normals.iter())
            .map(|n| if n.z > 0.0 { 0.04 } else { 0.0 })
            .collect();
        let hidden = samples.local_errors(&ball(1.0)).into_iter().zip(own);
        for (n, (hidden, own)) in of_cells(&ball(1.0)).iter().zip(hidden) {
            let told = hidden.place - own.place;
            let expected = if n.z > 0.0 { 0.04 } else { 0.0 };
            assert!(
                (told - expected).abs() < 1e-12 || n.z.abs() < 0.2,
                "{n} {told}"
            );
        }
    }

    #[test]
    fn the_error_is_the_difference_from_the_samples() {
        let samples = samples(|_| 1.0);
        let exact = samples.local_errors(&ball(1.0));
        assert!(exact.iter().all(|e| e.curvature.sqrt() < 0.05));
        assert!(exact.iter().all(|e| e.place.sqrt() < 1e-3));
        // Both principal curvatures of a ball of .8 are a quarter too large.
        let bent = samples.local_errors(&ball(0.8));
        let off = 0.25 * 2.0_f64.sqrt();
        let is_near = |told: f64, off: f64| (told.sqrt() / off - 1.0).abs() < 0.15;
        assert!(bent.iter().all(|e| is_near(e.curvature, off)));
        assert!(bent.iter().all(|e| is_near(e.place, 0.2)));
    }

    #[test]
    fn a_surface_that_turns_from_sample_to_sample_is_not_told_by_them() {
        let mut thin = samples(|_| 0.05);
        let dense = thin.local_errors(&ball(0.05));
        assert!(dense.iter().all(|e| e.curvature.sqrt() < 1.0));
        thin.points = thin.points.iter().step_by(60).copied().collect();
        thin.normals = thin.normals.iter().step_by(60).copied().collect();
        let all = 20.0 * 2.0_f64.sqrt();
        let rounded = thin.local_errors(&ball(0.05));
        assert!(rounded.iter().all(|e| e.curvature.sqrt() > 0.99 * all));
    }

    #[test]
    fn where_no_samples_are_near_all_curvature_is_in_doubt() {
        let mut samples = samples(|_| 1.0);
        let kept: Vec<bool> = samples.normals.iter().map(|n| n.z > -0.3).collect();
        let mut of_points = kept.iter();
        samples.points.retain(|_| *of_points.next().unwrap());
        let mut of_normals = kept.iter();
        samples.normals.retain(|_| *of_normals.next().unwrap());
        let grain = ball(1.0);
        let squares = samples.local_errors(&grain);
        let errors = crate::fit::outcome::local_cells::errors(&squares, 0.1, &grain).unwrap();
        let error = errors.at(&-Vector3::z()).curvature;
        assert!((error - 2.0_f64.sqrt()).abs() < 1e-2, "{error}");
        // Where they are near, the size of the grain is in doubt.
        let place = errors.at(&Vector3::z()).place;
        assert!((place - 0.1).abs() < 1e-3, "{place}");
    }
}
