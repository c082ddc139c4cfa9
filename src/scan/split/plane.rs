//! The plane that grains lie on.
//!
//! It is looked for by planes through three points each (Fischler and Bolles 1981): that on which most points lie, of
//! those that have nothing on one side. A flat face of a body is one too; but what lies opposite covers it, and a tray
//! goes on beside its grains. The plane's noise is told by the points below it: those above may be of grains. What is
//! not thin beside the grains is no plane, but a layer of them, and nor is what lies all over its thickness, as low grains beside
//! a high one do.

use super::links::{nearest, nearest_distance, sixth_distances};
use crate::polygon_hull::{hull_area, polygon_hull};
use crate::sphere::across;
use crate::spread::{covariance, robust_deviation, root_mean_square, upper_median};
use kiddo::ImmutableKdTree;
use nalgebra::{Point3, Unit, Vector2, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::ops::Range;

/// Points by which planes are compared.
const MOST_COMPARED: usize = 1500;

/// Planes that are tried: of points of which a twentieth lies on a plane, three do in one of eight thousand.
const TRIALS: usize = 30_000;

/// Points by which the plane that was found and its noise are told.
const MOST_REFINED: usize = 50_000;

/// Share of the points that lie on the plane at least.
const LEAST_SHARE: f64 = 0.05;

/// Share of the points that may lie below it: noise, dust.
const MOST_BELOW: f64 = 0.02;

/// Distances, as shares of the size of the scan, at which a point lies on a plane that is tried, one after the other until there
/// is one: of a wide tray the first holds the lower half of its grains too ...
const FIRST_REACHES: [f64; 3] = [2e-3, 5e-4, 1.25e-4];

/// ... that of the plane that was found is so many standard deviations of its noise, ...
const DEVIATIONS: f64 = 5.0;

/// Noise that is less than the coordinates were rounded by shows in so many of these steps.
const STEPS: f64 = 3.5;

/// ... between these shares of the size: rounding to 32 bits far from the origin, and what is no plane.
const LEAST_REACH: f64 = 1e-6;
const LARGEST_REACH: f64 = 0.02;

/// The plane is laid through the points within so many standard deviations: few of these are of grains.
const CORE: f64 = 2.0;

/// Of the points within two standard deviations of its noise those within one, at least: of noise seven tenths are, of grains that it
/// goes through half.
const LEAST_IN_MIDDLE: f64 = 0.6;

/// Its reach over the height of what stands on it, or over the distance between its points, at most.
const THIN: f64 = 0.25;

/// The height of what stands on it is exceeded by so few of the points.
const STRAYS: f64 = 1e-3;

/// Rounds in which plane and noise are told from what lies on the plane.
const ROUNDS: usize = 12;

/// Share of a tray that is covered by nothing, at least ...
const LEAST_BARE: f64 = 0.15;

/// ... within so many times the distance between its points, ...
const BARE: f64 = 4.0;

/// ... or so many times that between the points above it, where these are denser and the plane goes on beyond them, ...
const BARE_OF_ABOVE: f64 = 2.5;

/// ... over so many times their outline: a face of a body does not.
const BEYOND: f64 = 1.05;

/// Share of what is above a plane that lies over its outline, at least: the rest of a grain that was seen from above only hangs
/// down round its top.
const LEAST_UNDER: f64 = 0.25;

/// About how far the sixth neighbour is, in distances between points of a surface.
const SIXTH: f64 = 1.4;

/// Standard deviations of the noise by which the outermost of some thousand points are too far out.
const OUTERMOST: f64 = 2.0;

/// Nearest points, seen along the normal, whose grains may cover a point.
const AROUND: usize = 8;

/// A plane that the scan lies on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point of it.
    pub point: Point3<f64>,
    /// The unit normal, towards the grains.
    pub normal: Unit<Vector3<f64>>,
    /// Points nearer than this lie on it.
    pub reach: f64,
}

impl Plane {
    /// The plane that carries the points, if there is one.
    pub(super) fn carrying(points: &[Point3<f64>]) -> Option<Self> {
        let some = |most: usize| {
            let step = points.len().div_ceil(most);
            points.iter().step_by(step).copied().collect()
        };
        let compared: Vec<Point3<f64>> = some(MOST_COMPARED);
        let size = size(points)?;
        let refining: Vec<Point3<f64>> = some(MOST_REFINED);
        let rounding = rounding(&refining);
        let mut largest = LARGEST_REACH;
        FIRST_REACHES.into_iter().find_map(|reach| {
            let reaches = LEAST_REACH * size..std::mem::replace(&mut largest, reach) * size;
            let plane = Self::most_met(&compared, reach * size)?;
            let plane = plane.refined(&refining, reaches, &rounding)?;
            plane.is_tray(points).then_some(plane)
        })
    }

    fn is_tray(&self, points: &[Point3<f64>]) -> bool {
        let on = points.iter().filter(|point| self.carries(point)).count();
        on as f64 >= LEAST_SHARE * points.len() as f64
            && self.is_clear_below(points)
            && self.is_dense(points)
            && self.is_thin(points, on)
            && self.is_bare(points, on)
    }

    /// Whether a point lies on the plane.
    pub(super) fn carries(&self, point: &Point3<f64>) -> bool {
        self.height(point).abs() < self.reach
    }

    /// Whether a point lies beyond the plane, on the side without grains.
    pub(super) fn hides(&self, point: &Point3<f64>) -> bool {
        self.height(point) <= -self.reach
    }

    fn height(&self, point: &Point3<f64>) -> f64 {
        self.normal.dot(&(point - self.point))
    }

    /// The place of a point as seen along the normal.
    fn seen(&self, point: &Point3<f64>) -> [f64; 2] {
        let [u, v] = across(&self.normal);
        let ray = point - self.point;
        [u.dot(&ray), v.dot(&ray)]
    }

    fn most_met(points: &[Point3<f64>], reach: f64) -> Option<Self> {
        let mut generator = ChaCha8Rng::seed_from_u64(0);
        let mut draw = || points[(generator.next_u64() % points.len() as u64) as usize];
        let mut best: Option<(usize, Self)> = None;
        for _ in 0..TRIALS {
            let [a, b, c] = [draw(), draw(), draw()];
            let Some(normal) = Unit::try_new((b - a).cross(&(c - a)), 0.0) else {
                continue;
            };
            let plane = Self {
                point: a,
                normal,
                reach,
            };
            let on = points.iter().filter(|point| plane.carries(point)).count();
            if best.as_ref().is_none_or(|(most, _)| on > *most)
                && let Some(plane) = plane.facing_up(points)
            {
                best = Some((on, plane));
            }
        }
        best.map(|(_, plane)| plane)
    }

    /// The plane with its normal towards what it carries, if all of that is on one side.
    fn facing_up(mut self, points: &[Point3<f64>]) -> Option<Self> {
        let above = points.iter().filter(|point| self.height(point) > 0.0);
        if 2 * above.count() < points.len() {
            self.normal = -self.normal;
        }
        self.is_clear_below(points).then_some(self)
    }

    fn is_clear_below(&self, points: &[Point3<f64>]) -> bool {
        let below = points.iter().filter(|point| self.hides(point)).count();
        below as f64 <= MOST_BELOW * points.len() as f64
    }

    /// The plane through the points that it carries, and how far these scatter about it.
    fn refined(
        mut self,
        points: &[Point3<f64>],
        reaches: Range<f64>,
        rounding: &Vector3<f64>,
    ) -> Option<Self> {
        let mut core = self.reach;
        for _ in 0..ROUNDS {
            let near = points
                .iter()
                .filter(|point| self.height(point).abs() < core);
            let near: Vec<&Point3<f64>> = near.collect();
            if near.len() < 3 {
                return None;
            }
            let from = self.point;
            let (shift, moments) = covariance(near.iter().map(|point| *point - from));
            let axes = moments.symmetric_eigen();
            let least = axes.eigenvalues.imin();
            let normal = Unit::try_new(axes.eigenvectors.column(least).into_owned(), 0.0)?;
            let is_turned = normal.dot(&self.normal) < 0.0;
            self.normal = if is_turned { -normal } else { normal };
            self.point = from + shift;
            let step = self.normal.abs().dot(rounding);
            let below = |reach: f64| {
                let heights = points.iter().map(|point| self.height(point));
                heights.filter(move |height| (-reach..0.0).contains(height))
            };
            let deviation = robust_deviation(below(self.reach));
            let reach = DEVIATIONS * deviation.max(root_mean_square(below(STEPS * step)));
            self.reach = reach.clamp(reaches.start, reaches.end);
            core = CORE / DEVIATIONS * self.reach;
        }
        Some(self)
    }

    /// Whether points are denser in the middle of the plane, as those of noise are.
    fn is_dense(&self, points: &[Point3<f64>]) -> bool {
        let within = |deviations: f64| {
            let most = deviations / DEVIATIONS * self.reach;
            let heights = points.iter().map(|point| self.height(point).abs());
            heights.filter(|height| *height < most).count() as f64
        };
        within(1.0) >= LEAST_IN_MIDDLE * within(CORE)
    }

    /// Whether the points that the plane carries are a sheet: one beside the grains, or beside the distance of its own.
    fn is_thin(&self, points: &[Point3<f64>], on: usize) -> bool {
        let mut heights: Vec<f64> = points.iter().map(|point| self.height(point)).collect();
        let at = ((1.0 - STRAYS) * (heights.len() - 1) as f64) as usize;
        let (_, highest, _) = heights.select_nth_unstable_by(at, f64::total_cmp);
        self.reach < THIN * highest.max(self.spacing(points, on))
    }

    /// About how far the points on the plane are apart.
    fn spacing(&self, points: &[Point3<f64>], on: usize) -> f64 {
        let carried = points.iter().filter(|point| self.carries(point));
        let places: Vec<[f64; 2]> = carried.map(|point| self.seen(point)).collect();
        let sides = [0, 1].map(|axis| {
            let places = places.iter().map(|place| place[axis]);
            let (low, high) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            high - low
        });
        (sides[0] * sides[1] / on as f64).sqrt()
    }

    /// Whether much of the plane has nothing above it: a face of a body does not.
    fn is_bare(&self, points: &[Point3<f64>], on: usize) -> bool {
        let (carried, above): (Vec<&Point3<f64>>, Vec<&Point3<f64>>) =
            points.iter().partition(|point| self.carries(point));
        let seen: Vec<[f64; 2]> = above.iter().map(|point| self.seen(point)).collect();
        let outline = self.outline(&carried);
        let is_under = |place: &&[f64; 2]| holds(&outline, &(**place).into(), 0.0);
        if (seen.iter().filter(is_under).count() as f64) < LEAST_UNDER * seen.len() as f64 {
            return false;
        }
        let Some(seen) = tree(&seen) else {
            return true;
        };
        let mut within = BARE * self.spacing(points, on);
        if hull_area(&outline) > BEYOND * hull_area(&self.outline(&above)) {
            within = within.min(BARE_OF_ABOVE * spacing_of(&above));
        }
        let places = carried.iter().step_by(on.div_ceil(MOST_COMPARED));
        let places: Vec<[f64; 2]> = places.map(|point| self.seen(point)).collect();
        let is_bare = |place: &&[f64; 2]| nearest_distance(&seen, place) > within;
        let bare = places.iter().filter(is_bare).count();
        bare as f64 > LEAST_BARE * places.len() as f64
    }

    /// The convex outline of points, as seen along the normal.
    fn outline(&self, points: &[&Point3<f64>]) -> Vec<Vector2<f64>> {
        let seen = points.iter().map(|point| self.seen(point).into());
        polygon_hull(seen.collect())
    }

    /// The grains of points that lie on the plane, as a flat underside does. Below a grain the plane itself is hidden,
    /// and so a point within the convex outline of a grain, no farther than a distance from what is seen of it, is its.
    pub(super) fn covering(
        &self,
        on: &[Point3<f64>],
        grains: &[Vec<Point3<f64>>],
        distance: f64,
    ) -> Vec<Option<u32>> {
        let seen: Vec<Vec<[f64; 2]>> = grains
            .iter()
            .map(|grain| grain.iter().map(|point| self.seen(point)).collect())
            .collect();
        let outlines: Vec<Vec<Vector2<f64>>> = seen
            .par_iter()
            .map(|seen| polygon_hull(seen.iter().map(|&place| place.into()).collect()))
            .collect();
        let margin = OUTERMOST * self.reach / DEVIATIONS;
        let owners: Vec<u32> = (0..)
            .zip(&seen)
            .flat_map(|(grain, seen)| seen.iter().map(move |_| grain))
            .collect();
        let Some(tree) = tree(&seen.concat()) else {
            return vec![None; on.len()];
        };
        on.par_iter()
            .map(|point| {
                let place = self.seen(point);
                let near = nearest(&tree, &place, AROUND, distance);
                let mut owners = near.into_iter().map(|at| owners[at as usize]);
                owners.find(|grain| holds(&outlines[*grain as usize], &place.into(), margin))
            })
            .collect()
    }
}

/// Whether a convex polygon, its corners counter-clockwise, holds a place that is no nearer to its edges than a margin.
fn holds(corners: &[Vector2<f64>], place: &Vector2<f64>, margin: f64) -> bool {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    corners.len() > 2
        && edges
            .map(|(from, to)| (to - from).perp(&(place - from)) - margin * (to - from).norm())
            .all(|inwards| inwards > 0.0)
}

/// By how much coordinates along each axis differ at least, which of numbers that were rounded is what they were rounded to.
fn rounding(points: &[Point3<f64>]) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| {
        let mut values: Vec<f64> = points.iter().map(|point| point[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        let steps = values.windows(2).map(|pair| pair[1] - pair[0]);
        let least = steps.filter(|&step| step > 0.0).reduce(f64::min);
        least.unwrap_or(0.0)
    })
}

/// The diagonal of the box round the points.
fn size(points: &[Point3<f64>]) -> Option<f64> {
    let first = points.first()?.coords;
    let (low, high) = points.iter().fold((first, first), |(low, high), point| {
        (low.inf(&point.coords), high.sup(&point.coords))
    });
    Some((high - low).norm())
}

/// About how far points of surfaces are apart.
fn spacing_of(points: &[&Point3<f64>]) -> f64 {
    let places: Vec<[f64; 3]> = points.iter().map(|&&point| point.into()).collect();
    let Some(tree) = tree(&places) else {
        return 0.0;
    };
    let mut sixth = sixth_distances(&tree, &places, MOST_COMPARED);
    upper_median(&mut sixth).unwrap_or(0.0) / SIXTH
}

/// A tree of the places; none of none.
fn tree<const K: usize>(places: &[[f64; K]]) -> Option<ImmutableKdTree<f64, K>> {
    ImmutableKdTree::new_from_slice(places)
        .ok()
        .filter(|_| !places.is_empty())
}

#[cfg(test)]
mod tests;
