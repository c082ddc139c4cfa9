//! Standard errors of a surface's figures.
//!
//! A figure that changes by g'dc with the coefficients c has, to first order, the error
//!
//! ```text
//! sum over points of  psi = w (n.B z) e,     A z = g
//! ```
//!
//! with A the matrix of the least squares, B z the move of the surface under a point of weight w, n its normal and e its
//! distance: one solution per figure. Errors of points are independent of each other, but need not be alike: the variance is the sum of squares of psi
//! (Huber 1967, White 1980), as much larger as held-out points are farther off than fitted ones. To it are added, as
//! squares,
//!
//! - what is left at the points, for the penalty on roughness and too few functions leave more than noise: the figure's
//!   change if the surface moved there;
//! - of the area what second order brings: ripples of noise that the surface has, and of the grain that it has not.
//!
//! There are none of a surface that crosses itself.

use super::cloud::Cloud;
use super::functionals::{FIGURES, Figures, Functionals, by_move};
use super::functions::{Functions, Rows};
use super::least_squares::values;
use crate::fit::estimate::figures::{INERTIA, derivatives, form, mass};
use crate::fit::estimate::functionals::{INTEGRALS, unlist};
use crate::fit::estimate::{NoInterval, StandardErrors};
use crate::fit::linear::BlockFactor;
use crate::fit::neighbours::Neighbours;
use crate::measure::PrincipalInertia;
use crate::model::Position;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use std::f64::consts::PI;

/// A fit whose errors are asked for, of a body of about radius 1.
pub(super) struct Solved<'a> {
    pub(super) functions: &'a Functions,
    pub(super) surface: &'a Position,
    /// The factored matrix of the least squares, and its rows at the samples.
    pub(super) factor: &'a BlockFactor,
    pub(super) rows: &'a [Rows],
    pub(super) cloud: &'a Cloud<'a>,
    /// Distances of held-out points over those of fitted ones.
    pub(super) held_out: f64,
    /// Weight of the roughness.
    pub(super) roughness: f64,
}

/// Least standard errors, relative.
const FLOOR: f64 = 2e-5;

impl Solved<'_> {
    /// The standard errors of a surface's figures.
    pub(super) fn errors(&self) -> Result<StandardErrors, NoInterval> {
        let functionals =
            Functionals::new(self.functions, self.surface).ok_or(NoInterval::NotFinite)?;
        let distances = self.distances();
        let covariance = self.covariance(&functionals, &distances);
        let left = self.left(&distances) * self.held_out;

        let (best, _) = mass(&functionals.moments);
        let jacobian = derivatives(&functionals.moments);
        let block = covariance.fixed_view::<INTEGRALS, INTEGRALS>(0, 0);
        let of_mass = jacobian * block * jacobian.transpose();
        let off = jacobian * left;
        let second_order = self.ripples(&distances, best.area);
        if std::env::var_os("DEBUG_ERRORS").is_some() {
            eprintln!("V: sd {:.4}% left {:.4}%  A: sd {:.4}% left {:.4}% ripples {:.4?}%", 100.0*of_mass[(1,1)].sqrt()/best.volume, 100.0*off[1]/best.volume, 100.0*of_mass[(0,0)].sqrt()/best.area, 100.0*off[0]/best.area, second_order.map(|x| 100.0*x/best.area));
        }
        let mut variances = of_mass.diagonal() + off.component_mul(&off);
        variances[0] += second_order.iter().map(|x| x * x).sum::<f64>();
        let errors = unlist(&variances);
        let axes = &functionals.principal.axes;
        let off = unlist(&off).second;
        let moments = Vector3::from_fn(|i, _| {
            let axis = axes.column(i).into_owned();
            let form = form(&axis, &axis);
            let inertia = of_mass.fixed_view::<6, 6>(INERTIA, INERTIA);
            form.dot(&(inertia * form)) + axis.dot(&(off * axis)).powi(2)
        });
        let dimensions = Vector3::from_fn(|i, _| {
            let extent = self.extent(&functionals, &jacobian, i);
            let ends = functionals.ends[i].each_ref().map(|end| {
                let sd = covariance[(end.figure, end.figure)].max(0.0).sqrt();
                let rivals = end.share_within(2.0 * sd) * self.functions.count() as f64;
                sd * (2.0 * rivals.max(1.0).ln()).sqrt()
            });
            if std::env::var_os("DEBUG_ERRORS").is_some() { eprintln!("extent {i} sd {:.4}% ends {:.4?}%", 100.0*extent.dot(&(covariance * extent)).sqrt()/functionals.length(i), ends.map(|e|100.0*e/functionals.length(i))); }
            let higher: f64 = ends.iter().sum();
            extent.dot(&(covariance * extent))
                + higher * higher
                + (FLOOR * functionals.length(i)).powi(2)
        });
        let root = |x: f64| x.max(0.0).sqrt();
        Ok(StandardErrors {
            area: root(errors.area).hypot(FLOOR * best.area),
            volume: root(errors.volume).hypot(FLOOR * best.volume),
            centroid: errors.first.map(root),
            inertia: errors.second.map(root),
            moments: moments.map(root),
            dimensions: dimensions.map(root),
            dimensions_excess: Vector3::zeros(),
        })
    }

    /// The change of an extent with the figures: its ends move, and its axis turns with the inertia.
    fn extent(
        &self,
        functionals: &Functionals,
        jacobian: &SMatrix<f64, INTEGRALS, INTEGRALS>,
        axis: usize,
    ) -> Figures {
        let PrincipalInertia { moments, axes } = &functionals.principal;
        let span = functionals.span(axis);
        let mut by_inertia = SVector::<f64, 6>::zeros();
        for other in (0..3).filter(|&other| other != axis) {
            let (own, across) = (axes.column(axis).into_owned(), axes.column(other).into_owned());
            let gap = moments[axis] - moments[other];
            by_inertia += form(&across, &own) * (span.dot(&across) / gap);
        }
        let mut change = Figures::zeros();
        let turn = jacobian.fixed_rows::<6>(INERTIA).transpose() * by_inertia;
        change.fixed_rows_mut::<INTEGRALS>(0).copy_from(&turn);
        for end in &functionals.ends[axis] {
            change[end.figure] = 1.0;
        }
        change
    }

    /// Distances of the samples from the surface, along the normals of the scan.
    fn distances(&self) -> Vec<f64> {
        let cloud = self.cloud;
        let found = self.surface.points_and_tangents(&cloud.directions);
        let distance = |(at, (point, _)): (usize, &(Vector3<f64>, Matrix3<f64>))| {
            cloud.normals[at].dot(&(cloud.points[at] - point))
        };
        found.iter().enumerate().map(distance).collect()
    }

    /// Of the figures, by the errors of points.
    fn covariance(&self, functionals: &Functionals, distances: &[f64]) -> SMatrix<f64, FIGURES, FIGURES> {
        let cloud = self.cloud;
        let mut solved = functionals.gradients(self.functions);
        self.factor.solve(&mut solved);
        let mut influences = vec![Figures::zeros(); cloud.points.len()];
        for rows in self.rows {
            for figure in 0..FIGURES {
                let of_cell = |cell: u16| solved[usize::from(cell)].col_as_slice(figure).as_chunks().0;
                for (value, &member) in values(rows, of_cell).iter().zip(&rows.members) {
                    let at = member as usize;
                    let share = cloud.weights[at] * cloud.normals[at].dot(value);
                    for (point, part) in cloud.points_of(at) {
                        influences[point][figure] += part * share * distances[at];
                    }
                }
            }
        }
        let sum: SMatrix<f64, FIGURES, FIGURES> =
            influences.iter().map(|psi| psi * psi.transpose()).sum();
        sum * (self.held_out * self.held_out)
    }

    /// The changes of area, volume and moments if the surface moved to the samples.
    fn left(&self, distances: &[f64]) -> SVector<f64, INTEGRALS> {
        let cloud = self.cloud;
        let all = (0..distances.len()).filter(|&at| cloud.is_scanned(at));
        let (mut sum, mut weight) = (SVector::zeros(), 0.0);
        for at in all {
            let n = &cloud.directions[at];
            let change = by_move(n, &self.surface.derivatives(n));
            sum += change * (cloud.weights[at] * distances[at]);
            weight += cloud.weights[at];
        }
        sum * (cloud.area() / weight)
    }

    /// By what the area is larger for the ripples of noise, and smaller for those of the grain.
    fn ripples(&self, distances: &[f64], _area: f64) -> [f64; 2] {
        let cloud = self.cloud;
        let points: Vec<usize> = (0..cloud.points.len()).filter(|&at| cloud.is_point(at)).collect();
        let places: Vec<_> = points.iter().map(|&at| cloud.directions[at]).collect();
        let near = Neighbours::new(&places);
        let (mut squares, mut products) = (0.0, 0.0);
        for (own, &at) in points.iter().enumerate() {
            let other = near.nearest(&places[own], 2).into_iter().find(|&other| other != own);
            let Some(other) = other else { continue };
            squares += distances[at].powi(2);
            products += distances[at] * distances[points[other]];
        }
        let count = points.len() as f64;
        let functions = self.functions.count() as f64;
        let root = self.roughness.sqrt();
        let told = (root * functions).atan() / root;
        let noise = squares / count;
        let finer = (products / count + noise * told / count).max(0.0);
        if std::env::var_os("DEBUG_ERRORS").is_some() {
            eprintln!("N {count} functions {functions} told {told:.0} noise {:.3}% corr {:.3} ho/rms {:.3} rough {:e}", 100.0*noise.sqrt(), products/squares, self.held_out, self.roughness);
        }
        let per_point = noise * functions.powi(2) / (1.0 + self.roughness * functions.powi(2)) / count;
        [PI * per_point, 2.0 * PI * finer * told]
    }
}
