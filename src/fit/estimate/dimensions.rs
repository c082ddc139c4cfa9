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
//! where j with nearly the same moment are left out: such axes have no direction of their own.
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

/// Axes whose turn has a larger standard deviation (in radians) have no direction of their own.
const LARGEST_TURN: f64 = 0.2;

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

/// Extents along the principal axes. `starts` are directions and radii in the stretched space, close enough to find
/// the highest of several summits.
pub(super) fn extents(
    estimate: &Estimate,
    axes: &Matrix3<f64>,
    starts: &[(Vector3<f64>, f64)],
) -> Option<[Extent; 3]> {
    let surface = Whole::new(estimate.coefficients.clone()).ok()?;
    let value = variance(&estimate.spectrum, &estimate.unlearnt);
    let slope = slope_variance(&estimate.spectrum, &estimate.unlearnt);
    Some(std::array::from_fn(|i| {
        let axis = axes.column(i).into_owned();
        let ends = [1.0, -1.0].map(|sign| {
            // a.T^-1 x is largest where x lies farthest along T^-1 a.
            let mapped = axis.component_div(&estimate.cloud.stretch) * sign;
            let scale = mapped.norm() * estimate.cloud.mean;
            End::new(&surface, &mapped.normalize(), scale, starts, [value, slope])
        });
        let [high, low] = &ends;
        let span = (high.point - low.point) * estimate.cloud.mean;
        Extent {
            length: high.height + low.height,
            excess: high.excess + low.excess,
            span: span.component_div(&estimate.cloud.stretch),
            ends: ends.map(|end| (end.direction, end.by_radius)),
        }
    }))
}

struct End {
    direction: Vector3<f64>,
    /// In the stretched space, in units of the mean.
    point: Vector3<f64>,
    height: f64,
    by_radius: f64,
    excess: f64,
}

impl End {
    /// The end along `towards`; heights are multiplied by `scale`.
    fn new(
        surface: &Whole,
        towards: &Vector3<f64>,
        scale: f64,
        starts: &[(Vector3<f64>, f64)],
        [value, slope]: [f64; 2],
    ) -> Self {
        let highest = starts
            .iter()
            .max_by(|(n, r), (q, s)| (r * n.dot(towards)).total_cmp(&(s * q.dot(towards))));
        let start = highest.map_or(*towards, |(n, _)| *n);
        let found = support_near(surface, towards, &start);
        let n = found.direction;
        let along = n.dot(towards);
        // Height f = r c, c = n.u: Hess f = c Hess r + grad r (grad c)' + grad c (grad r)' - c r P.
        let derivatives = surface.derivatives(&n);
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
        Self {
            direction: n,
            point: found.point,
            height: scale * found.point.dot(towards),
            by_radius: scale * along,
            excess: scale * if (0.0..sd).contains(&rise) { rise } else { sd },
        }
    }
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
        let others = (0..3).filter(|&j| j != i);
        others
            .filter(|&j| sd(i, j) < LARGEST_TURN * (moments[i] - moments[j]).abs())
            .map(|j| {
                let factor = self.span.dot(&column(j)) / (moments[i] - moments[j]);
                form(&column(j), &column(i)) * factor
            })
            .sum()
    }
}
