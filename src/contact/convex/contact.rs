//! The contact of two superquadrics, and how it is found.

use super::ellipsoids::Ellipsoids;
use super::pair::{ConvexPair, Found, Goal};
use super::{midway, minimax, overlap, portal};
use nalgebra::{Point3, Vector3};

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
    /// The method came to no end, or a number of a frame is not finite.
    Unresolved,
}

/// What is known of a pair from an earlier contact: where to begin. With a number that is not finite it is as none.
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

impl Warm {
    #[inline]
    fn is_finite(&self) -> bool {
        let mut numbers = self.point.iter().chain(&self.normal);
        numbers.all(|x| x.is_finite())
    }
}

impl ConvexPair<'_> {
    /// The contact, from where an earlier one was if that is known. Of bodies that are apart no more is computed than
    /// the proof of that, which the last normal often is.
    #[inline]
    pub fn contact(&self, warm: Option<&Warm>) -> ConvexContact {
        self.contact_by(Method::Minimax, warm)
    }

    /// The contact by a method of choice, as [`contact`](Self::contact) finds it by [`Method::Minimax`].
    pub fn contact_by(&self, method: Method, warm: Option<&Warm>) -> ConvexContact {
        let warm = warm.filter(|warm| warm.is_finite());
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
        if !self.is_finite() {
            return Found::start(self, self.offset);
        }
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
}
