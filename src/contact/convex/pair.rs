//! Two superquadrics: their gauges and supports as seen from the first.

use crate::model::{Frame, Superquadric};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};

/// Two superquadrics that may touch.
///
/// ```
/// use grainform::contact::{ConvexPair, ConvexStatus};
/// use grainform::model::{Frame, Superquadric};
/// use grainform::nalgebra::{Matrix3, Point3};
///
/// let sphere = Superquadric::single([1.0; 3], 2.0, 2.0)?;
/// let at = |x| Frame { centre: Point3::new(x, 0.0, 0.0), axes: Matrix3::identity() };
/// let (here, there) = (at(0.0), at(1.9));
/// let pair = ConvexPair::new((&sphere, &here), (&sphere, &there));
/// let contact = pair.contact(None);
/// assert_eq!(contact.status, ConvexStatus::Touching);
/// assert!((pair.overlap(&contact) - 0.1).abs() < 1e-6);
/// # Ok::<(), grainform::model::InvalidSuperquadric>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ConvexPair<'a> {
    pub(super) first: &'a Superquadric,
    pub(super) second: &'a Superquadric,
    /// The first body's frame, in which all is computed.
    pub(super) frame: &'a Frame,
    /// The second body's axes in the first's frame.
    pub(super) turn: Matrix3<f64>,
    /// The second body's centre in the first's frame.
    pub(super) offset: Vector3<f64>,
}

/// What a method found, in the first body's frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) point: Vector3<f64>,
    pub(super) normal: Vector3<f64>,
    pub(super) upper: f64,
    pub(super) lower: f64,
    pub(super) iterations: usize,
    /// Whether the method came to an end by its own measure.
    pub(super) is_settled: bool,
}

impl Found {
    /// Where every method begins: the direction of the centres, and nothing known.
    pub(super) fn start(pair: &ConvexPair<'_>, point: Vector3<f64>) -> Self {
        Self {
            point,
            normal: pair.offset.try_normalize(0.0).unwrap_or(Vector3::x()),
            upper: f64::INFINITY,
            lower: 0.0,
            iterations: 0,
            is_settled: false,
        }
    }

    pub(super) fn gap(&self) -> f64 {
        match self.upper > 0.0 {
            true => (self.upper - self.lower) / self.upper,
            false => 0.0,
        }
    }
}

/// When the ratio is known well enough.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    /// Relative gap between its bounds.
    pub(super) gap: f64,
    /// Whether it is enough to know that it is above one.
    pub(super) may_stop_apart: bool,
}

impl Goal {
    #[inline]
    pub(super) fn is_met(&self, found: &Found) -> bool {
        found.gap() <= self.gap || (self.may_stop_apart && found.lower > 1.0)
    }
}

impl<'a> ConvexPair<'a> {
    /// Two bodies, each with its frame; both frames are of the same space.
    #[inline]
    pub fn new(
        (first, frame): (&'a Superquadric, &'a Frame),
        (second, other): (&'a Superquadric, &'a Frame),
    ) -> Self {
        Self {
            first,
            second,
            frame,
            turn: frame.axes.tr_mul(&other.axes),
            offset: frame.to_local(&other.centre),
        }
    }

    /// Whether it is known where both bodies are.
    #[inline]
    pub(super) fn is_finite(&self) -> bool {
        let mut numbers = self.offset.iter().chain(&self.turn);
        numbers.all(|x| x.is_finite())
    }

    /// The point between the centres where both gauges are equal.
    pub(super) fn between_centres(&self) -> Vector3<f64> {
        let first = self.first.gauge(&self.offset);
        let second = self.second.gauge(&-self.turn.tr_mul(&self.offset));
        match first + second > 0.0 {
            true => self.offset * (second / (first + second)),
            false => self.offset,
        }
    }

    /// The point in the second body's frame.
    #[inline(always)]
    pub(super) fn seen_from_second(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.turn.tr_mul(&(x - self.offset))
    }

    /// The larger of the two gauges.
    #[inline]
    pub(super) fn larger_gauge(&self, x: &Vector3<f64>) -> f64 {
        let second = self.second.gauge(&self.seen_from_second(x));
        self.first.gauge(x).max(second)
    }

    /// Both gauges with their derivatives, in the first body's frame.
    #[inline]
    pub(super) fn jets(&self, x: &Vector3<f64>) -> [Jet; 2] {
        let seen = self.seen_from_second(x);
        let [first, second] = Superquadric::gauge_jets([self.first, self.second], [x, &seen]);
        let turned = Jet {
            value: second.value,
            gradient: self.turn * second.gradient,
            hessian: self.turn * second.hessian * self.turn.transpose(),
        };
        [first, turned]
    }

    /// The lower bound of the ratio along a direction.
    #[inline]
    pub(super) fn lower_bound(&self, d: &Vector3<f64>) -> f64 {
        let [(first, _), (second, _)] = self.supports(d);
        d.dot(&self.offset) / (first + second)
    }

    /// Support of the first body along a direction and of the second against it, each in its own frame.
    #[inline]
    pub(super) fn supports(&self, d: &Vector3<f64>) -> [(f64, Vector3<f64>); 2] {
        let back = -self.turn.tr_mul(d);
        Superquadric::supports([self.first, self.second], [d, &back])
    }
}
