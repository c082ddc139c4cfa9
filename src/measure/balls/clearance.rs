//! The place from which the nearest of many obstacles is farthest.

use crate::measure::Ball;
use crate::planes::{Plane, deepest_below};
use nalgebra::Vector3;

/// Shifts tried at most.
const SHIFTS: usize = 300;

/// Share of the radius that no shift is longer than: the centre stays within the ball that touches nothing, and so on its
/// side of the obstacles.
const LONGEST: f64 = 0.5;

/// The search ends where a shift promises to make the ball larger by no more than this share of its radius.
const ENOUGH: f64 = 1e-10;

/// The largest shift shrinks, by a factor, where less than this share of it is promised as growth: what matters then is
/// near.
const WORTH: f64 = 1e-5;
const SHRINK: f64 = 0.03;

/// Shares of the promised growth that a shift must bring to be taken, and for a longer one to be tried next.
const KEPT: f64 = 0.1;
const TRUSTED: f64 = 0.5;

/// Share of the radius within which a ball comes near another one to be taken for it.
const SAME: f64 = 0.06;

/// Share of the radius by which rounding may let a plane seem crossed that the ball touches.
const ROUNDING: f64 = 1e-12;

/// A point of an obstacle, and the direction from it to the place that it was nearest to.
struct Contact {
    point: Vector3<f64>,
    normal: Vector3<f64>,
}

/// A ball that touches obstacles at most, and what it may touch.
struct Climb<F> {
    ball: Ball,
    contacts: Vec<Contact>,
    nearest: F,
}

impl<F: Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>> Climb<F> {
    /// `None` without obstacles, or where one is touched.
    fn new(centre: &Vector3<f64>, nearest: F) -> Option<Self> {
        let point = nearest(centre, f64::INFINITY)?;
        let radius = (centre - point).norm();
        let normal = (centre - point).try_normalize(0.0)?;
        Some(Self {
            ball: Ball {
                centre: (*centre).into(),
                radius,
            },
            contacts: vec![Contact { point, normal }],
            nearest,
        })
    }

    /// Shifts the ball until no small shift lets it grow, or it comes near one of those `found` before that is larger:
    /// whether it has not.
    ///
    /// The distance to a point is at least its own linearisation, which is linear in the shift, and so the best shift for
    /// the points known to be near is found by a linear programme. Where it leads, the nearest point is looked up and
    /// becomes known: either the ball has grown there, or the point rules that shift out (Kelley 1960).
    ///
    /// Where the obstacles curve round the ball, a plane across the line of contact is no nearer than they are: `by_planes`,
    /// points whose planes the ball does not cross stand for them, so that few are needed. Then others decide.
    fn climb(&mut self, by_planes: bool, found: &[Ball]) -> bool {
        let mut reach = LONGEST * self.ball.radius;
        for _ in 0..SHIFTS {
            let Ball { centre, radius } = self.ball;
            let is_found =
                |ball: &Ball| radius < ball.radius && (centre - ball.centre).norm() < SAME * radius;
            if found.iter().any(is_found) {
                return false;
            }
            let (shift, growth) = deepest_below(&self.bounds(by_planes, reach), ALONG_AXIS);
            let promised = growth * reach;
            if promised <= ENOUGH * radius {
                break;
            }
            if growth <= WORTH {
                reach *= SHRINK;
                continue;
            }
            let place = centre.coords + shift * reach;
            let grown = self.look(&place) - radius;
            if grown > KEPT * promised {
                self.ball = Ball {
                    centre: place.into(),
                    radius: radius + grown,
                };
            }
            if !by_planes && grown > TRUSTED * promised {
                reach = (2.0 * reach).min(LONGEST * radius);
            } else if !by_planes && grown <= KEPT * promised {
                reach /= 2.0;
            }
        }
        true
    }

    /// Planes below which shift and growth, in units of the reach, must stay, one before each contact within reach.
    fn bounds(&self, by_planes: bool, reach: f64) -> Vec<Plane> {
        let Ball { centre, radius } = self.ball;
        let tangent = |contact: &Contact| {
            let away = centre.coords - contact.point;
            let plane = contact.normal.dot(&away);
            match by_planes && plane >= radius * (1.0 - ROUNDING) {
                true => (contact.normal, plane),
                false => (away / away.norm(), away.norm()),
            }
        };
        let tangents = self.contacts.iter().map(tangent);
        tangents
            .filter(|(_, distance)| *distance <= radius + 2.0 * reach)
            .map(|(gradient, distance)| Plane {
                normal: -gradient,
                height: (distance - radius) / reach,
            })
            .collect()
    }

    /// Distance from a place to the nearest obstacle, which becomes known.
    fn look(&mut self, place: &Vector3<f64>) -> f64 {
        let known = self.contacts.iter();
        let distances = known.map(|contact| (place - contact.point).norm());
        let least = distances.fold(f64::INFINITY, f64::min);
        let Some(point) = (self.nearest)(place, least) else {
            return least;
        };
        let distance = (place - point).norm();
        let normal = (place - point) / distance;
        self.contacts.push(Contact { point, normal });
        distance
    }
}

/// The largest of the balls that grow from starts, by small shifts, as long as they touch obstacles at most. `nearest`
/// finds the nearest point of the obstacles, if it is nearer than a limit.
pub(in crate::measure) fn largest_from(
    nearest: impl Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>,
    starts: &[Ball],
) -> Option<Ball> {
    let mut found = Vec::with_capacity(starts.len());
    for start in starts {
        let Some(mut own) = Climb::new(&start.centre.coords, &nearest) else {
            continue;
        };
        if own.climb(true, &found) && own.climb(false, &found) {
            found.push(own.ball);
        }
    }
    found
        .into_iter()
        .max_by(|one, other| one.radius.total_cmp(&other.radius))
}

/// Largest shift along each axis, so that no shift is longer than one.
const ALONG_AXIS: f64 = 0.577;
