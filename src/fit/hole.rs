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
//! with the larger one, h, in the middle.
//!
//! Measured on clouds of eight smooth bodies whose tips were cut off, a hole of some ten degrees: area, volume and moments were
//! up to 14 standard errors off. Of an almond whose pointed tip is missing over 9 degrees the length was so by 7, before the cone.

use super::gaps::{largest_caps, random_gap};
use crate::sphere::tangents;
use crate::spread::median;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Of what may be missing, or too much.
const SHARE: f64 = 0.5;

/// The cone goes through the surface at so many times the half-angle of the hole, for at its rim the surface bends to where the
/// prior draws it.
const ABOUT_RIM: [f64; 2] = [1.05, 1.25];

/// Points round a hole are looked at within so many times its half-angle.
const ROUND_HOLE: f64 = 2.0;

/// Lines of the cone.
const LINES: u32 = 16;

/// Holes that are looked at.
const MOST: usize = 3;

/// What so many random points would not leave empty.
#[derive(Debug, Clone, Default)]
pub(super) struct Holes {
    /// Half-angle of the largest cap of directions without a point, chance or not, in radians.
    pub(super) largest: f64,
    holes: Vec<Hole>,
}

/// A cap of directions in which there is no point.
#[derive(Debug, Clone, Copy)]
struct Hole {
    middle: Vector3<f64>,
    /// In radians.
    half_angle: f64,
    /// What may be missing, or too much, in the middle.
    height: f64,
}

impl Holes {
    /// Between points in these directions, of a surface with a place in each direction.
    pub(super) fn new(
        directions: &[Vector3<f64>],
        mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        let caps = largest_caps(directions, MOST);
        let is_no_chance = |(half_angle, middle): &(f64, Vector3<f64>)| {
            *half_angle > chance(directions, middle, *half_angle)
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

    pub(super) fn is_empty(&self) -> bool {
        self.holes.is_empty()
    }

    /// By how much the surface is uncertain in a direction, and the gradient of that.
    pub(super) fn hidden(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let each = self.holes.iter().map(|hole| hole.hidden(n));
        each.fold((0.0, Vector3::zeros()), |(sum, slope), (own, along)| {
            (sum + own, slope + along)
        })
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
        let missing = rim
            .tip_of_cone(&inner, &outer)
            .map_or(0.0, |tip| (tip - end).min(rim.radius));
        Self {
            middle,
            half_angle,
            height: bulge.max(end).max(missing),
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

/// The half-angle of gaps that points as dense as those round a hole leave by chance.
fn chance(directions: &[Vector3<f64>], middle: &Vector3<f64>, half_angle: f64) -> f64 {
    let outer = (ROUND_HOLE * half_angle).min(PI);
    let rim = outer.cos();
    let beside = directions.iter().filter(|n| n.dot(middle) > rim).count();
    // As shares of the sphere.
    let ring = 0.5 * (half_angle.cos() - rim);
    random_gap((beside as f64 / ring) as usize)
}

/// The places of a surface in a ring of directions about the middle, counter-clockwise as seen from outside.
fn ring(
    middle: &Vector3<f64>,
    half_angle: f64,
    mut place: impl FnMut(&Vector3<f64>) -> Vector3<f64>,
) -> Vec<Vector3<f64>> {
    let [u, v] = tangents(middle);
    let (sin, cos) = half_angle.sin_cos();
    let lines = (0..LINES).map(|line| (TAU * f64::from(line) / f64::from(LINES)).sin_cos());
    let directions =
        lines.map(|(along_v, along_u)| middle * cos + (u * along_u + v * along_v) * sin);
    directions.map(|n| place(&n)).collect()
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

    /// The height at which lines from an outer ring through this one meet above the middle: the median. `None` where they do not.
    fn tip_of_cone(&self, inner: &[Vector3<f64>], outer: &[Vector3<f64>]) -> Option<f64> {
        let tips = inner.iter().zip(outer).map(|(inner, outer)| {
            let (near, far) = (self.off_axis(inner), self.off_axis(outer));
            let (high, low) = (self.height(inner), self.height(outer));
            match far > near {
                true => high + near * (high - low) / (far - near),
                false => f64::INFINITY,
            }
        });
        median(&mut tips.collect::<Vec<_>>()).filter(|tip| tip.is_finite())
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
    fn hole(holes: &Holes) -> Hole {
        let [hole] = holes.holes[..] else {
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
        let hole = hole(&Holes::new(&without_cap(20.0), cone));
        assert_relative_eq!(hole.height, 0.8 * 20_f64.to_radians(), max_relative = 0.1);
    }

    #[test]
    fn what_even_points_leave_is_chance() {
        assert!(Holes::new(&without_cap(0.0), |n| *n).is_empty());
    }
}
