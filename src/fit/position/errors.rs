//! Standard errors of a surface's figures.
//!
//! A figure that changes by g'dc with the coefficients c has, to first order, the error
//!
//! ```text
//! sum over points of  psi = w (n.B z) e,     A z = g
//! ```
//!
//! with A the matrix of the least squares, B z the move of the surface under a point of weight w, n its normal and e its
//! distance: one solution per figure. Errors of points are independent of each other, but need not be alike: the
//! variance is the sum of squares of psi (Huber 1967, White 1980), as much larger as held-out points are farther off than
//! fitted ones. To it are added, as squares,
//!
//! - the change of the figure if the surface moved to the points, for the penalty on roughness and too few functions
//!   leave more than noise; and the same of held-out points, which see what the surface does between the others, as far
//!   as it is more than they scatter; and the same of the vertices alone, for the body bulges over faces that are chords;
//!   and of points without faces the same by the area that is nearest to each, for where they are sparse each tells more;
//! - of [voxels](super::voxels), that those inside are not the grain: flat sides may lie anywhere between two layers;
//! - of points without faces what a [hole](crate::fit::holes) between them may hide;
//! - what is [not resolved](Solved::unresolved): a part of it is taken to have the same sign everywhere;
//! - of the area what second order brings: ripples of noise that the surface has, and of the grain that it has not, and
//!   texture between the points, as [pairs](crate::fit::points::close_pairs) that lie close together tell it, or as far as the
//!   surface carries [detail](super::finest) as fine as points resolve: then what it leaves of them may be more of it;
//!
//! Those of lengths are [elsewhere](super::dimension_errors).
//!
//! There are none of a surface that crosses itself.

use super::cloud::{Cloud, HELD_OUT};
use super::dimension_errors::{FLOOR, Lengths};
use super::ends::Ends;
use super::finest;
use super::functionals::{FIGURES, FigureVector, Functionals, by_move};
use super::functions::{Functions, Rows};
use super::least_squares::values;
use super::voxels::Hidden;
use crate::fit::holes::Holes;
use crate::fit::linear::BlockFactor;
use crate::fit::outcome::figures::{INERTIA, INTEGRALS, derivatives, form, mass, unlist};
use crate::fit::points::close_pairs;
use crate::fit::points::neighbours::Neighbours;
use crate::model::{NoStandardErrors, Position, StandardErrors};
use nalgebra::{SMatrix, SVector, Vector3};
use std::f64::consts::PI;

/// A fit whose errors are asked for, of a body of about radius 1.
pub(super) struct Solved<'a> {
    pub(super) functions: &'a Functions,
    pub(super) surface: &'a Position,
    /// The surface without the points held out.
    pub(super) other: &'a Position,
    /// The factored matrix of the least squares, and its rows at the samples.
    pub(super) factor: &'a BlockFactor,
    pub(super) rows: &'a [Rows],
    pub(super) cloud: &'a Cloud<'a>,
    /// Root mean squares of the distances of points, and of those held out.
    pub(super) rms: [f64; 2],
    /// Weight of the roughness.
    pub(super) roughness: f64,
}

/// Share of what is not resolved that has one sign all over the surface: of bodies whose truth is known at most a fifth.
const ONE_SIDED: f64 = 0.15;

/// Squared slopes of ripples over those of functions that fill a band of wavelengths evenly: of the noise that blended
/// cells follow, and of what they leave. Measured on bodies whose truth is known.
const STEEPER_NOISE: f64 = 3.0;
const STEEPER_REST: f64 = 2.0;

/// Share of the squared wavenumber of as many functions as points that these resolve well.
const RESOLVED: f64 = 0.5;

impl Solved<'_> {
    /// What the scan's voxels hide of the surface.
    pub(super) fn hidden_by_voxels(&self) -> Option<Hidden> {
        let voxels = self.cloud.voxels.as_ref()?;
        Some(voxels.hidden(self.functions, self.surface, self.told(), self.cloud.mesh()))
    }

    /// The standard errors of a surface's figures, of which voxels hide so much.
    pub(super) fn errors(
        &self,
        hidden: Option<&Hidden>,
    ) -> Result<StandardErrors, NoStandardErrors> {
        let functionals =
            Functionals::new(self.functions, self.surface).ok_or(NoStandardErrors::NotFinite)?;
        let feet = self.feet(self.surface);
        let distances = self.distances(&feet);
        let covariance = self.covariance(&functionals, &distances);
        let unresolved = self.unresolved(&distances);

        let of_holes = self.of_holes(&functionals);

        let (best, _) = mass(&functionals.moments);
        let jacobian = derivatives(&functionals.moments);
        let beside_holes = covariance + of_holes * of_holes.transpose();
        let block = beside_holes.fixed_view::<INTEGRALS, INTEGRALS>(0, 0);
        let mut of_mass = jacobian * block * jacobian.transpose();
        if let Some(hidden) = hidden {
            of_mass += jacobian * hidden.covariance() * jacobian.transpose();
            of_mass[(0, 0)] += hidden.edges().powi(2);
        }
        of_mass += self.left(&jacobian, &distances, ONE_SIDED * unresolved);
        of_mass[(0, 0)] += self.ripples(unresolved).iter().map(|x| x * x).sum::<f64>();
        let texture = self.texture(&feet).max(self.hidden(&feet, best.area));
        of_mass[(0, 0)] += (0.5 * best.area * texture).powi(2);
        let errors = unlist(&of_mass.diagonal());
        let axes = &functionals.principal.axes;
        let inertia = of_mass.fixed_view::<6, 6>(INERTIA, INERTIA);
        let moments = Vector3::from_fn(|i, _| {
            let axis = axes.column(i).into_owned();
            let form = form(&axis, &axis);
            form.dot(&(inertia * form))
        });
        let lengths = Lengths {
            functions: self.functions,
            functionals: &functionals,
            covariance: &covariance,
            of_holes: &of_holes,
            jacobian: &jacobian,
            inertia: inertia.into_owned(),
            unresolved,
            hidden,
        };
        let dimensions = lengths.squares(&Ends::new(self.cloud, &feet, &distances, self.rms[0]));
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

    /// The places of a surface in the directions of the samples.
    fn feet(&self, surface: &Position) -> Vec<Vector3<f64>> {
        let found = surface.points_and_tangents(&self.cloud.directions);
        found.into_iter().map(|(foot, _)| foot).collect()
    }

    /// Distances of the samples from their feet, along the normals of the scan.
    fn distances(&self, feet: &[Vector3<f64>]) -> Vec<f64> {
        let samples = self.cloud.points.iter().zip(&self.cloud.normals);
        let distance = |((point, normal), foot): ((_, &Vector3<f64>), _)| {
            let point: &Vector3<f64> = point;
            normal.dot(&(point - foot))
        };
        samples.zip(feet).map(distance).collect()
    }

    /// Distances of held-out points over those of fitted ones.
    fn held_out(&self) -> f64 {
        (self.rms[1] / self.rms[0]).max(1.0)
    }

    /// Of the figures, by the errors of points.
    fn covariance(
        &self,
        functionals: &Functionals,
        distances: &[f64],
    ) -> SMatrix<f64, FIGURES, FIGURES> {
        let cloud = self.cloud;
        let mut solved = functionals.gradients(self.functions);
        self.factor.solve(&mut solved);
        let mut influences = vec![FigureVector::zeros(); cloud.points.len()];
        let mut add = |figure: usize, rows: &Rows| {
            let of_cell = |cell: u16| solved[usize::from(cell)].col_as_slice(figure);
            for (value, &member) in values(rows, of_cell).iter().zip(&rows.members) {
                let at = member as usize;
                let share = cloud.weights[at] * cloud.normals[at].dot(value);
                for (point, part) in cloud.points_of(at) {
                    influences[point][figure] += part * share * distances[at];
                }
            }
        };
        for rows in self.rows {
            (0..FIGURES).for_each(|figure| add(figure, rows));
        }
        let sum: SMatrix<f64, FIGURES, FIGURES> =
            influences.iter().map(|psi| psi * psi.transpose()).sum();
        sum * self.held_out().powi(2)
    }

    /// The changes of the figures by what holes between points without faces may hide.
    fn of_holes(&self, functionals: &Functionals) -> FigureVector {
        let cloud = self.cloud;
        if !cloud.is_of_points {
            return FigureVector::zeros();
        }
        let directions = &cloud.directions[cloud.vertices()..];
        let holes = Holes::new(directions, |n| self.surface.point(n));
        functionals.moved(|n| holes.hidden(n).0)
    }

    /// Squares and products of the changes of the figures if the surface moved to the samples, to those held out, to the
    /// vertices alone, or all of it to one side; `jacobian` leads from the integrals to the figures.
    fn left(
        &self,
        jacobian: &SMatrix<f64, INTEGRALS, INTEGRALS>,
        distances: &[f64],
        one_sided: f64,
    ) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
        let cloud = self.cloud;
        let without = self.distances(&self.feet(self.other));
        let areas = cloud.areas_of_points();
        let [
            mut fitted,
            mut by_area,
            mut even,
            mut held_out,
            mut at_vertices,
        ] = [SVector::zeros(); 5];
        let mut scatter = SMatrix::zeros();
        let mut weights = [0.0; 3];
        for at in (0..distances.len()).filter(|&at| cloud.is_scanned(at)) {
            let n = &cloud.directions[at];
            let change = jacobian * by_move(n, &self.surface.derivatives(n));
            if let Some(areas) = &areas {
                by_area += change * (areas[at] * distances[at]);
            }
            let change = change * cloud.weights[at];
            weights[0] += cloud.weights[at];
            fitted += change * distances[at];
            even += change;
            if at < cloud.vertices() {
                at_vertices += change * distances[at];
                weights[2] += cloud.weights[at];
            }
            if cloud.is_held_out(at) {
                let moved = change * without[at];
                weights[1] += cloud.weights[at];
                held_out += moved;
                scatter += moved * moved.transpose();
            }
        }
        let [all, some, vertices] = weights.map(|weight| cloud.area() / weight);
        let square = |x: SVector<f64, INTEGRALS>| x * x.transpose();
        let mut squares = square(fitted * (all * self.held_out()));
        squares += square(by_area * self.held_out());
        squares += square(even * (all * one_sided));
        if weights[2] > 0.0 {
            squares += square(at_vertices * vertices);
        }
        let beyond = (square(held_out) - scatter) * (some * some);
        for at in 0..INTEGRALS {
            squares[(at, at)] += beyond[(at, at)].max(0.0);
        }
        squares
    }

    /// Functions of which the roughness leaves the points to decide.
    fn told(&self) -> f64 {
        let root = self.roughness.sqrt();
        (root * self.functions.count() as f64).atan() / root
    }

    /// Root mean square of what functions between the points would still tell: by how much neighbours are off
    /// together, or held-out points are farther off than noise of the size of what is left would be.
    fn unresolved(&self, distances: &[f64]) -> f64 {
        let cloud = self.cloud;
        let points = (0..cloud.points.len()).filter(|&at| cloud.is_point(at));
        let (directions, distances): (Vec<_>, Vec<_>) = points
            .map(|at| (cloud.directions[at], distances[at]))
            .unzip();
        let near = Neighbours::new(&directions);
        let (mut squares, mut products) = (0.0, 0.0);
        for (own, n) in directions.iter().enumerate() {
            let other = near.nearest(n, 2).into_iter().find(|&other| other != own);
            squares += distances[own] * distances[own];
            products += distances[own] * distances[other.unwrap_or(own)];
        }
        let count = distances.len() as f64;
        let spent = (self.told() / count).min(MOST_SPENT);
        let together = (products + squares * spent) / count;
        let [fitted, held_out] = self.rms.map(|rms| rms * rms);
        let spent_without = spent / HELD_IN;
        let of_noise = fitted * (1.0 + spent_without) / (1.0 - spent);
        let scatter = held_out * (2.0 / ((1.0 - HELD_IN) * count)).sqrt();
        together.max(held_out - of_noise - scatter).max(0.0).sqrt()
    }

    /// The mean square of the slopes of texture between points.
    fn texture(&self, feet: &[Vector3<f64>]) -> f64 {
        let points = (0..feet.len()).filter(|&at| self.cloud.is_point(at));
        let off = points.map(|at| (feet[at], self.cloud.points[at] - feet[at]));
        let (feet, off): (Vec<_>, Vec<_>) = off.unzip();
        close_pairs::slopes(&feet, &off)
    }

    /// The same of points without faces, if texture goes on below what they resolve as the surface carries it there, as far as it
    /// may pass for noise. Of points on a lattice no close pairs tell.
    fn hidden(&self, feet: &[Vector3<f64>], area: f64) -> f64 {
        let cloud = self.cloud;
        if !cloud.is_of_points {
            return 0.0;
        }
        let points = (0..feet.len()).filter(|&at| cloud.is_point(at));
        let at: (Vec<_>, Vec<_>) = points.map(|at| (feet[at], cloud.normals[at])).unzip();
        let density = at.0.len() as f64 / area;
        let carried = finest::mean_square(&at.0, &at.1);
        carried.min(self.rms[1].powi(2)) * RESOLVED * 4.0 * PI * density
    }

    /// By what the area is larger for the ripples of noise, and smaller for those of the grain. A band of functions on an
    /// area S has 4 pi / S times their number as largest squared wavenumber, and half of it as mean.
    fn ripples(&self, unresolved: f64) -> [f64; 2] {
        let functions = self.functions.count() as f64;
        let followed = functions * functions / (1.0 + self.roughness * functions * functions);
        let points = self.cloud.scan_points() as f64;
        let noise = PI * self.rms[0] * self.rms[0] * followed / points;
        let rest = 2.0 * PI * unresolved * unresolved * self.told();
        [STEEPER_NOISE * noise, STEEPER_REST * rest]
    }
}

/// Share of the points that are not held out.
const HELD_IN: f64 = 1.0 - 1.0 / HELD_OUT as f64;

/// Largest share of the points' freedom that functions are taken to spend.
const MOST_SPENT: f64 = 0.7;
