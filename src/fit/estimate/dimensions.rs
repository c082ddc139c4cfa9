//! Length, width and thickness: extents along the principal axes, how they change with the coefficients, and
//! what ripples too fine to be told add to them.
//!
//! The extent along a unit axis a is h = a.(X+ - X-), X+ and X- the points that lie farthest along a and -a. To
//! first order these points move along the surface, which does not change h: what does is the change of the radius in
//! their fixed directions, and the turn of the axis,
//!
//! ```text
//! dh = a.(dX+ - dX-) + (X+ - X-).da,     da_i = sum over j of a_j (a_j' dI a_i) / (I_i - I_j)
//! ```
//!
//! but for j with nearly the same moment. Such axes have no direction of their own: there, the extents in the plane
//! of both are compared.
//!
//! A largest value over a surface with ripples exceeds that over their mean. With H the Hessian of the height a.X
//! over the directions and s the random slope of the ripples' height, by E[-s' H^-1 s / 2], at most by the standard
//! deviation of the ripples.

use super::figures::form;
use super::{Estimate, slope_variance, variance};
use crate::measure::{PrincipalInertia, support_near};
use crate::model::{StarSurface, Whole};
use crate::sphere::HarmonicBasis;
use nalgebra::{Matrix3, SVector, Vector3};
use std::f64::consts::PI;

/// Axes whose turn has a larger standard deviation (in radians) have no direction of their own.
const LARGEST_TURN: f64 = 0.2;

/// Steps of half a turn at which the extents along such axes are compared.
const TURNS: usize = 8;

/// An extent.
pub(super) struct Extent {
    pub(super) length: f64,
    /// By how much the mean of the extent over the posterior exceeds that of the mean.
    pub(super) excess: f64,
    /// Directions of the two ends in the stretched space, and the change of the extent with the radius there.
    ends: [(Vector3<f64>, f64); 2],
    /// X+ - X-.
    span: Vector3<f64>,
}

/// A surface whose extents are looked for.
pub(super) struct Reach {
    /// In the stretched space, in units of the mean.
    surface: Whole,
    stretch: Vector3<f64>,
    mean: f64,
    /// Directions and radii in the stretched space, close enough to find the highest of several summits.
    starts: Vec<(Vector3<f64>, f64)>,
    /// Posterior variances of the radius and of its gradient.
    ripples: [f64; 2],
}

impl Reach {
    /// `None` if the coefficients are not finite.
    pub(super) fn new(estimate: &Estimate, starts: Vec<(Vector3<f64>, f64)>) -> Option<Self> {
        Some(Self {
            surface: Whole::new(estimate.coefficients.clone()).ok()?,
            stretch: estimate.cloud.stretch,
            mean: estimate.cloud.mean,
            starts,
            ripples: [
                variance(&estimate.spectrum, &estimate.unlearnt),
                slope_variance(&estimate.spectrum, &estimate.unlearnt),
            ],
        })
    }

    /// The extent along a unit vector.
    pub(super) fn along(&self, axis: &Vector3<f64>) -> Extent {
        let ends = [1.0, -1.0].map(|sign| {
            // a.T^-1 x is largest where x lies farthest along T^-1 a.
            let mapped = axis.component_div(&self.stretch) * sign;
            self.end(&mapped.normalize(), mapped.norm() * self.mean)
        });
        let [high, low] = &ends;
        let span = (high.point - low.point) * self.mean;
        Extent {
            length: high.height + low.height,
            excess: high.excess + low.excess,
            span: span.component_div(&self.stretch),
            ends: ends.map(|end| (end.direction, end.by_radius)),
        }
    }

    /// The mean square of the change of the extent along principal axis `i` when it turns anywhere in the planes
    /// of those axes that cannot be told from it.
    pub(super) fn turned(
        &self,
        principal: &PrincipalInertia,
        i: usize,
        length: f64,
        sd: impl Fn(usize, usize) -> f64,
    ) -> f64 {
        let axis = principal.axes.column(i);
        let alike = (0..3).filter(|&j| j != i && !is_told(principal, i, j, &sd));
        let changes = alike.flat_map(|j| {
            let other = principal.axes.column(j);
            (1..TURNS).map(move |turn| {
                let (sin, cos) = (turn as f64 * PI / TURNS as f64).sin_cos();
                self.along(&(axis * cos + other * sin)).length - length
            })
        });
        let squares: Vec<f64> = changes.map(|change| change * change).collect();
        squares.iter().sum::<f64>() / squares.len().max(1) as f64
    }

    /// The end along `towards`; heights are multiplied by `scale`.
    fn end(&self, towards: &Vector3<f64>, scale: f64) -> End {
        let [value, slope] = self.ripples;
        let highest = self
            .starts
            .iter()
            .max_by(|(n, r), (q, s)| (r * n.dot(towards)).total_cmp(&(s * q.dot(towards))));
        let start = highest.map_or(*towards, |(n, _)| *n);
        let found = support_near(&self.surface, towards, &start);
        let n = found.direction;
        let along = n.dot(towards);
        // Height f = r c, c = n.u: Hess f = c Hess r + grad r (grad c)' + grad c (grad r)' - c r P.
        let derivatives = self.surface.derivatives(&n);
        let across = Matrix3::identity() - n * n.transpose();
        let tilt = across * towards;
        let mixed = derivatives.gradient * tilt.transpose();
        let hessian = derivatives.hessian * along + mixed + mixed.transpose()
            - across * (along * derivatives.radius);
        // Slopes of c dr: c grad dr + dr grad c.
        let slopes = across * (0.5 * slope * along * along) + tilt * tilt.transpose() * value;
        let sd = value.sqrt() * along;
        // The direction itself is in the kernel of all of these.
        let bowl = (n * n.transpose() - hessian).try_inverse();
        let rise = bowl.map_or(sd, |bowl| 0.5 * (bowl * slopes).trace());
        End {
            direction: n,
            point: found.point,
            height: scale * found.point.dot(towards),
            by_radius: scale * along,
            excess: scale * if (0.0..sd).contains(&rise) { rise } else { sd },
        }
    }
}

struct End {
    direction: Vector3<f64>,
    /// In the stretched space, in units of the mean.
    point: Vector3<f64>,
    height: f64,
    by_radius: f64,
    excess: f64,
}

impl Extent {
    /// Adds the derivatives by the coefficients at fixed axes to `gradient`.
    pub(super) fn add_gradient(&self, basis: &HarmonicBasis, gradient: &mut [f64]) {
        let mut harmonics = vec![0.0; gradient.len()];
        for (n, by_radius) in &self.ends {
            basis.evaluate(n, &mut harmonics);
            for (gradient, harmonic) in gradient.iter_mut().zip(&harmonics) {
                *gradient += by_radius * harmonic;
            }
        }
    }

    /// The derivative by the inertia tensor, through axis `i`; `sd` says how well an off-diagonal entry is known
    /// along the principal axes.
    pub(super) fn by_inertia(
        &self,
        principal: &PrincipalInertia,
        i: usize,
        sd: impl Fn(usize, usize) -> f64,
    ) -> SVector<f64, 6> {
        let PrincipalInertia { moments, axes } = principal;
        let column = |j: usize| axes.column(j).into_owned();
        let told = (0..3).filter(|&j| j != i && is_told(principal, i, j, &sd));
        told.map(|j| {
            let factor = self.span.dot(&column(j)) / (moments[i] - moments[j]);
            form(&column(j), &column(i)) * factor
        })
        .sum()
    }
}

/// Whether two principal axes are told apart.
fn is_told(
    principal: &PrincipalInertia,
    i: usize,
    j: usize,
    sd: impl Fn(usize, usize) -> f64,
) -> bool {
    sd(i, j) < LARGEST_TURN * (principal.moments[i] - principal.moments[j]).abs()
}
