//! A few points of a hull that stand for it, and the least boxes round them.

use crate::farthest::Farthest;
use crate::measure::OrientedBox;
use crate::measure::boxes::oriented_box::oriented;
use crate::measure::convex_polygon::ConvexPolygon;
use nalgebra::{Matrix3, Point3, Vector2, Vector3};

/// A box and its volume; the last axis is the direction it was found for.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub(super) volume: f64,
    pub(super) axes: Matrix3<f64>,
}

/// The points of a hull.
pub(super) struct HullPoints<'a> {
    points: &'a [Point3<f64>],
    farthest: Farthest,
}

impl<'a> HullPoints<'a> {
    pub(super) fn new(points: &'a [Point3<f64>]) -> Self {
        let farthest = Farthest::new(points.iter().map(|point| point.coords));
        Self { points, farthest }
    }

    /// The smallest box with the given orthonormal axes (columns, in any order) that holds them.
    pub(super) fn box_along(&self, axes: &Matrix3<f64>) -> OrientedBox {
        let reach = |towards: Vector3<f64>| match self.farthest.along(&towards) {
            Some(at) => self.points[at].coords.dot(&towards),
            None => 0.0,
        };
        let axis = |i: usize| axes.column(i).into_owned();
        let low = Vector3::from_fn(|i, _| -reach(-axis(i)));
        oriented([low, Vector3::from_fn(|i, _| reach(axis(i)))], axes)
    }
}

/// A few points of a hull, which stand for it.
#[derive(Clone)]
pub(super) struct ExtremePoints {
    pub(super) points: Vec<Point3<f64>>,
}

impl ExtremePoints {
    /// Of these points, those that are extreme in the given directions and their opposites.
    pub(super) fn new(of: &HullPoints<'_>, directions: impl Iterator<Item = Vector3<f64>>) -> Self {
        let mut few = Self { points: Vec::new() };
        few.add(of, directions);
        few
    }

    /// Adds such points.
    pub(super) fn add(
        &mut self,
        of: &HullPoints<'_>,
        directions: impl Iterator<Item = Vector3<f64>>,
    ) {
        for direction in directions {
            let ends = [direction, -direction].map(|towards| of.farthest.along(&towards));
            self.points
                .extend(ends.into_iter().flatten().map(|at| of.points[at]));
        }
        let key = |p: &Point3<f64>| [p.x, p.y, p.z].map(f64::to_bits);
        self.points.sort_unstable_by_key(key);
        self.points.dedup();
    }

    /// The least box with one axis in this direction. Axes of boxes are given again and again: what they lack of unit length
    /// would add up, for a box along shorter ones seems smaller.
    pub(super) fn least_box(&self, direction: &Vector3<f64>) -> Option<Candidate> {
        let direction = direction.normalize();
        let u = direction
            .cross(&Vector3::ith(direction.iamin(), 1.0))
            .normalize();
        let v = direction.cross(&u);
        let (mut low, mut high) = (f64::MAX, f64::MIN);
        let projected = self.points.iter().map(|point| {
            let height = direction.dot(&point.coords);
            (low, high) = (low.min(height), high.max(height));
            Vector2::new(u.dot(&point.coords), v.dot(&point.coords))
        });
        let polygon = ConvexPolygon::hull_of(projected.collect());
        let rectangle = polygon.least_rectangle()?;
        let side = u * rectangle.axis.x + v * rectangle.axis.y;
        Some(Candidate {
            volume: (high - low) * rectangle.area,
            axes: Matrix3::from_columns(&[side, direction.cross(&side), direction]),
        })
    }

    /// A local minimum of the volume near a box: so many simplex searches, the first of the given size in
    /// radians and the last one ending at another.
    pub(super) fn refine(
        &self,
        start: Candidate,
        size: f64,
        restarts: i32,
        last: f64,
    ) -> Candidate {
        let mut best = start;
        for restart in 0..restarts {
            let size = size * SHRINK.powi(restart);
            let end = if restart + 1 == restarts {
                last
            } else {
                size.abs() * 1e-2
            };
            best = self.simplex_search(best, size, end);
            for axis in 0..2 {
                let turned = self.least_box(&best.axes.column(axis).into_owned());
                if let Some(turned) = turned.filter(|turned| turned.volume < best.volume) {
                    best = turned;
                }
            }
        }
        best
    }

    /// The simplex search of Nelder and Mead 1965, in the plane tangential to the sphere of directions.
    fn simplex_search(&self, start: Candidate, size: f64, end: f64) -> Candidate {
        let [u, v, w] = [0, 1, 2].map(|i| start.axes.column(i).into_owned());
        let at = |place: Vector2<f64>| {
            let direction = (w + u * place.x + v * place.y).normalize();
            (place, self.least_box(&direction).unwrap_or(start))
        };
        let mut simplex = [
            (Vector2::zeros(), start),
            at(Vector2::x() * size),
            at(Vector2::y() * size),
        ];
        for _ in 0..STEPS {
            simplex.sort_by(|a, b| a.1.volume.total_cmp(&b.1.volume));
            let [best, second, worst] = simplex;
            let width = (worst.0 - best.0).amax().max((second.0 - best.0).amax());
            if width < end {
                break;
            }
            let middle = (best.0 + second.0) / 2.0;
            let reflected = at(middle * 2.0 - worst.0);
            if reflected.1.volume < best.1.volume {
                let expanded = at(middle * 3.0 - worst.0 * 2.0);
                let is_better = expanded.1.volume < reflected.1.volume;
                simplex[2] = if is_better { expanded } else { reflected };
            } else if reflected.1.volume < second.1.volume {
                simplex[2] = reflected;
            } else {
                let is_outside = reflected.1.volume < worst.1.volume;
                let limit = if is_outside { reflected } else { worst };
                let contracted = at((middle + limit.0) / 2.0);
                if contracted.1.volume < limit.1.volume {
                    simplex[2] = contracted;
                } else {
                    simplex[1] = at((best.0 + second.0) / 2.0);
                    simplex[2] = at((best.0 + worst.0) / 2.0);
                }
            }
        }
        simplex
            .into_iter()
            .map(|(_, candidate)| candidate)
            .fold(start, |best, other| match other.volume < best.volume {
                true => other,
                false => best,
            })
    }
}

/// By how much a simplex search is smaller than the one before: the simplex is turned to the other side,
/// for one that has collapsed in a crease does not find its way along it.
const SHRINK: f64 = -0.5;

/// Steps of a simplex search.
const STEPS: usize = 120;
