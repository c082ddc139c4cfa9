//! Where two grains touch, and which points belong to which.
//!
//! Seen along any axis, the sections of a convex body grow and then shrink (Brunn and Minkowski). Between two grains
//! that touch there is a section much smaller than those on both sides: the neck.

use super::dust::LEAST_POINTS;
use super::outline::{Outline, are_followed, are_two, outline};
use crate::polygon_hull::{hull_area, polygon_hull};
use crate::sphere::{across, compass};
use nalgebra::{Matrix2, Point3, Vector2, Vector3};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Points by which a neck is looked for.
const MOST_COMPARED: usize = 2000;

/// Axes that are tried first: some 17 degrees apart.
const AXES: usize = 80;

/// Steps by which the best of them is turned, in radians: the first and the last.
const STEPS: [f64; 2] = [0.15, 0.01];

/// Slabs that the points are cut in along an axis; each is as wide as neighbours are apart, at least.
const SLABS: usize = 24;

/// Thickness of slabs in which broad necks show, beside those that rows of points need.
pub(super) const THIN: f64 = 0.5;

/// Half the width of the slabs by which a neck is placed, as a share of the distance of neighbours, ...
const PLACED: f64 = 0.07;

/// ... and places that are tried on each side.
const PLACES: i32 = 60;

/// Share of the points that each side has, at least, ...
const LEAST_SIDE: f64 = 0.1;

/// ... and where a small grain beside a large one is looked for.
const LEAST_SMALL_SIDE: f64 = 0.005;

/// Section of a neck over the smaller of the largest on both sides: what is below is cut, ...
const NECK: f64 = 0.4;

/// ... what is below this where two outlines fit so much better than one. Of grains on trays that touch it is .12 to .24,
/// of 120 other pairs above .5 for ten, which meet face to face or have few points. Of a smooth body with a waist of
/// three quarters it is .57 or more, and that is never cut, ...
const BROAD: f64 = 0.5;

/// ... and what is below this may be several grains.
const WAIST: f64 = 0.7;

/// Outline of a neck over the smaller of the largest on both sides, at most. Sections are told by how far points scatter, and
/// of a plate whose points are dense in the middle they scatter least there.
const OUTLINED: f64 = 0.85;

/// The same of a neck that shows in thin slabs only. Of grains that touch it is below .6; of peanuts with a waist of three quarters
/// and more, of which one half is denser, above.
const OUTLINED_BROAD: f64 = 0.6;

/// Points in a thin slab over those in the fuller one beside it, at least: between rows there are fewer.
const HELD: f64 = 0.2;

/// How near to a neck points are told apart by outlines, as a share of the radius of the smaller grain, ...
const BESIDE: f64 = 1.0;

/// ... and how near the first outlines do without them.
const UNSURE: f64 = 0.2;

/// Rounds in which points are given to the outline they are nearer to.
const ROUNDS: usize = 10;

/// The smallest section between larger ones.
pub(super) struct Neck {
    axis: Vector3<f64>,
    /// Along the axis.
    at: f64,
    /// Of the slabs.
    width: f64,
    /// Section over the smaller of the largest on both sides.
    ratio: f64,
    /// The same of the areas of their convex outlines, which points that are dense on one side do not change.
    outlined: f64,
    /// Points in its slab over those in the fuller of the slabs beside it.
    held: f64,
    /// Radius of the smaller of these.
    radius: f64,
}

impl Neck {
    /// The neck of a heap of points that are some distance apart, if its sections have one.
    pub(super) fn find(points: &[Point3<f64>], distance: f64) -> Option<Self> {
        Self::with_sides(points, distance, LEAST_SIDE)
    }

    /// The neck that has no less than this share of the points on either side.
    fn with_sides(points: &[Point3<f64>], distance: f64, least_side: f64) -> Option<Self> {
        let step = points.len().div_ceil(MOST_COMPARED);
        let origin = *points.first()?;
        let rays: Vec<Vector3<f64>> = points.iter().step_by(step).map(|p| p - origin).collect();
        let ratio = |axis: &Vector3<f64>| {
            let neck = narrowest(&rays, axis, distance, least_side);
            neck.map_or(f64::INFINITY, |neck| neck.ratio)
        };
        let axes = (0..AXES).map(|i| {
            // Half of a Fibonacci lattice.
            let z = (i as f64 + 0.5) / AXES as f64;
            let (sin, cos) = (i as f64 * PI * (3.0 - 5_f64.sqrt())).sin_cos();
            Vector3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z
        });
        let (first, _) = axes
            .map(|axis| (axis, ratio(&axis)))
            .min_by(|one, other| one.1.total_cmp(&other.1))?;
        let [step, least] = STEPS;
        let (axis, _) = compass(first, step, least, |axis| -ratio(axis));
        // Of few points a section may be a line by chance; all of them decide.
        let rays: Vec<Vector3<f64>> = points.iter().map(|point| point - origin).collect();
        let neck = narrowest(&rays, &axis, distance, least_side)?;
        let outlined = neck.outlined(&rays);
        (outlined < OUTLINED).then(|| Self {
            outlined,
            at: neck.placed(&rays, distance) + axis.dot(&origin.coords),
            ..neck
        })
    }

    /// The neck that shows in thin slabs, if outlines on both sides of it tell two grains.
    pub(super) fn between_two(points: &[Point3<f64>], distance: f64) -> Option<Self> {
        Self::find(points, THIN * distance).filter(|neck| neck.is_between_two(points))
    }

    /// The neck on both sides of which outlines tell two grains: a broad one, or one between a large grain and a small one.
    pub(super) fn by_outlines(points: &[Point3<f64>], distance: f64) -> Option<Self> {
        let of_small = || Self::with_sides(points, THIN * distance, LEAST_SMALL_SIDE);
        let is_small = |neck: &Self| neck.is_waist() && neck.tells_two(points);
        Self::between_two(points, distance).or_else(|| of_small().filter(is_small))
    }

    /// The convex outline of the neck over the smaller of the largest on both sides.
    fn outlined(&self, rays: &[Vector3<f64>]) -> f64 {
        let [u, v] = across(&self.axis);
        let mut sections: BTreeMap<i64, Vec<Vector2<f64>>> = BTreeMap::new();
        for ray in rays {
            let slab = ((self.axis.dot(ray) - self.at) / self.width).round() as i64;
            let section = sections.entry(slab).or_default();
            section.push(Vector2::new(u.dot(ray), v.dot(ray)));
        }
        let (mut own, mut below, mut above) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (slab, places) in sections {
            let largest = match slab {
                0 => &mut own,
                ..0 => &mut below,
                1.. => &mut above,
            };
            *largest = largest.max(hull_area(&polygon_hull(places)));
        }
        own / below.min(above)
    }

    /// Where the neck is smallest, by slabs much thinner than its own.
    fn placed(&self, rays: &[Vector3<f64>], distance: f64) -> f64 {
        let [u, v] = across(&self.axis);
        let near: Vec<[f64; 3]> = rays
            .iter()
            .map(|ray| [self.axis.dot(ray) - self.at, u.dot(ray), v.dot(ray)])
            .filter(|[height, ..]| height.abs() < self.width + distance)
            .collect();
        let section = |at: f64| {
            let mut sum = Sums::default();
            for &[height, x, y] in &near {
                if (height - at).abs() < PLACED * distance {
                    sum.add(x, y);
                }
            }
            sum.section()
        };
        let steps = (-PLACES..=PLACES).map(|step| self.width * step as f64 / PLACES as f64);
        let least = steps
            .map(|at| (at, section(at)))
            .min_by(|one, other| one.1.total_cmp(&other.1));
        self.at + least.map_or(0.0, |(at, _)| at)
    }

    /// Whether the neck is so narrow that there are two grains.
    pub(super) fn is_narrow(&self) -> bool {
        self.ratio < NECK
    }

    /// Whether it is so narrow that outlines may tell two grains.
    pub(super) fn may_part_two(&self) -> bool {
        self.ratio < BROAD
    }

    /// Whether it may be that grains touch here.
    pub(super) fn is_waist(&self) -> bool {
        self.ratio < WAIST
    }

    /// Width of the neck over that of the narrower side.
    pub(super) fn width(&self) -> f64 {
        self.ratio.sqrt()
    }

    /// Whether each point is beyond the neck, if there are two grains.
    pub(super) fn cut(&self, points: &[Point3<f64>]) -> Option<Vec<bool>> {
        let beyond = self.may_part_two().then(|| self.beyond(points))?;
        (self.is_narrow() || are_two(points, &beyond)).then_some(beyond)
    }

    /// Whether outlines on both sides of it tell two grains.
    fn is_between_two(&self, points: &[Point3<f64>]) -> bool {
        self.may_part_two()
            && self.outlined < OUTLINED_BROAD
            && self.held > HELD
            && self.tells_two(points)
    }

    fn tells_two(&self, points: &[Point3<f64>]) -> bool {
        let beyond = self.beyond(points);
        are_two(points, &beyond) && are_followed(points, &beyond)
    }

    /// Beside the neck a point is of the grain whose outline it is nearer to.
    pub(super) fn beyond(&self, points: &[Point3<f64>]) -> Vec<bool> {
        let heights: Vec<f64> = points
            .iter()
            .map(|p| self.axis.dot(&p.coords) - self.at)
            .collect();
        let mut sides: Vec<bool> = heights.iter().map(|height| *height > 0.0).collect();
        for round in 0..ROUNDS {
            let is_sure = |height: f64| round > 0 || height.abs() > UNSURE * self.radius;
            let outline = |side: bool| outline(points, |i| sides[i] == side && is_sure(heights[i]));
            let (Some(below), Some(above)) = (outline(false), outline(true)) else {
                break;
            };
            let mut is_changed = false;
            for (i, point) in points.iter().enumerate() {
                if heights[i].abs() < BESIDE * self.radius {
                    let side = above.distance(point) < below.distance(point);
                    is_changed |= sides[i] != side;
                    sides[i] = side;
                }
            }
            if !is_changed {
                break;
            }
        }
        sides
    }
}

/// Gives each point beside one of the necks to the grain whose outline it is nearest to.
pub(super) fn settle(places: &[Point3<f64>], grains: &mut [Vec<u32>], necks: &[Neck]) {
    let place = |&index: &u32| places[index as usize];
    let is_beside = |point: &Point3<f64>| {
        let mut necks = necks.iter();
        necks.any(|neck| (neck.axis.dot(&point.coords) - neck.at).abs() < BESIDE * neck.radius)
    };
    for _ in 0..ROUNDS {
        let outlines = grains.iter().map(|grain| {
            let own: Vec<Point3<f64>> = grain.iter().map(place).collect();
            Outline::through(&own)
        });
        let Some(outlines) = outlines.collect::<Option<Vec<_>>>() else {
            return;
        };
        let nearest = |point: &Point3<f64>, own: usize| {
            let others = (0..outlines.len()).filter(|_| is_beside(point));
            let nearest = others.min_by(|&one, &other| {
                let distance = |at: usize| outlines[at].distance(point);
                distance(one).total_cmp(&distance(other))
            });
            nearest.unwrap_or(own)
        };
        let mut settled = vec![Vec::new(); grains.len()];
        for (own, grain) in grains.iter().enumerate() {
            for index in grain {
                settled[nearest(&place(index), own)].push(*index);
            }
        }
        for grain in &mut settled {
            grain.sort_unstable();
        }
        let is_same = settled == grains;
        if settled.iter().any(|grain| grain.len() < LEAST_POINTS) {
            return;
        }
        grains.clone_from_slice(&settled);
        if is_same {
            return;
        }
    }
}

/// The smallest section along an axis between larger ones.
fn narrowest(
    rays: &[Vector3<f64>],
    axis: &Vector3<f64>,
    distance: f64,
    least_side: f64,
) -> Option<Neck> {
    let heights: Vec<f64> = rays.iter().map(|ray| axis.dot(ray)).collect();
    let (low, high) = heights
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
            (low.min(*h), high.max(*h))
        });
    let slabs = (((high - low) / distance) as usize).min(SLABS);
    let width = (high - low) / slabs as f64;
    let [u, v] = across(axis);
    let mut sums = vec![Sums::default(); slabs];
    for (ray, height) in rays.iter().zip(&heights) {
        let slab = (((height - low) / width) as usize).min(slabs.saturating_sub(1));
        sums.get_mut(slab)?.add(u.dot(ray), v.dot(ray));
    }
    let sections: Vec<f64> = sums.iter().map(Sums::section).collect();
    let largest = |sections: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
        sections
            .scan(0.0_f64, |largest, section| {
                *largest = largest.max(section);
                Some(*largest)
            })
            .collect()
    };
    let before = largest(&mut sections.iter().copied());
    let mut after = largest(&mut sections.iter().rev().copied());
    after.reverse();
    let mut below = 0.0;
    let mut best: Option<Neck> = None;
    let held = |slab: usize| sums.get(slab).map_or(1.0, |sums| sums.count.max(1.0));
    for slab in 0..slabs {
        let share = (below + 0.5 * sums[slab].count) / rays.len() as f64;
        below += sums[slab].count;
        let beside = before[slab].min(after[slab]);
        let ratio = sections[slab] / beside;
        if (least_side..=1.0 - least_side).contains(&share)
            && best.as_ref().is_none_or(|best| ratio < best.ratio)
        {
            best = Some(Neck {
                axis: *axis,
                at: low + (slab as f64 + 0.5) * width,
                width,
                ratio,
                outlined: ratio,
                held: sums[slab].count / held(slab.wrapping_sub(1)).max(held(slab + 1)),
                radius: (2.0 * beside).sqrt(),
            });
        }
    }
    best
}

/// Moments of places in a plane.
#[derive(Clone, Default)]
struct Sums {
    count: f64,
    first: Vector2<f64>,
    second: Matrix2<f64>,
}

impl Sums {
    fn add(&mut self, x: f64, y: f64) {
        let place = Vector2::new(x, y);
        self.count += 1.0;
        self.first += place;
        self.second += place * place.transpose();
    }

    /// What grows as the area of the section that the places lie round: half the squared radius of a circle.
    fn section(&self) -> f64 {
        let mean = self.first / self.count.max(1.0);
        let spread = self.second / self.count.max(1.0) - mean * mean.transpose();
        spread.determinant().max(0.0).sqrt()
    }
}
