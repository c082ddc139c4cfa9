//! Two superquadrics, and how their contact is found.

use super::ellipsoids::Ellipsoids;
use super::{midway, minimax, overlap, portal};
use crate::model::{Frame, Superquadric};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Point3, Vector3};

/// Relative gap between the bounds of the ratio at which a contact is found.
const GAP: f64 = 1e-6;

/// How a contact is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Sequential quadratic programming on the gauges, which of two ellipsoids leaves one unknown, and where that stalls
    /// portal refinement on the support functions: it does not fail.
    #[default]
    Minimax,
    /// Portal refinement alone (Snethen 2008).
    Portal,
    /// Newton's iteration for the midway point of Wang, Marmysh and Ji (2020): grad F_1 + lambda² grad F_2 = 0 and
    /// F_1 = F_2. It fails where its matrix is singular, as for faces that are parallel, or runs away.
    Midway,
}

/// Whether bodies touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConvexStatus {
    /// A point was found that lies in both.
    Touching,
    /// No point lies in both, or none does by more than the gap.
    Apart,
    /// The method came to no end.
    Unresolved,
}

/// What is known of a pair from an earlier contact: where to begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Warm {
    /// A point near the contact, in the frame that the bodies are placed in.
    pub point: Point3<f64>,
    /// A direction from the first body to the second; it need not have length one.
    pub normal: Vector3<f64>,
}

/// The contact of two convex bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvexContact {
    /// Whether they touch.
    pub status: ConvexStatus,
    /// The midway point: where the larger of the two gauges is least. Of bodies that were proved to be apart the best
    /// point so far.
    pub point: Point3<f64>,
    /// The unit normal from the first body to the second.
    pub normal: Vector3<f64>,
    /// Upper bound of the ratio mu, met at the point.
    pub ratio: f64,
    /// The upper less the lower bound of the ratio, as a share of the upper: at most 1e-6 unless the bodies are apart
    /// or unresolved, or the method is [`Method::Midway`], which looks for another point.
    pub gap: f64,
    /// Iterations of the method.
    pub iterations: usize,
}

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
    frame: &'a Frame,
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

    /// The contact, from where an earlier one was if that is known. Of bodies that are apart no more is computed than
    /// the proof of that, which the last normal often is.
    #[inline]
    pub fn contact(&self, warm: Option<&Warm>) -> ConvexContact {
        self.contact_by(Method::Minimax, warm)
    }

    /// The same by a method.
    pub fn contact_by(&self, method: Method, warm: Option<&Warm>) -> ConvexContact {
        if let Some(warm) = warm
            && let Some(apart) = self.still_apart(warm)
        {
            return apart;
        }
        let start = warm.map(|warm| self.frame.to_local(&warm.point));
        let goal = Goal {
            gap: GAP,
            may_stop_apart: true,
        };
        self.told(&self.solve(method, start, &goal))
    }

    /// The contact whose ratio is known to a gap, also of bodies that are apart: how far apart they are.
    pub fn resolved(&self, method: Method, gap: f64) -> ConvexContact {
        let goal = Goal {
            gap,
            may_stop_apart: false,
        };
        self.told(&self.solve(method, None, &goal))
    }

    /// How far bodies that touch overlap along the normal through the point of the contact: the distance between where
    /// that line leaves the first body and where it enters the second. Of bodies that are apart, the distance between
    /// the planes normal to it that touch them, with a minus.
    pub fn overlap(&self, contact: &ConvexContact) -> f64 {
        let normal = self.frame.axes.tr_mul(&contact.normal);
        if contact.status == ConvexStatus::Apart {
            let [(first, _), (second, _)] = self.supports(&normal);
            return first + second - normal.dot(&self.offset);
        }
        overlap::overlap(self, &self.frame.to_local(&contact.point), &normal)
    }

    /// The proof that the bodies are apart by the earlier normal, if it is one.
    #[inline]
    fn still_apart(&self, warm: &Warm) -> Option<ConvexContact> {
        let normal = self.frame.axes.tr_mul(&warm.normal);
        let reach = normal.dot(&self.offset);
        if reach <= 0.0 {
            return None;
        }
        let [(first, _), (second, _)] = self.supports(&normal);
        if first + second >= reach {
            return None;
        }
        Some(ConvexContact {
            status: ConvexStatus::Apart,
            point: warm.point,
            normal: warm.normal,
            ratio: f64::INFINITY,
            gap: 1.0,
            iterations: 0,
        })
    }

    fn solve(&self, method: Method, start: Option<Vector3<f64>>, goal: &Goal) -> Found {
        if self.offset == Vector3::zeros() {
            // The centres are one point, which is as deep as any.
            return Found {
                upper: 0.0,
                is_settled: true,
                ..Found::start(self, self.offset)
            };
        }
        match method {
            Method::Portal => portal::solve(self, goal),
            Method::Midway => midway::solve(self, start),
            Method::Minimax => {
                let start = start.unwrap_or_else(|| self.between_centres());
                let found = match Ellipsoids::new(self) {
                    Some(ellipsoids) => ellipsoids.solve(self, &start, goal),
                    None => minimax::solve(self, start, goal),
                };
                match found.is_settled {
                    true => found,
                    false => self.better_of(&found, &portal::solve(self, goal), goal),
                }
            }
        }
    }

    /// The better bounds of two methods, both of which hold.
    fn better_of(&self, one: &Found, other: &Found, goal: &Goal) -> Found {
        let near = if other.upper < one.upper { other } else { one };
        let steep = if other.lower > one.lower { other } else { one };
        let found = Found {
            normal: steep.normal,
            lower: steep.lower,
            iterations: one.iterations + other.iterations,
            ..*near
        };
        Found {
            is_settled: goal.is_met(&found),
            ..found
        }
    }

    /// The contact in the frame that the bodies are placed in.
    fn told(&self, found: &Found) -> ConvexContact {
        ConvexContact {
            status: match found.is_settled {
                false => ConvexStatus::Unresolved,
                true if found.upper < 1.0 => ConvexStatus::Touching,
                true => ConvexStatus::Apart,
            },
            point: self.frame.to_scan(&found.point),
            normal: self.frame.axes * found.normal,
            ratio: found.upper,
            gap: found.gap(),
            iterations: found.iterations,
        }
    }

    /// The point between the centres where both gauges are equal.
    fn between_centres(&self) -> Vector3<f64> {
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
