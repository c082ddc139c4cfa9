//! How well length, width and thickness are known.
//!
//! To first order by the covariances of the radii at their ends and of the inertia tensor that turns their axes.
//! Beyond it, allowances, as squares:
//!
//! - half of the excess of a largest value, by the variance at the end itself, for a scan may be thinner there;
//! - what [ripples](super::plateau) have raised the ends of flat sides by, at both of them;
//! - what the estimate [flattens](super::flattened) of beaks and tips at the ends;
//! - how far the points leave a [wide bump](super::tips) open at each of them;
//! - what the largest [holes](crate::fit::holes) may hide, at the end itself or where the body may reach farther;
//! - a share of what the surface has above the highest point, which the prior alone has drawn: of clean grains with a point of
//!   half the points' spacing it is some 5 % wrong;
//! - by how much the ends lie off the smooth surface through the [points nearest to them](super::vicinity), or, where residuals are no
//!   noise, by how much these are missed when they are [left out](super::left_out), or by how much farther the body may reach,
//!   whichever is most;
//! - what turning an axis by its standard deviation does to the extent beyond first order (of a box it grows whichever
//!   way it turns), and the range of extents in the plane of two axes that are not told apart.

use super::dimensions::{End, Extent, Reach};
use super::flattened::Flattened;
use super::functionals::combined;
use super::left_out::LeftOut;
use super::outcome::Estimate;
use super::outcome::{slope_variance, variance};
use super::plateau::Plateau;
use super::posterior::Conditioned;
use super::tips::Tips;
use crate::fit::holes::Holes;
use crate::fit::outcome::figures::{INERTIA, by_size, squares_by_size};
use crate::fit::outcome::turn::{OF_RANGE, TURNS, by_inertia};
use crate::measure::{PrincipalInertia, are_apart};
use crate::sphere::HarmonicBasis;
use crate::vectorize::dot;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Share of what lies above the highest point that may be wrong.
const OF_UNSEEN: f64 = 0.1;

/// Length, width and thickness, with their errors.
pub(super) struct Dimensions {
    pub(super) lengths: Vector3<f64>,
    /// With the allowances.
    pub(super) variances: Vector3<f64>,
    pub(super) excess: Vector3<f64>,
}

/// `mass` are the gradients of area, volume, centroid and inertia, `covariances` theirs with all coefficients, and `sd`
/// tells how well an entry of the inertia tensor is known along the principal axes; `left_out` are the points where
/// residuals are no noise, `holes` those that are no chance.
pub(super) fn dimensions(
    estimate: &Estimate,
    given: &Conditioned<'_>,
    (reach, plateau, flat): (&Reach, &Plateau<'_>, &Flattened<'_>),
    principal: &PrincipalInertia,
    (mass, covariances): (&[Vec<f64>], &[Vec<f64>]),
    sd: impl Fn(usize, usize) -> f64,
    (left_out, holes): (Option<&LeftOut<'_>>, &Holes),
) -> Dimensions {
    let extents: [Extent; 3] = [0, 1, 2].map(|i| reach.along(&principal.axes.column(i).into()));
    let basis = HarmonicBasis::new(estimate.degree);
    let harmonics = |end: &End| {
        let mut harmonics = vec![0.0; estimate.coefficients.len()];
        basis.evaluate(&end.direction, &mut harmonics);
        harmonics
    };
    let ends: Vec<Vec<f64>> = extents
        .iter()
        .flat_map(|e| &e.ends)
        .map(harmonics)
        .collect();
    let solved = given.covariances(&ends);
    // Slopes are larger where radii are less well known.
    let usual = variance(&estimate.spectrum, &estimate.unlearnt);
    let slope_per_value = slope_variance(&estimate.spectrum, &estimate.unlearnt) / usual;
    let tips = Tips::new(estimate, given.posterior);

    let mut found = Dimensions {
        lengths: Vector3::from_fn(|i, _| extents[i].length),
        variances: Vector3::zeros(),
        excess: Vector3::zeros(),
    };
    for (i, extent) in extents.iter().enumerate() {
        let factors = extent.ends.iter().map(|end| end.by_radius);
        let turn = by_inertia(principal, i, &extent.span, &sd);
        let factors: Vec<f64> = factors.chain(turn.iter().copied()).collect();
        let whole = |ends: &[Vec<f64>], mass: &[Vec<f64>]| {
            let vectors = ends[2 * i..2 * i + 2].iter().chain(&mass[INERTIA..]);
            combined(vectors, factors.iter())
        };
        let mut squares = dot(&whole(&ends, mass), &whole(&solved, covariances)).max(0.0);
        let (mut flattened, mut raised) = (0.0, 0.0);
        for (at, end) in (2 * i..).zip(&extent.ends) {
            let value = dot(&ends[at], &solved[at]).max(0.0);
            found.excess[i] += end.excess(value, slope_per_value * value);
            let odds = (value / usual).max(1.0);
            flattened += flat.of_radius(&ends[at], odds) * end.by_radius;
            let [_, wide] = tips.likeliest_and_widest(&end.direction);
            squares += wide.variance * end.by_radius * end.by_radius;
            squares += (OF_UNSEEN * end.unseen(&estimate.cloud)).powi(2);
            squares += end.hidden(holes).powi(2);
            raised += plateau.rise(end, value);
            let off = end.off_smooth(&estimate.cloud).powi(2);
            squares += left_out.map_or(off, |points| {
                let missed = points.near(&end.direction) * end.by_radius * end.by_radius;
                missed.max(end.exceeded(points).powi(2)).max(off)
            });
        }
        squares += flattened * flattened + raised * raised;
        squares += (0.5 * found.excess[i]).powi(2);
        squares += turned(reach, principal, i, extent.length, &sd);
        found.variances[i] = squares;
    }
    let order = by_size(&found.lengths);
    let ordered = |of: &Vector3<f64>| Vector3::from(order.map(|i| of[i]));
    Dimensions {
        lengths: ordered(&found.lengths),
        variances: squares_by_size(&found.lengths, &found.variances),
        excess: ordered(&found.excess),
    }
}

/// Square of what turns of the principal axis `i` do to the extent along it, but for the first order.
fn turned(
    reach: &Reach,
    principal: &PrincipalInertia,
    i: usize,
    length: f64,
    sd: impl Fn(usize, usize) -> f64,
) -> f64 {
    let PrincipalInertia { moments, axes } = principal;
    let others = (0..3).filter(|&j| j != i);
    let squares = others.map(|j| {
        let at = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let axis = axes.column(i) * cos + axes.column(j) * sin;
            reach.along(&axis).length
        };
        let (sd, gap) = (sd(i, j), (moments[i] - moments[j]).abs());
        if are_apart(sd, gap) {
            let turn = sd / gap;
            return (0.5 * (at(turn) + at(-turn)) - length).powi(2);
        }
        let lengths = (1..TURNS).map(|turn| at(turn as f64 * PI / TURNS as f64));
        let (least, most) = lengths.fold((length, length), |(least, most), length| {
            (length.min(least), length.max(most))
        });
        (OF_RANGE * (most - least)).powi(2)
    });
    squares.sum()
}
