//! That no ball inside a surface is larger than the one that is found, but for a tolerance: by branch and bound.
//!
//! The square of the distance to a point p of the surface, seen from the middle c of a cell,
//!
//! ```text
//! |x - p|² = |c - p|² + 2 (c - p).(x - c) + |x - c|²
//! ```
//!
//! is linear in x but for the last term, which in a cell of half diagonal h is at most h². So the largest distance from the
//! nearest of a few points of the surface is bounded by a linear programme, whose solution is where to look for the next
//! point. Cells whose bound is not above the largest ball that is known are done, the others are cut, the most promising one
//! first. Between two walls the bound is high by h² over their distance only, where that of a single distance, which
//! "polylabel" takes, is high by h: it would need cells as small as the tolerance.

use super::clearance::largest_from;
use crate::measure::Ball;
use crate::planes::{Plane, deepest_below};
use nalgebra::Vector3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Points of the surface that are looked up for one cell, at most, before it is cut.
const POINTS: usize = 4;

/// Points that are looked up in all, at most. Of most bodies some hundreds do; between flat walls that are n times as wide as
/// they are apart, where many balls are equally large, so many show that none is larger by more than about n² thousandths.
const MAX_POINTS: usize = 5_000;

/// Share of the tolerance by which a ball is larger from which it is grown further.
const GROWN: f64 = 0.1;

/// What a ball must not cross, and where it is allowed.
pub(in crate::measure) struct Obstacles<N, O, I> {
    /// The point of the surface nearest to a place, if it is nearer than a limit.
    pub nearest: N,
    /// Whether a place is outside.
    pub is_outside: O,
    /// Whether a ball is inside: the last word, on balls that would be the largest.
    pub is_inside: I,
    /// In the plane z = 0 all cells are squares.
    pub is_flat: bool,
    /// Corners of a box round the surface.
    pub bounds: [Vector3<f64>; 2],
}

/// Points that are looked up while a ball grows, about: where a surface goes through itself balls grow that are then not inside.
const OF_GROWTH: usize = 30;

/// A cube, or a square.
struct Cell {
    centre: Vector3<f64>,
    /// Half of its edge.
    half: f64,
    /// Points of the surface that may be nearest to some place of it.
    points: Vec<Vector3<f64>>,
    /// Whether it does not reach outside.
    is_inside: bool,
    /// No ball about a place of it is larger.
    bound: f64,
    /// Where it is met that way.
    promising: Vector3<f64>,
}

impl<N, O, I> Obstacles<N, O, I>
where
    N: Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>,
    O: Fn(&Vector3<f64>) -> bool,
    I: Fn(&Ball) -> bool,
{
    /// A ball inside, at least as large as one that is `known`, than which no other is larger by more than a share
    /// `tolerance` of its radius: unless [`MAX_POINTS`] do not do to tell so.
    pub(in crate::measure) fn largest(&self, known: Ball, tolerance: f64) -> Ball {
        let mut best = known;
        let mut left = MAX_POINTS;
        let mut open = BinaryHeap::from([self.whole()]);
        while let Some(cell) = open.pop() {
            if cell.bound <= best.radius * (1.0 + tolerance) || left == 0 {
                break;
            }
            for mut part in cell.parts(self.is_flat) {
                if self.may_hold(&mut part, &mut best, tolerance, &mut left) {
                    open.push(part);
                }
            }
        }
        best
    }

    fn whole(&self) -> Cell {
        let [low, high] = self.bounds;
        Cell {
            centre: (low + high) / 2.0,
            half: (high - low).amax() / 2.0,
            points: Vec::new(),
            is_inside: false,
            bound: f64::INFINITY,
            promising: (low + high) / 2.0,
        }
    }

    /// Whether a cell may hold the centre of a larger ball, as far as a few points of the surface tell. Balls that are larger
    /// become the best.
    fn may_hold(&self, cell: &mut Cell, best: &mut Ball, tolerance: f64, left: &mut usize) -> bool {
        let is_done = |cell: &Cell, best: &Ball| cell.bound <= best.radius * (1.0 + tolerance);
        if !cell.points.is_empty() {
            cell.tighten(self.is_flat);
        }
        let mut place = cell.centre;
        for _ in 0..POINTS {
            if is_done(cell, best) {
                return false;
            }
            *left = left.saturating_sub(1);
            let least = cell.distance(&place);
            let nearer = (self.nearest)(&place, least);
            let distance = nearer.map_or(least, |point| (place - point).norm());
            if place == cell.centre && !cell.is_inside && distance >= cell.reach(self.is_flat) {
                if (self.is_outside)(&place) {
                    return false;
                }
                cell.is_inside = true;
            }
            let Some(point) = nearer else {
                return true;
            };
            cell.points.push(point);
            let is_larger = distance > best.radius * (1.0 + GROWN * tolerance);
            if is_larger && (cell.is_inside || !(self.is_outside)(&place)) {
                *left = left.saturating_sub(OF_GROWTH);
                self.grow(&place, best);
            }
            cell.tighten(self.is_flat);
            place = cell.promising;
        }
        !is_done(cell, best)
    }

    /// Takes the ball that grows from a place, if it is larger.
    fn grow(&self, place: &Vector3<f64>, best: &mut Ball) {
        let start = Ball {
            centre: (*place).into(),
            radius: 0.0,
        };
        let Some(ball) = largest_from(&self.nearest, &[start]) else {
            return;
        };
        if ball.radius > best.radius && (self.is_inside)(&ball) {
            *best = ball;
        }
    }
}

impl Cell {
    /// Half of its diagonal.
    fn reach(&self, is_flat: bool) -> f64 {
        self.half * if is_flat { 2.0_f64 } else { 3.0 }.sqrt()
    }

    /// Distance from a place to the nearest of the points.
    fn distance(&self, place: &Vector3<f64>) -> f64 {
        let distances = self.points.iter().map(|point| (place - point).norm());
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Drops points that are nearest to no place of it, and bounds the distance from the others.
    fn tighten(&mut self, is_flat: bool) {
        let reach = self.reach(is_flat);
        let least = self.distance(&self.centre);
        let centre = self.centre;
        self.points
            .retain(|point| (centre - point).norm() <= least + 2.0 * reach);
        // In units of half an edge; so that no point nearest to the middle allows more than a depth of one.
        let unit = 2.0 * 3.0_f64.sqrt() * self.half * least.max(self.half);
        let planes: Vec<Plane> = self
            .points
            .iter()
            .map(|point| Plane {
                normal: (point - centre) * (2.0 * self.half / unit),
                height: ((centre - point).norm_squared() - least * least) / unit,
            })
            .collect();
        let (shift, depth) = deepest_below(&planes, 1.0);
        let square = least * least + depth * unit + reach * reach;
        self.bound = self.bound.min(square.sqrt()).min(least + reach);
        let shift = if is_flat { shift.xy().push(0.0) } else { shift };
        self.promising = centre + shift * self.half;
    }

    /// Its quarters, or eighths.
    fn parts(&self, is_flat: bool) -> impl Iterator<Item = Self> {
        let sides = if is_flat {
            [0.0].as_slice()
        } else {
            &[-0.5, 0.5]
        };
        let half = self.half;
        let shifts = sides.iter().flat_map(|z| {
            let across = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
            across.map(|[x, y]| Vector3::new(x, y, *z))
        });
        shifts.map(move |shift| {
            let centre = self.centre + shift * half;
            Self {
                centre,
                half: half / 2.0,
                points: self.points.clone(),
                is_inside: self.is_inside,
                bound: self.bound,
                promising: centre,
            }
        })
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// By bounds.
impl Ord for Cell {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell as Count;

    #[test]
    fn some_hundreds_of_points_find_the_larger_end_of_a_dumbbell_and_show_that_nothing_is_larger() {
        let ends = [
            (1.0, Vector3::new(-3.0, 0.1, 0.2)),
            (1.01, Vector3::new(3.0, -0.2, 0.1)),
        ];
        let depth = |place: &Vector3<f64>| {
            let depths = ends.map(|(radius, middle)| radius - (place - middle).norm());
            if depths[0] > depths[1] {
                (depths[0], ends[0].1)
            } else {
                (depths[1], ends[1].1)
            }
        };
        let looked = Count::new(0);
        let obstacles = Obstacles {
            nearest: |place: &Vector3<f64>, limit: f64| {
                looked.set(looked.get() + 1);
                let (depth, middle) = depth(place);
                let outwards = (place - middle).try_normalize(0.0).unwrap_or(Vector3::x());
                (depth.abs() < limit).then(|| place + outwards * depth)
            },
            is_outside: |place: &Vector3<f64>| depth(place).0 < 0.0,
            is_inside: |_: &Ball| true,
            is_flat: false,
            bounds: [Vector3::new(-4.0, -1.3, -1.0), Vector3::new(4.1, 1.2, 1.3)],
        };
        let known = Ball {
            centre: ends[0].1.into(),
            radius: 1.0,
        };
        let found = obstacles.largest(known, 3e-3);
        assert!(
            found.radius > 1.01 / 1.003 && found.radius < 1.01 + 1e-9,
            "{found:?}"
        );
        assert!(looked.get() < 2000, "{}", looked.get());
    }
}
