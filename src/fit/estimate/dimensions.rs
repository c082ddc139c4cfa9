//! Length, width and thickness: extents along the principal axes, how they change with the coefficients, and
//! what ripples too fine to be told add to them.
//!
//! The extent along a unit axis a is h = a.(X+ - X-), X+ and X- the points that lie farthest along a and -a. To
//! first order these points move along the surface, which does not change h: what does is the change of the radius in
//! their fixed directions, and the [turn](crate::fit::outcome::turn) of the axis,
//!
//! ```text
//! dh = a.(dX+ - dX-) + (X+ - X-).da
//! ```
//!
//! A largest value over a surface with ripples exceeds that over their mean. With H the Hessian of the height a.X
//! over the directions and s the random slope of the ripples' height, by E[-s' H^-1 s / 2], at most by the standard
//! deviation of the ripples.

use super::cloud::Cloud;
use super::left_out::LeftOut;
use super::outcome::Estimate;
use super::vicinity::off_smooth;
use crate::farthest::Farthest;
use crate::fit::holes::Holes;
use crate::measure::support_near;
use crate::model::{Radial, StarSurface, Whole};
use nalgebra::{Matrix3, Vector3};

/// An extent.
pub(super) struct Extent {
    pub(super) length: f64,
    /// Along the axis and against it.
    pub(super) ends: [End; 2],
    /// X+ - X-.
    pub(super) span: Vector3<f64>,
}

/// An end of an extent.
pub(super) struct End {
    /// In the stretched space.
    pub(super) direction: Vector3<f64>,
    /// The change of the extent with the radius there, in the scan's unit per mean radius.
    pub(super) by_radius: f64,
    /// In the stretched space, in units of the mean.
    point: Vector3<f64>,
    height: f64,
    /// -H of the height over the tangent plane, beside a 1 along the direction.
    bowl: Matrix3<f64>,
    /// The share of the direction along the axis, and its gradient.
    along: f64,
    tilt: Vector3<f64>,
}

/// A surface whose extents are looked for.
pub(super) struct Reach {
    /// In the stretched space, in units of the mean.
    surface: Whole,
    stretch: Vector3<f64>,
    mean: f64,
    /// Directions in the stretched space, close enough to find the highest of several summits, and the points there.
    starts: (Vec<Vector3<f64>>, Farthest),
}

impl Reach {
    /// `starts` are directions and radii in the stretched space. `None` if the coefficients are not finite.
    pub(super) fn new(estimate: &Estimate, starts: &[(Vector3<f64>, f64)]) -> Option<Self> {
        Some(Self {
            surface: Whole::new(estimate.coefficients.clone()).ok()?,
            stretch: estimate.cloud.stretch,
            mean: estimate.cloud.mean,
            starts: (
                starts.iter().map(|(n, _)| *n).collect(),
                Farthest::new(starts.iter().map(|(n, r)| n * *r)),
            ),
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
            span: span.component_div(&self.stretch),
            ends,
        }
    }

    /// The end along `towards`; heights are multiplied by `scale`.
    fn end(&self, towards: &Vector3<f64>, scale: f64) -> End {
        let (directions, points) = &self.starts;
        let start = points.along(towards).map_or(towards, |at| &directions[at]);
        let found = support_near(&Radial(&self.surface), towards, start);
        let n = found.direction;
        let along = n.dot(towards);
        // Height f = r c, c = n.u: Hess f = c Hess r + grad r (grad c)' + grad c (grad r)' - c r P.
        let derivatives = self.surface.derivatives(&n);
        let across = Matrix3::identity() - n * n.transpose();
        let tilt = across * towards;
        let mixed = derivatives.gradient * tilt.transpose();
        let hessian = derivatives.hessian * along + mixed + mixed.transpose()
            - across * (along * derivatives.radius);
        End {
            direction: n,
            by_radius: scale * along,
            point: found.point,
            height: scale * found.point.dot(towards),
            // The direction itself is in the kernel of the Hessian.
            bowl: n * n.transpose() - hessian,
            along,
            tilt,
        }
    }
}

impl End {
    /// By how much the end lies above the highest point.
    pub(super) fn unseen(&self, cloud: &Cloud) -> f64 {
        let towards = self.towards();
        let points = cloud.directions.iter().zip(&cloud.radii);
        let heights = points.map(|(n, radius)| radius * n.dot(&towards));
        let highest = heights.fold(f64::NEG_INFINITY, f64::max);
        let unseen = self.point.dot(&towards) - highest;
        self.by_radius / self.along * unseen.max(0.0)
    }

    /// By how much the end lies off the smooth surface through the points nearest to it.
    pub(super) fn off_smooth(&self, cloud: &Cloud) -> f64 {
        let off = off_smooth(cloud, &self.point, &self.towards());
        self.by_radius / self.along * off
    }

    /// The axis, in the stretched space.
    pub(super) fn towards(&self) -> Vector3<f64> {
        self.direction * self.along + self.tilt
    }

    /// The share of the direction along the axis.
    pub(super) fn along(&self) -> f64 {
        self.along
    }

    /// By how much the extent is uncertain for what holes may hide.
    pub(super) fn hidden(&self, holes: &Holes) -> f64 {
        let towards = self.towards();
        let beyond = holes.beyond(&towards, self.point.dot(&towards));
        let own = holes.hidden(&self.direction).0 * self.by_radius;
        own.max(self.by_radius / self.along * beyond)
    }

    /// By how much the body may reach farther, where what is left of the points is no noise.
    pub(super) fn exceeded(&self, points: &LeftOut<'_>) -> f64 {
        let towards = self.towards();
        let beyond = points.beyond(&towards, self.point.dot(&towards));
        self.by_radius / self.along * beyond
    }

    /// By how much the mean of the height over the posterior exceeds the height of the mean, where radius and gradient
    /// have these variances.
    pub(super) fn excess(&self, value: f64, slope: f64) -> f64 {
        let n = &self.direction;
        let across = Matrix3::identity() - n * n.transpose();
        // Slopes of c dr: c grad dr + dr grad c.
        let slopes = across * (0.5 * slope * self.along * self.along)
            + self.tilt * self.tilt.transpose() * value;
        let sd = value.sqrt() * self.along;
        let rise = self.bowl.try_inverse();
        let rise = rise.map_or(sd, |bowl| 0.5 * (bowl * slopes).trace());
        self.by_radius / self.along * if (0.0..sd).contains(&rise) { rise } else { sd }
    }
}
