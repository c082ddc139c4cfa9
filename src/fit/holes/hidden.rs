//! What a hole between the points may hide.
//!
//! Over a hole the surface is the most likely one under a prior that is the same everywhere, or the smoothest one. A tip is sharper
//! than that, and one that broke off is flat. So errors hold, as one more standard deviation, [a share](SHARE) of what may be
//! missing, or too much, in the middle: the surface bulges over the plane of the hole's rim, and a body that bulges outwards ends
//! below the tip of the cone that is its surface about the rim. Over a cap of half-angle a about the direction c the surface is
//! uncertain by
//!
//! ```text
//! share h (1 - cos a / (n.c)) / (1 - cos a)
//! ```
//!
//! with the larger one, h, in the middle. What reaches farthest may be a corner beside the middle, and as far out as lines from some
//! sides only tell: h is then the upper quartile of where lines of the cone end, and elsewhere the median.
//!
//! Measured on clouds of eight smooth bodies whose tips were cut off, a hole of some ten degrees: area, volume and moments were
//! up to 14 standard errors off. Of an almond whose pointed tip is missing over 9 degrees the length was so by 7, before the cone.

use super::empty_caps::{Gaps, gap};
use crate::sphere::tangents;
use crate::spread::{upper_median, upper_quartile};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use std::iter;

/// Of what may be missing, or too much.
const SHARE: f64 = 0.5;

/// The cone goes through the surface at so many times the half-angle of the hole, for at its rim the surface bends to where the
/// prior draws it.
const ABOUT_RIM: [f64; 2] = [1.05, 1.25];

/// Points round a hole are looked at within so many times its half-angle.
const ROUND_HOLE: f64 = 2.0;

/// Rings in a hole on which the surface may reach far, as the middle may, over its half-angle.
const IN_HOLE: [f64; 2] = [0.35, 0.7];

/// Lines of the cone.
const LINES: u32 = 16;

/// Holes that are looked at; a slit is several of them.
const MOST: usize = 8;

/// What so many random points would not leave empty.
#[derive(Debug, Clone, Default)]
pub(in crate::fit) struct Holes {
    /// Half-angle of the largest cap of directions without a point, chance or not, in radians.
    pub(in crate::fit) largest: f64,
    holes: Vec<Hole>,
}

/// A cap of directions in which there is no point.
#[derive(Debug, Clone)]
struct Hole {
    middle: Vector3<f64>,
    /// In radians.
    half_angle: f64,
    /// What may be missing, or too much, in the middle.
    height: f64,
    /// Places in the middle and round it, if all is missing that may be where it has a corner.
    farthest: Vec<Vector3<f64>>,
}

impl Holes {
    /// Between points in these directions, of a surface with a place in each direction.
    pub(in crate::fit) fn new(
        directions: &[Vector3<f64>],
        mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        let gaps = Gaps::new(directions);
        let (caps, less) = (gaps.largest(MOST), gaps.evenness());
        let is_no_chance = |(half_angle, middle): &(f64, Vector3<f64>)| {
            *half_angle > chance(directions, middle, *half_angle, less)
        };
        let largest = caps.first().map_or(0.0, |(half_angle, _)| *half_angle);
        let caps = caps.into_iter().filter(is_no_chance);
        Self {
            largest,
            holes: caps
                .map(|(half_angle, middle)| Hole::new(half_angle, middle, &mut place))
                .collect(),
        }
    }

    pub(in crate::fit) fn is_empty(&self) -> bool {
        self.holes.is_empty()
    }

    /// By how much the surface is uncertain to reach farther than `height` along a unit vector: the share of how much farther it does
    /// in the holes, if all that may be missing is.
    pub(in crate::fit) fn beyond(&self, towards: &Vector3<f64>, height: f64) -> f64 {
        let places = self.holes.iter().flat_map(|hole| &hole.farthest);
        let heights = places.map(|place| place.dot(towards) - height);
        SHARE * heights.fold(0.0, f64::max)
    }

    /// By how much the surface is uncertain in a direction, and the gradient of that.
    pub(in crate::fit) fn hidden(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let each = self.holes.iter().map(|hole| hole.hidden(n));
        let most = each.max_by(|one, other| one.0.total_cmp(&other.0));
        most.unwrap_or_default()
    }
}

impl Hole {
    fn new(
        half_angle: f64,
        middle: Vector3<f64>,
        mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        let [inner, outer] = ABOUT_RIM.map(|times| ring(&middle, times * half_angle, &mut place));
        let rim = Rim::new(&inner);
        let end = rim.height(&place(&middle));
        let bulge = rim.radius * (0.5 * half_angle).tan();
        // A tip as far off as the hole is wide: steeper cones may not close at all.
        let missing = |tip: f64| (tip - end).min(rim.radius);
        let mut tips = rim.tips(&inner, &outer);
        let cone = upper_median(&mut tips).filter(|tip| tip.is_finite());
        let cone = cone.map_or(0.0, missing);
        // Beside a corner lines from some sides meet the axis far above those from others.
        let most = upper_quartile(&mut tips).map_or(0.0, missing);
        let on_rings = IN_HOLE.into_iter().flat_map(|share| {
            let raised = most * (1.0 - share * share);
            let ring = directions(&middle, share * half_angle);
            ring.map(move |n| (n, raised))
        });
        let farthest = iter::once((middle, most)).chain(on_rings);
        let farthest = farthest.map(|(n, raised)| place(&n) + n * raised).collect();
        Self {
            middle,
            half_angle,
            height: bulge.max(end).max(cone),
            farthest,
        }
    }

    fn hidden(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (rim, along) = (self.half_angle.cos(), n.dot(&self.middle));
        if along <= rim || along <= 0.0 {
            return (0.0, Vector3::zeros());
        }
        let most = SHARE * self.height / (1.0 - rim);
        let across = self.middle - n * along;
        (
            most * (1.0 - rim / along),
            across * (most * rim / (along * along)),
        )
    }
}

/// The half-angle of gaps that points as dense as those round a hole leave by chance, `less` of the sphere than random ones.
fn chance(directions: &[Vector3<f64>], middle: &Vector3<f64>, half_angle: f64, less: f64) -> f64 {
    let outer = (ROUND_HOLE * half_angle).min(PI);
    let rim = outer.cos();
    let beside = directions.iter().filter(|n| n.dot(middle) > rim).count();
    // As shares of the sphere.
    let ring = 0.5 * (half_angle.cos() - rim);
    gap((beside as f64 / ring) as usize, less)
}

/// The places of a surface in a ring of directions about the middle, counter-clockwise as seen from outside.
fn ring(
    middle: &Vector3<f64>,
    half_angle: f64,
    mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>,
) -> Vec<Vector3<f64>> {
    directions(middle, half_angle).map(|n| place(&n)).collect()
}

/// A ring of directions about the middle, likewise.
fn directions(middle: &Vector3<f64>, half_angle: f64) -> impl Iterator<Item = Vector3<f64>> {
    let [u, v] = tangents(middle);
    let (sin, cos) = half_angle.sin_cos();
    let lines = (0..LINES).map(|line| (TAU * f64::from(line) / f64::from(LINES)).sin_cos());
    let middle = *middle;
    lines.map(move |(along_v, along_u)| middle * cos + (u * along_u + v * along_v) * sin)
}

/// The plane of a ring of places.
struct Rim {
    centre: Vector3<f64>,
    normal: Vector3<f64>,
    /// Mean distance of the places from the centre, within the plane.
    radius: f64,
}

impl Rim {
    fn new(ring: &[Vector3<f64>]) -> Self {
        let count = ring.len() as f64;
        let centre = ring.iter().sum::<Vector3<f64>>() / count;
        let next = ring.iter().cycle().skip(1);
        let area: Vector3<f64> = ring
            .iter()
            .zip(next)
            .map(|(a, b)| (a - centre).cross(&(b - centre)))
            .sum();
        let mut rim = Self {
            centre,
            normal: area.try_normalize(0.0).unwrap_or_default(),
            radius: 0.0,
        };
        rim.radius = ring.iter().map(|place| rim.off_axis(place)).sum::<f64>() / count;
        rim
    }

    /// Above the plane.
    fn height(&self, place: &Vector3<f64>) -> f64 {
        self.normal.dot(&(place - self.centre))
    }

    fn off_axis(&self, place: &Vector3<f64>) -> f64 {
        self.normal.cross(&(place - self.centre)).norm()
    }

    /// The heights at which lines from an outer ring through this one meet the axis; infinite where they do not.
    fn tips(&self, inner: &[Vector3<f64>], outer: &[Vector3<f64>]) -> Vec<f64> {
        let tips = inner.iter().zip(outer).map(|(inner, outer)| {
            let (near, far) = (self.off_axis(inner), self.off_axis(outer));
            let (high, low) = (self.height(inner), self.height(outer));
            match far > near {
                true => high + near * (high - low) / (far - near),
                false => f64::INFINITY,
            }
        });
        tips.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use approx::assert_relative_eq;

    /// Directions without those within so many degrees of the pole.
    fn without_cap(degrees: f64) -> Vec<Vector3<f64>> {
        let mut directions = Sampling::Fibonacci.directions(3000, 0).unwrap();
        directions.retain(|n| n.z < degrees.to_radians().cos());
        directions
    }

    /// The one hole that is no chance.
    fn hole(holes: &Holes) -> &Hole {
        let [hole] = &holes.holes[..] else {
            panic!("{holes:?}");
        };
        hole
    }

    #[test]
    fn half_of_what_the_cone_about_a_rim_holds_may_be_missing() {
        let holes = Holes::new(&without_cap(20.0), |n| n * 3.0);
        assert_relative_eq!(holes.largest.to_degrees(), 20.0, epsilon = 1.0);
        let hole = hole(&holes);
        // The cone ends as far above a ball as this, and is told by lines farther out.
        let cone = 3.0 * (1.0 / hole.half_angle.cos() - 1.0);
        let (middle, slope) = hole.hidden(&hole.middle);
        assert!(middle > 0.5 * cone && middle < 0.8 * cone, "{middle}");
        assert!(slope.norm() < 1e-12);
        assert_eq!(hole.hidden(&Vector3::x()).0, 0.0);
        let even = Sampling::Fibonacci.directions(100_000, 0).unwrap();
        let mean = even.iter().map(|n| holes.hidden(n).0).sum::<f64>() / even.len() as f64;
        let height = 3.0 * (1.0 - hole.half_angle.cos());
        let cap = PI * height * height * (9.0 - height) / 3.0;
        assert_relative_eq!(
            9.0 * 4.0 * PI * mean,
            middle / height * cap,
            max_relative = 0.1
        );
    }

    #[test]
    fn the_tip_of_a_cone_is_told_wherever_it_points() {
        // A cone below a flat end.
        let (along, across) = (Vector3::y(), [Vector3::z(), Vector3::x()]);
        let centre = Vector3::new(5.0, 0.0, 1.0);
        let cone = |n: &Vector3<f64>| {
            let off = n.z.clamp(-1.0, 1.0).acos();
            let fall = 0.8 * (off - 20_f64.to_radians()).max(0.0);
            let aside = n.xy().try_normalize(0.0).unwrap_or_default() * off;
            centre - along * fall + across[0] * aside.x + across[1] * aside.y
        };
        let holes = Holes::new(&without_cap(20.0), cone);
        let hole = hole(&holes);
        assert_relative_eq!(hole.height, 0.8 * 20_f64.to_radians(), max_relative = 0.1);
    }

    #[test]
    fn a_body_may_reach_as_far_as_the_corner_that_its_sides_end_in() {
        // A cube on its corner, which is cut off level.
        let corner = Vector3::z();
        let sides = [0.0, 1.0, 2.0].map(|third: f64| {
            let (sin, cos) = (TAU * third / 3.0).sin_cos();
            Vector3::new(cos * 2.0_f64.sqrt(), sin * 2.0_f64.sqrt(), 1.0) / 3.0_f64.sqrt()
        });
        let end = 1.25;
        let cut = |n: &Vector3<f64>| {
            let along = sides.iter().map(|side| n.dot(side).abs());
            n / along.fold(n.dot(&corner) / end, f64::max)
        };
        let holes = Holes::new(&without_cap(22.0), cut);
        let missing = SHARE * (3.0_f64.sqrt() - end);
        let beyond = holes.beyond(&corner, end);
        assert!(
            (0.6..1.4).contains(&(beyond / missing)),
            "{beyond} {missing}"
        );
        // Aslant the corner may lie beside the middle.
        let aslant = Vector3::new(0.0, 20_f64.to_radians().sin(), 20_f64.to_radians().cos());
        let middle = SHARE * hole(&holes).farthest[0].dot(&aslant);
        assert!(holes.beyond(&aslant, 0.0) > 1.005 * middle, "{middle}");
        assert_eq!(holes.beyond(&-corner, 3.0_f64.sqrt()), 0.0);
        assert_eq!(Holes::default().beyond(&corner, 0.0), 0.0);
    }

    #[test]
    fn a_slit_is_several_holes() {
        let mut directions = Sampling::Fibonacci.directions(6000, 0).unwrap();
        directions.retain(|n| n.z < 0.5 || n.x.abs() > 12.0_f64.to_radians().sin());
        let holes = Holes::new(&directions, |n| *n);
        let along = [-0.6, -0.3, 0.0, 0.3, 0.6].map(|y: f64| Vector3::new(0.0, y, y.cos()));
        for n in along.map(|n| n.normalize()) {
            assert!(holes.hidden(&n).0 > 1e-3, "{n}");
        }
    }

    #[test]
    fn what_even_points_leave_is_chance() {
        assert!(Holes::new(&without_cap(0.0), |n| *n).is_empty());
    }
}
