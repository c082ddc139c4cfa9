//! What a hole between the points may hide.
//!
//! Over a hole the surface is the most likely one under a prior that is the same everywhere. A tip is sharper than that, and
//! one that broke off is flat. So errors hold, as one more standard deviation, [a share](SHARE) of what may be missing, or too
//! much, in the middle: the surface bulges over the plane of the hole's rim, and a body that bulges outwards ends below the tip
//! of the cone that is its surface about the rim. Over a cap of half-angle a about the direction c the radius is uncertain by
//!
//! ```text
//! share h (1 - cos a / (n.c)) / (1 - cos a)
//! ```
//!
//! with the larger one, h, in the middle.
//!
//! Measured on clouds of eight smooth bodies whose tips were cut off, a hole of some ten degrees: area, volume and moments were
//! up to 14 standard errors off. Of an almond whose pointed tip is missing over 9 degrees the length was so by 7, before the cone.

use crate::fit::gaps::{largest_caps, random_gap};
use crate::sphere::{HarmonicBasis, tangents};
use crate::spread::median;
use crate::vectorize::dot;
use nalgebra::{Vector2, Vector3};
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
    /// Half-angle of the largest cap of directions of the stretched space without a point, chance or not, in radians.
    pub(super) largest: f64,
    holes: Vec<Hole>,
}

/// A cap of directions of the stretched space in which there is no point.
#[derive(Debug, Clone, Copy)]
struct Hole {
    middle: Vector3<f64>,
    /// In radians.
    half_angle: f64,
    /// What may be missing, or too much, in the middle, in units of the mean.
    height: f64,
}

impl Holes {
    /// Between points in these directions, of a surface of this degree with these coefficients.
    pub(super) fn new(directions: &[Vector3<f64>], degree: usize, coefficients: &[f64]) -> Self {
        let caps = largest_caps(directions, MOST);
        let is_no_chance = |(half_angle, middle): &(f64, Vector3<f64>)| {
            *half_angle > chance(directions, middle, *half_angle)
        };
        let largest = caps.first().map_or(0.0, |(half_angle, _)| *half_angle);
        let basis = HarmonicBasis::new(degree);
        let mut harmonics = vec![0.0; coefficients.len()];
        let mut radius = |n: &Vector3<f64>| {
            basis.evaluate(n, &mut harmonics);
            dot(&harmonics, coefficients)
        };
        let caps = caps.into_iter().filter(is_no_chance);
        Self {
            largest,
            holes: caps
                .map(|(half_angle, middle)| Hole::new(half_angle, middle, &mut radius))
                .collect(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.holes.is_empty()
    }

    /// By how much the radius is uncertain in a direction, in units of the mean, and the gradient of that.
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
        mut radius: impl FnMut(&Vector3<f64>) -> f64,
    ) -> Self {
        let end = radius(&middle);
        let bulge = end * (1.0 - half_angle.cos());
        let missing = tip_of_cone(&middle, half_angle, radius).map_or(0.0, |tip| tip - end);
        // A tip as far off as the hole is wide: steeper cones may not close at all.
        let most = end * half_angle.sin();
        Self {
            middle,
            half_angle,
            height: bulge.max(missing.min(most)),
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

/// How far from the centre the lines of a surface that go through its points about a hole meet above its middle: the median.
/// `None` where they do not.
fn tip_of_cone(
    middle: &Vector3<f64>,
    half_angle: f64,
    mut radius: impl FnMut(&Vector3<f64>) -> f64,
) -> Option<f64> {
    let [u, v] = tangents(middle);
    let angles = ABOUT_RIM.map(|times| times * half_angle);
    let tips = (0..LINES).map(|line| {
        let (sin, cos) = (TAU * f64::from(line) / f64::from(LINES)).sin_cos();
        let across = u * cos + v * sin;
        let [inner, outer] = angles.map(|angle| {
            let (sin, cos) = angle.sin_cos();
            Vector2::new(sin, cos) * radius(&(middle * cos + across * sin))
        });
        let wider = outer.x - inner.x;
        match wider > 0.0 {
            true => inner.y + inner.x * (inner.y - outer.y) / wider,
            false => f64::INFINITY,
        }
    });
    median(&mut tips.collect::<Vec<_>>()).filter(|tip| tip.is_finite())
}

#[cfg(test)]
mod tests {
    use super::super::functionals::RingSurface;
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn half_of_the_cap_over_the_rim_may_be_missing() {
        let mut directions = fibonacci(3000);
        directions.retain(|n| n.z < 20_f64.to_radians().cos());
        let estimate = estimated(&samples(&directions, |_| 3.0, 0.001), Vector3::repeat(3.0));
        let holes = estimate.holes();
        assert_relative_eq!(holes.largest.to_degrees(), 20.0, epsilon = 1.0);
        let [hole] = holes.holes[..] else {
            panic!("{holes:?}");
        };
        // The cone ends as far above a ball as this lies above the plane, and is told by lines farther out.
        let (height, cone) = (
            1.0 - hole.half_angle.cos(),
            1.0 / hole.half_angle.cos() - 1.0,
        );
        let (middle, slope) = hole.hidden(&hole.middle);
        assert!(middle > 0.5 * cone && middle < 0.8 * cone, "{middle}");
        assert!(slope.norm() < 1e-12);
        assert_eq!(hole.hidden(&Vector3::x()).0, 0.0);
        let surface = RingSurface::new(&estimate);
        let added = surface.moments_with(|n| holes.hidden(n)).volume - surface.moments().volume;
        let cap = 27.0 * PI * height * height * (3.0 - height) / 3.0;
        assert_relative_eq!(added, middle / height * cap, max_relative = 0.1);
        // What a ball of even points leaves is chance.
        let estimate = estimated(
            &samples(&fibonacci(3000), |_| 3.0, 0.001),
            Vector3::repeat(3.0),
        );
        assert!(estimate.holes().is_empty());
    }
}
