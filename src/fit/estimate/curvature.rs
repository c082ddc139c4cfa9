//! How well the surface of a grain is known from place to place.
//!
//! Where it is, is off by the [error of its radius](super::local) and, as squares, by what the prior took where the body may end, by a bump that is [missing](super::tips) and
//! no chance, by what the points leave open of a wide one, by what a [hole](crate::fit::holes) may hide, and where residuals are no noise by how much the points near by are missed
//! when they are [left out](super::left_out).
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
//! with n'' the transpose of n', radii r' in units of their mean m. k is larger where the radius is less well known, in
//! proportion. Where the nearest points are [met](super::local) worse than noise is, both errors are as much larger, but not
//! smaller where they are met better: on the tips of a needle noise is small, and the few points there are weighed against the
//! prior as if it were not. The prior, which is the same everywhere, also takes tips for noise: where the curvature of what the
//! points tell without it differs by more than that, it is off by so much. A bump bends all directions alike, H = -a k of its
//! height and sharpness: one that is missing, and the widest as far as points near by leave its height open, for which the
//! prior, alike everywhere, leaves no room.

use super::left_out::LeftOut;
use super::outcome::{Estimate, bending_variance, variance};
use super::posterior::Posterior;
use super::tips::{Missing, Tips};
use super::unresolved::is_rough;
use crate::fit::outcome::local_cells::{PER_CELL, Squares, directions, tensor};
use crate::measure::Curvature;
use crate::model::{Family, LocalErrors, StarGrain, Surface, SurfaceJet};
use crate::sphere::CubeCell;
use nalgebra::{Matrix2, Vector3};
use rayon::prelude::*;

/// Least error as a share of the curvature, and of the radius: of clean ellipsoids they are off by 5e-6 and 1e-6.
const FLOOR: f64 = 1e-5;

/// Parts of a cube's edge in cells that bumps are wider than: each holds four of those of [`LocalErrors`].
const WIDE_PARTS: u16 = LocalErrors::PARTS / 2;
const PER_WIDE_CELL: f64 = 4.0 * PER_CELL as f64;

/// Cosine of the angle to a principal axis up to which a body may end there: where it ends is then told no better than by the
/// errors of its dimensions, of which what the pull of the prior takes is a part.
const NEAR_END: f64 = 0.96;

impl Estimate {
    /// Squares of the errors of a grain that stands for the estimate, in the [directions] of cells; none where edges hide
    /// them.
    pub(in crate::fit) fn local_errors(&self, grain: &StarGrain) -> Option<Vec<Squares>> {
        let posterior = self.posterior();
        let residuals = posterior.residuals(&self.coefficients);
        let is_rough = is_rough(&self.cloud.of_mean_weight(&residuals));
        if self.hides_edges(is_rough) {
            return None;
        }
        let frame = grain.frame();
        let expansion = Family::Whole(self.expansion(self.degree));
        let best = StarGrain::stretched(frame, self.stretch(), expansion).ok()?;
        let places = directions();
        let local: Vec<Vector3<f64>> = places.iter().map(|n| self.plain(n)).collect();
        let towards: Vec<Vector3<f64>> = local.iter().map(|n| frame.axes * n).collect();
        let unshrunk = Family::Whole(self.unshrunk());
        let unshrunk = StarGrain::stretched(frame, self.stretch(), unshrunk).ok()?;
        let jets = best.jets(&towards).into_iter().zip(grain.jets(&towards));
        let jets: Vec<_> = jets.zip(unshrunk.jets(&towards)).collect();
        // What is smooth is taken once in a cell; how far the grain is from the estimate is not.
        let cells = CubeCell::uniform(LocalErrors::PARTS);
        let middles: Vec<Vector3<f64>> = cells.iter().map(CubeCell::middle).collect();
        let wide = |cell: usize| CubeCell::position(WIDE_PARTS, &middles[cell]);
        let apart = |at: usize| {
            let ((best, told), _) = &jets[at];
            (told.place.norm() - best.place.norm()).powi(2)
        };
        let mut apart_around = vec![0.0; CubeCell::uniform(WIDE_PARTS).len()];
        for at in 0..jets.len() {
            apart_around[wide(at / PER_CELL)] += apart(at) / PER_WIDE_CELL;
        }
        let plain: Vec<Vector3<f64>> = middles.iter().map(|n| self.plain(n)).collect();
        let locals = self.locals(&plain, |given, middles| {
            given.cell_variances(middles, &places, PER_CELL)
        });
        let unexpected = self.unexpected(&posterior);
        let left_out = is_rough.then(|| LeftOut::new(self, &posterior, &residuals, true));
        let beside = self.beside(left_out.as_ref(), &plain);
        // Second derivatives are larger where radii are less well known.
        let bending_per_value = bending_variance(&self.spectrum, &self.unlearnt)
            / variance(&self.spectrum, &self.unlearnt);
        let square = |at: usize, best: &SurfaceJet, told: &SurfaceJet, unshrunk: &SurfaceJet| {
            let (n, cell) = (&local[at], at / PER_CELL);
            let known = &locals[cell];
            let [height, bump] = unexpected[wide(cell)];
            let curvature = Curvature::new(&towards[at], best);
            let exact = tensor(&curvature);
            // By chance the grain may cross the estimate in all places of a cell.
            let apart = apart(at).max(apart_around[wide(cell)]);
            let told = tensor(&Curvature::new(&towards[at], told));
            let difference = (told - exact).norm_squared();
            let pulled = tensor(&Curvature::new(&towards[at], unshrunk));
            let shrunk = (pulled - exact).norm_squared();
            let rounding = FLOOR * FLOOR * exact.norm_squared();
            let [first, second] = [0, 1].map(|i| frame.axes.tr_mul(&curvature.directions[i]));
            let normal = frame.axes.tr_mul(&curvature.normal);
            let bend = self.bend(n, best.place.norm(), &normal, [first, second]);
            let bending = known.variance_at_least() * bending_per_value;
            let unknown = known.variance_at_least() + beside[cell] + height;
            let taken = match n.amax() > NEAR_END {
                true => unshrunk.place.norm() - best.place.norm(),
                false => 0.0,
            };
            let radius = apart + taken.powi(2) + unknown * known.scale.powi(2);
            let rounding_of_place = (FLOOR * best.place.norm()).powi(2);
            Squares {
                place: (radius + rounding_of_place) * normal.dot(n).powi(2),
                curvature: difference
                    + rounding
                    + (bending * bend.of_noise()).max(shrunk)
                    + bump * bend.of_bump(),
            }
        };
        let jets = jets.iter().enumerate();
        Some(
            jets.map(|(at, ((best, told), unshrunk))| square(at, best, told, unshrunk))
                .collect(),
        )
    }

    /// Squares of the height, and of the bend, of what the prior does not expect: in cells of [`WIDE_PARTS`].
    fn unexpected(&self, posterior: &Posterior<'_>) -> Vec<[f64; 2]> {
        let tips = Tips::new(self, posterior);
        let in_cell = |cell: &CubeCell| {
            let middle = cell.middle();
            let [likeliest, widest] = tips.likeliest_and_widest(&middle);
            let told = match likeliest.is_no_chance() {
                true => likeliest,
                false => Missing::default(),
            };
            let height = told.height.powi(2);
            let chance = widest.variance;
            [
                height + told.variance + chance,
                height * told.sharpness.powi(2) + chance * widest.sharpness.powi(2),
            ]
        };
        let cells = CubeCell::uniform(WIDE_PARTS);
        cells.par_iter().map(in_cell).collect()
    }

    /// Squares of what a hole may hide of the radius of the stretched space and, where residuals are no noise, of how far
    /// points are missed, in directions of the grain's own frame.
    fn beside(&self, left_out: Option<&LeftOut<'_>>, local: &[Vector3<f64>]) -> Vec<f64> {
        let holes = self.holes();
        let beside = |n: &Vector3<f64>| {
            let n = self.stretched(n).normalize();
            let missed = left_out.map_or(0.0, |points| points.near(&n));
            let hidden = holes.hidden(&n).0;
            missed + hidden * hidden
        };
        local.iter().map(beside).collect()
    }

    /// T^-1 n', of unit length.
    fn plain(&self, stretched: &Vector3<f64>) -> Vector3<f64> {
        stretched.component_div(&self.cloud.stretch).normalize()
    }

    /// What second derivatives of the stretched radius bend where the plain surface, in the direction n, has a radius, a
    /// normal and orthogonal unit tangents.
    fn bend(
        &self,
        n: &Vector3<f64>,
        radius: f64,
        normal: &Vector3<f64>,
        tangents: [Vector3<f64>; 2],
    ) -> Bend {
        let mapped = self.stretched(n);
        let unit = mapped.normalize();
        let [first, second] = tangents.map(|t| {
            let moved = self.stretched(&t);
            (moved - unit * unit.dot(&moved)) / (radius * mapped.norm())
        });
        let across = first.dot(&second);
        Bend {
            move_along: self.cloud.mean * normal.dot(&unit.component_div(&self.cloud.stretch)),
            gram: Matrix2::new(first.norm_squared(), across, across, second.norm_squared()),
        }
    }
}

/// f and G.
struct Bend {
    move_along: f64,
    gram: Matrix2<f64>,
}

impl Bend {
    /// f² (2 tr G² + (tr G)²) / 8
    fn of_noise(&self) -> f64 {
        let squares = 2.0 * self.gram.norm_squared() + self.gram.trace().powi(2);
        self.move_along.powi(2) * squares / 8.0
    }

    /// f² tr G², of second derivatives that are one in all directions.
    fn of_bump(&self) -> f64 {
        self.move_along.powi(2) * self.gram.norm_squared()
    }
}

#[cfg(test)]
mod tests;
