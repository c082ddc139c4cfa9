//! How well the curvature of a grain is known.
//!
//! The curvature of a surface is off by that of the difference between it and the estimate, which is known, and by that
//! of the estimate's own error. Where a surface moves by h along its normal, its curvature tensor changes by the second
//! derivatives of h. Of an error that is alike everywhere in the stretched space, with variances C_l of the
//! coefficients, the second derivatives of the radius there are normal with
//!
//! ```text
//! <H_ij H_kl> = (d_ij d_kl + d_ik d_jl + d_il d_jk) k / 8,   k = sum (2l + 1) (l (l + 1))² C_l / 4 pi
//! ```
//!
//! A step along the unit tangent t of the plain surface turns the stretched direction n' by A t, and a change of the
//! stretched radius by d moves the surface along its normal N by f d:
//!
//! ```text
//! A = (1 - n' n'') T / (m r'),   f = m N.T^-1 n',   <|A' H A|²> = (2 tr G² + (tr G)²) k / 8,   G = A'A
//! ```
//!
//! with n'' the transpose of n', radii r' in units of their mean m. Multiplied with how much worse or better than noise the
//! nearest points are met.

use super::outcome::{Estimate, bending_variance, spare};
use crate::fit::curvature_cells::{PER_CELL, directions, errors, tensor};
use crate::fit::neighbours::Neighbours;
use crate::measure::Curvature;
use crate::model::{CurvatureErrors, Family, StarGrain, Surface, SurfaceJet};
use crate::sphere::CubeCell;
use nalgebra::{Matrix2, Vector3};

/// Least error as a share of the curvature: of clean ellipsoids it is off by 5e-6.
const FLOOR: f64 = 1e-5;

/// Points near by that tell how well the surface is met there.
const VICINITY: usize = 40;

impl Estimate {
    /// Standard errors of the curvature of a grain that stands for the estimate; none where edges hide them.
    pub(crate) fn curvature_errors(&self, grain: &StarGrain) -> Option<CurvatureErrors> {
        if self.hides_edges(self.is_rough()) {
            return None;
        }
        let frame = grain.frame();
        let expansion = Family::Whole(self.expansion(self.degree));
        let best = StarGrain::stretched(frame, self.stretch(), expansion).ok()?;
        let neighbours = Neighbours::new(&self.cloud.directions);
        let misfits = self.misfits();
        let bending = bending_variance(&self.spectrum, &self.unlearnt);
        let misfit = |n: &Vector3<f64>| {
            let near = neighbours.nearest(&self.stretched(n).normalize(), VICINITY);
            near.iter().map(|&i| misfits[i]).sum::<f64>() / near.len().max(1) as f64
        };
        let square = |n: &Vector3<f64>, best: &SurfaceJet, told: &SurfaceJet, misfit: f64| {
            let towards = frame.axes * n;
            let curvature = Curvature::new(&towards, best);
            let exact = tensor(&curvature);
            let told = tensor(&Curvature::new(&towards, told));
            let difference = (told - exact).norm_squared();
            let rounding = FLOOR * FLOOR * exact.norm_squared();
            let local = [0, 1].map(|i| frame.axes.tr_mul(&curvature.directions[i]));
            let normal = frame.axes.tr_mul(&curvature.normal);
            let bend = self.bend(n, best.place.norm(), &normal, local);
            difference + rounding + misfit * bending * bend
        };
        let cells = CubeCell::uniform(CurvatureErrors::PARTS);
        let directions = directions();
        let towards: Vec<Vector3<f64>> = directions.iter().map(|n| frame.axes * n).collect();
        let jets = best.jets(&towards).into_iter().zip(grain.jets(&towards));
        let misfits = cells.iter().map(|cell| misfit(&cell.at(0.5, 0.5)));
        let misfits = misfits.flat_map(|misfit| std::iter::repeat_n(misfit, PER_CELL));
        let known = directions.iter().zip(jets).zip(misfits);
        let squares = known.map(|((n, (best, told)), misfit)| square(n, &best, &told, misfit));
        errors(&squares.collect::<Vec<f64>>())
    }

    /// T n.
    fn stretched(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.cloud.stretch.component_mul(n)
    }

    /// f² (2 tr G² + (tr G)²) / 8 where the plain surface, in the direction n, has a radius, a normal and orthogonal
    /// unit tangents.
    fn bend(
        &self,
        n: &Vector3<f64>,
        radius: f64,
        normal: &Vector3<f64>,
        tangents: [Vector3<f64>; 2],
    ) -> f64 {
        let mapped = self.stretched(n);
        let unit = mapped.normalize();
        let move_along = self.cloud.mean * normal.dot(&unit.component_div(&self.cloud.stretch));
        let [first, second] = tangents.map(|t| {
            let moved = self.stretched(&t);
            (moved - unit * unit.dot(&moved)) / (radius * mapped.norm())
        });
        let across = first.dot(&second);
        let gram = Matrix2::new(first.norm_squared(), across, across, second.norm_squared());
        move_along.powi(2) * (2.0 * gram.norm_squared() + gram.trace().powi(2)) / 8.0
    }

    /// Squares of the points' residuals over what noise leaves of them.
    fn misfits(&self) -> Vec<f64> {
        let residuals = self.posterior().residuals(&self.coefficients);
        let spare = spare(&self.unlearnt, self.cloud.len() as f64);
        let expected = self.spectrum.noise().powi(2) * spare;
        let weighted = residuals.iter().zip(&self.cloud.weights);
        weighted.map(|(e, w)| w * e * e / expected).collect()
    }
}

#[cfg(test)]
mod tests;
