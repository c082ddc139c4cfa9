//! What a surface without a radius was fitted to, and how well its curvature is known by it: how far it is from that of
//! the samples near by.
//!
//! Where cells are pulled two ways the surface may bend far more than the body, though it is nowhere far from it: its
//! curvature is compared with that of a quadric
//!
//! ```text
//! h(u, v) = c0 + c1 u + c2 v - (k11 u^2 + 2 k12 u v + k22 v^2) / 2
//! ```
//!
//! fitted by least squares to the heights of the nearest samples over the tangent plane. All of the difference counts as
//! error, that of the quadric too: it follows noise more than the surface does, and no bend of the size of its samples' patch.
//! Of a cell the largest counts, for such bends are narrow.

use crate::fit::curvature_cells::{PER_CELL, directions, errors, tensor};
use crate::fit::neighbours::Neighbours;
use crate::measure::Curvature;
use crate::model::{CurvatureErrors, PositionGrain, Surface};
use nalgebra::{DMatrix, DVector, Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// What a surface was fitted to.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    /// In the scan's frame and unit.
    pub(crate) points: Vec<Point3<f64>>,
    /// Outward unit normals of the scan there.
    pub(crate) normals: Vec<Vector3<f64>>,
}

/// Samples of a quadric at most, and at least: it has six numbers.
const MOST: usize = 40;
const LEAST: usize = 12;

/// Cosine to the surface's normal below which a sample is of another side of the body.
const SAME_SIDE: f64 = 0.5;

/// Singular values of the quadric that count, beside the largest.
const RANK: f64 = 1e-6;

impl Samples {
    /// Standard errors of the curvature of a grain that was fitted to these samples.
    pub(crate) fn curvature_errors(&self, grain: &PositionGrain) -> Option<CurvatureErrors> {
        let places: Vec<Vector3<f64>> = self.points.iter().map(|point| point.coords).collect();
        let neighbours = Neighbours::new(&places);
        let frame = grain.frame();
        let towards: Vec<Vector3<f64>> = directions().iter().map(|n| frame.axes * n).collect();
        let jets = grain.jets(&towards);
        let squares: Vec<f64> = towards
            .par_iter()
            .zip(&jets)
            .map(|(n, jet)| {
                let curvature = Curvature::new(n, jet);
                let told = tensor(&curvature);
                let place = frame.centre.coords + jet.place;
                let near = self.near(&neighbours, &place, &curvature.normal);
                // Of what no samples tell, all is in doubt.
                let samples = quadric(&near, &curvature).unwrap_or_else(Matrix3::zeros);
                (told - samples).norm_squared()
            })
            .collect();
        let cells = squares.chunks_exact(PER_CELL);
        let worst = cells.flat_map(|own| [own.iter().copied().fold(0.0, f64::max); PER_CELL]);
        errors(&worst.collect::<Vec<f64>>())
    }

    /// The samples nearest to a place that are of its side of the body, from there.
    fn near(
        &self,
        neighbours: &Neighbours,
        place: &Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> Vec<Vector3<f64>> {
        let found = neighbours.nearest(place, MOST).into_iter();
        found
            .filter(|&at| self.normals[at].dot(normal) > SAME_SIDE)
            .map(|at| self.points[at].coords - place)
            .collect()
    }
}

/// The curvature tensor of samples round a place of a surface; `None` if they do not tell it.
fn quadric(near: &[Vector3<f64>], at: &Curvature) -> Option<Matrix3<f64>> {
    let [first, second] = &at.directions;
    let reach = near.iter().map(Vector3::norm).fold(0.0, f64::max);
    if near.len() < LEAST || reach <= 0.0 {
        return None;
    }
    let mut rows = DMatrix::zeros(near.len(), 6);
    let mut heights = DVector::zeros(near.len());
    for (i, step) in near.iter().enumerate() {
        let (u, v) = (step.dot(first) / reach, step.dot(second) / reach);
        let row = [1.0, u, v, -0.5 * u * u, -u * v, -0.5 * v * v];
        rows.row_mut(i).copy_from_slice(&row);
        heights[i] = step.dot(&at.normal) / reach;
    }
    let svd = rows.svd(true, true);
    if svd.rank(RANK * svd.singular_values.max()) < 6 {
        return None;
    }
    let told = svd.solve(&heights, 0.0).ok()? / reach;
    let across = first * second.transpose() + second * first.transpose();
    let along = |direction: &Vector3<f64>, k: f64| direction * direction.transpose() * k;
    Some(along(first, told[3]) + across * told[4] + along(second, told[5]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Position};
    use crate::sphere::{cube_grid, harmonic_index};
    use std::f64::consts::PI;

    /// A ball whose points are X(n) = radius n.
    fn ball(radius: f64) -> PositionGrain {
        let of_unit = radius * (4.0 * PI / 3.0).sqrt();
        let mut harmonics = vec![0.0; 12];
        for (axis, order) in [1, -1, 0].into_iter().enumerate() {
            harmonics[3 * harmonic_index(1, order) + axis] = of_unit;
        }
        PositionGrain::new(Frame::SCAN, Position::whole(harmonics).unwrap()).unwrap()
    }

    fn samples(of: impl Fn(&Vector3<f64>) -> f64) -> Samples {
        let (normals, _) = cube_grid(24);
        let points = normals.iter().map(|n| Point3::from(n * of(n)));
        Samples {
            points: points.collect(),
            normals,
        }
    }

    #[test]
    fn the_error_is_the_difference_from_the_samples() {
        let samples = samples(|_| 1.0);
        let exact = samples.curvature_errors(&ball(1.0)).unwrap();
        assert!(exact.of_cells().iter().all(|&error| error < 0.05));
        // Both principal curvatures of a ball of .8 are a quarter too large.
        let bent = samples.curvature_errors(&ball(0.8)).unwrap();
        let off = 0.25 * 2.0_f64.sqrt();
        assert!(bent.of_cells().iter().all(|e| (e / off - 1.0).abs() < 0.15));
    }

    #[test]
    fn where_no_samples_are_near_all_curvature_is_in_doubt() {
        let mut samples = samples(|_| 1.0);
        let kept: Vec<bool> = samples.normals.iter().map(|n| n.z > -0.3).collect();
        let mut of_points = kept.iter();
        samples.points.retain(|_| *of_points.next().unwrap());
        let mut of_normals = kept.iter();
        samples.normals.retain(|_| *of_normals.next().unwrap());
        let errors = samples.curvature_errors(&ball(1.0)).unwrap();
        let error = errors.at(&-Vector3::z());
        assert!((error - 2.0_f64.sqrt()).abs() < 1e-2, "{error}");
    }
}
