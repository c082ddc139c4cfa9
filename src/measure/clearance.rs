//! The place from which the nearest of many convex obstacles is farthest.

use super::Ball;
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use nalgebra::Vector3;

/// Rounds in which obstacles are added to the linear programme.
const ROUNDS: usize = 60;

/// Slack that counts as none, relative to the largest shift; the solver itself holds 1e-7.
const SLACK: f64 = 1e-6;

/// Shifts tried at most, the first largest shift and that at which the search ends, relative to the
/// radius.
const SHIFTS: usize = 300;
const FIRST_REACH: f64 = 0.06;
const LAST_REACH: f64 = 1e-6;

/// The largest shift shrinks when the ball grows by less than this share of it: not to make progress,
/// for a shift that is possible within a small reach is so within a large one, but because the linear
/// programme is solved to so many digits of it.
const WORTH: f64 = 1e-5;
const SHRINK: f64 = 0.03;

/// The same for the planes to be used further.
const PLANES_WORTH: f64 = 0.01;

/// Convex and flat obstacles: triangles, say.
pub(super) trait Obstacles {
    /// The point of an obstacle nearest to a place.
    fn nearest(&self, index: usize, place: &Vector3<f64>) -> Vector3<f64>;
    /// Normal of the plane of an obstacle, of any length.
    fn normal(&self, index: usize) -> Vector3<f64>;
    /// Obstacles among which are all those that are not farther than `radius` from a place.
    fn within(&self, place: &Vector3<f64>, radius: f64) -> Vec<usize>;
}

/// A ball that touches obstacles at most, from one that does so on, and cannot grow by a small shift: it stays on the side
/// of them where it is.
///
/// The distance to an obstacle is at least that to its plane, and at least its own linearisation. Both
/// bounds are linear in the shift, and so the best shift for them is found by a linear programme. Planes
/// go first, those that the ball does not cross: where the surface is convex they are exact. When they
/// allow little more, as on a rough surface, the linearisations decide.
///
/// `None` if the ball comes as near as the first shift to one of those `found` before, and is smaller: it would become
/// that one.
fn largest(obstacles: &impl Obstacles, start: &Ball, found: &[Ball]) -> Option<Ball> {
    let distance = |index: usize, place: &Vector3<f64>| {
        let nearest = obstacles.nearest(index, place);
        (place - nearest).norm()
    };
    let (mut centre, mut radius) = (start.centre.coords, start.radius);
    let mut reach = FIRST_REACH * radius;
    let mut by_planes = true;
    let around = |radius: f64, centre: &Vector3<f64>| {
        let within = obstacles.within(centre, radius).into_iter();
        Near::within(radius, centre, within, &distance)
    };
    let mut near = around(radius + 4.0 * reach, &centre);
    for _ in 0..SHIFTS {
        if reach <= LAST_REACH * radius {
            break;
        }
        let is_found = |ball: &Ball| {
            radius < ball.radius && (centre - ball.centre.coords).norm() < FIRST_REACH * ball.radius
        };
        if found.iter().any(is_found) {
            return None;
        }
        // The ball grows by less than the reach, and an obstacle comes nearer by less.
        let limit = radius + 2.0 * reach;
        if !near.covers(&centre, limit) {
            near = around(radius + 4.0 * reach, &centre);
        } else if near.radius > radius + 16.0 * reach {
            let nearer = near.within_bound(f64::INFINITY);
            near = Near::within(radius + 4.0 * reach, &centre, nearer, &distance);
        }
        let moved = (centre - near.centre).norm();
        let bounds: Vec<Bound> = near
            .within_bound(limit + moved)
            .map(|index| (index, centre - obstacles.nearest(index, &centre)))
            .filter(|(_, away)| away.norm() <= limit)
            .filter_map(|(index, away)| {
                let tangent = (away.try_normalize(0.0)?, away.norm());
                let plane = by_planes
                    .then(|| obstacles.normal(index).try_normalize(0.0))
                    .flatten()
                    .map(|normal| (normal * normal.dot(&away).signum(), normal.dot(&away).abs()))
                    .filter(|(_, distance)| *distance >= radius * (1.0 - f64::EPSILON));
                let (gradient, distance) = plane.unwrap_or(tangent);
                let room = (distance - radius) / reach;
                Some(Bound { gradient, room })
            })
            .collect();
        let place = best_shift(&bounds).map(|shift| centre + shift * reach);
        let found = place.map(|place| (place, near.clearance(&place, &distance)));
        let worth = if by_planes { PLANES_WORTH } else { WORTH };
        match found.filter(|(_, found)| *found > radius + worth * reach) {
            Some(found) => (centre, radius) = found,
            None if by_planes => by_planes = false,
            None => reach *= SHRINK,
        }
    }
    Some(Ball {
        centre: centre.into(),
        radius,
    })
}

/// The largest of the balls that starts lead to, which touch obstacles at most.
pub(super) fn largest_from(obstacles: &impl Obstacles, starts: &[Ball]) -> Option<Ball> {
    let mut found = Vec::with_capacity(starts.len());
    for start in starts {
        found.extend(largest(obstacles, start, &found));
    }
    found
        .into_iter()
        .max_by(|one, other| one.radius.total_cmp(&other.radius))
}

/// The obstacles that are not farther than `radius` from `centre`.
struct Near {
    /// Distance from the centre, ascending, and number.
    obstacles: Vec<(f64, usize)>,
    centre: Vector3<f64>,
    radius: f64,
}

impl Near {
    fn within(
        radius: f64,
        centre: &Vector3<f64>,
        obstacles: impl Iterator<Item = usize>,
        distance: &impl Fn(usize, &Vector3<f64>) -> f64,
    ) -> Self {
        let mut obstacles: Vec<_> = obstacles
            .map(|index| (distance(index, centre), index))
            .filter(|(distance, _)| *distance <= radius)
            .collect();
        obstacles.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Self {
            obstacles,
            centre: *centre,
            radius,
        }
    }

    /// Whether all obstacles within `radius` of `centre` are here.
    fn covers(&self, centre: &Vector3<f64>, radius: f64) -> bool {
        (centre - self.centre).norm() + radius <= self.radius
    }

    /// Those within a distance of the centre.
    fn within_bound(&self, distance: f64) -> impl Iterator<Item = usize> {
        let near = self.obstacles.iter();
        near.take_while(move |obstacle| obstacle.0 <= distance)
            .map(|obstacle| obstacle.1)
    }

    /// Distance from a place to the nearest of the obstacles here.
    fn clearance(
        &self,
        place: &Vector3<f64>,
        distance: &impl Fn(usize, &Vector3<f64>) -> f64,
    ) -> f64 {
        let moved = (place - self.centre).norm();
        let mut least = f64::INFINITY;
        for &(from_centre, index) in &self.obstacles {
            if from_centre - moved > least {
                break;
            }
            least = least.min(distance(index, place));
        }
        least
    }
}

/// The growth t of a ball that a shift s allows before an obstacle: t <= room + gradient . s.
struct Bound {
    gradient: Vector3<f64>,
    room: f64,
}

/// The shift within the unit ball's inner cube that allows the largest growth: that of the bounds that it breaks, of which
/// those most broken are added in turns, one for each octant of gradients.
fn best_shift(bounds: &[Bound]) -> Option<Vector3<f64>> {
    let (mut shift, mut growth) = (Vector3::zeros(), f64::INFINITY);
    let mut subset: Vec<&Bound> = Vec::new();
    for _ in 0..ROUNDS {
        let mut broken = [(growth - SLACK, None); 8];
        for bound in bounds {
            let allowed = bound.room + bound.gradient.dot(&shift);
            let sides = bound.gradient.map(|along| usize::from(along > 0.0));
            let most = &mut broken[sides.x + 2 * sides.y + 4 * sides.z];
            if allowed < most.0 {
                *most = (allowed, Some(bound));
            }
        }
        let added = broken.into_iter().filter_map(|(_, bound)| bound);
        let known = subset.len();
        subset.extend(added);
        if subset.len() == known {
            break;
        }
        (shift, growth) = solve(&subset)?;
    }
    Some(shift)
}

/// Largest shift along each axis, so that no shift is longer than one.
const ALONG_AXIS: f64 = 0.577;

fn solve(bounds: &[&Bound]) -> Option<(Vector3<f64>, f64)> {
    let mut problem = Problem::new(OptimizationDirection::Maximize);
    let s = [(); 3].map(|()| problem.add_var(0.0, (-ALONG_AXIS, ALONG_AXIS)));
    let t = problem.add_var(1.0, (-1.0, 1.0));
    for Bound { gradient, room } in bounds {
        let terms = [
            (s[0], -gradient.x),
            (s[1], -gradient.y),
            (s[2], -gradient.z),
            (t, 1.0),
        ];
        problem.add_constraint(terms, ComparisonOp::Le, *room);
    }
    let solution = problem.solve().ok()?.into_solution().ok()?;
    let shift = s.map(|s| solution.var_value(s));
    Some((Vector3::from(shift), solution.var_value(t)))
}
