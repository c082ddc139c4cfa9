//! Where a surface reaches farthest in a direction: the point by which it touches a plane.

use super::Curvature;
use super::shortened::shortened;
use crate::model::Surface;
use crate::sphere::{compass, unit};
use nalgebra::{Matrix3, Vector3};

/// Cells along a cube's edge of the directions that the search starts from: 6146 directions, 3 degrees
/// apart. A maximum narrower than that can be missed.
const START: usize = 32;

/// The search climbs from so many of the highest directions that are not below a neighbour: a narrow horn rises
/// between them, and one of them may be higher than another that starts higher.
const MOST_PEAKS: usize = 8;

/// Most steps of Newton's iteration, which takes some five.
const MAX_STEPS: usize = 200;

/// The first step of the compass search, in radians.
const FIRST_STEP: f64 = 0.05;

/// Angle below which the compass search ends, in radians: the surface point is then off by as much of
/// the radius.
const LEAST_STEP: f64 = 1e-12;

/// Largest angle between the normal and the direction looked for at a smooth point, in radians.
const SMOOTH: f64 = 1e-6;

/// The point of a surface that lies farthest in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// The direction n of the point.
    pub direction: Vector3<f64>,
    /// The point, seen from the surface's centre.
    pub point: Vector3<f64>,
    /// Curvature there: on an edge, that of one of its sides.
    pub curvature: Curvature,
    /// Whether the surface is smooth there, so that its normal is the direction looked for.
    pub is_smooth: bool,
}

/// The point of a surface farthest in the direction `towards`, of any length but zero.
///
/// The peaks of a grid of directions are refined by Newton's iteration on the normal, and where that
/// does not climb (on an edge or an apex) by a compass search. Error: rounding at a smooth point, 1e-12
/// of the radius on an edge.
pub fn support(surface: &(impl Surface + ?Sized), towards: &Vector3<f64>) -> Support {
    let towards = &unit(towards);
    let (directions, triangles) = surface.grid(START);
    let places = surface.places(&directions).into_iter();
    let heights: Vec<f64> = places.map(|place| place.dot(towards)).collect();
    let found = peaks(&heights, &triangles)
        .into_iter()
        .map(|at| support_near(surface, towards, &directions[at]));
    let higher = |one: &Support, other: &Support| {
        let [one, other] = [one, other].map(|found| found.point.dot(towards));
        one.total_cmp(&other)
    };
    let highest = found.max_by(higher);
    highest.unwrap_or_else(|| support_near(surface, towards, towards))
}

/// The highest of the vertices that are below no neighbour, by their heights.
fn peaks(heights: &[f64], triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut is_peak = vec![true; heights.len()];
    for &[a, b, c] in triangles {
        for (one, other) in [(a, b), (b, c), (c, a)].map(|(a, b)| (a as usize, b as usize)) {
            is_peak[one] &= heights[one] >= heights[other];
            is_peak[other] &= heights[other] >= heights[one];
        }
    }
    let mut peaks: Vec<usize> = (0..heights.len()).filter(|&at| is_peak[at]).collect();
    peaks.sort_by(|&one, &other| heights[other].total_cmp(&heights[one]));
    peaks.truncate(MOST_PEAKS);
    peaks
}

/// The same, from a start that is known to lie on the way to it.
pub(crate) fn support_near(
    surface: &(impl Surface + ?Sized),
    towards: &Vector3<f64>,
    start: &Vector3<f64>,
) -> Support {
    let height = |n: &Vector3<f64>| surface.place(n).dot(towards);
    let climbed = newton(surface, towards, *start, height);
    let found = at(surface, towards, &climbed);
    match found.is_smooth {
        true => found,
        false => at(
            surface,
            towards,
            &compass(climbed, FIRST_STEP, LEAST_STEP, height).0,
        ),
    }
}

fn at(surface: &(impl Surface + ?Sized), towards: &Vector3<f64>, n: &Vector3<f64>) -> Support {
    let jet = surface.jet(n);
    let curvature = Curvature::new(n, &jet);
    Support {
        direction: *n,
        point: jet.place,
        curvature,
        is_smooth: curvature.normal.cross(towards).norm() < SMOOTH
            && curvature.normal.dot(towards) > 0.0,
    }
}

/// Climbs from `n` as long as it gets higher: along the surface by the turn of the normal over the
/// curvature, shortened where that leads down.
fn newton(
    surface: &(impl Surface + ?Sized),
    towards: &Vector3<f64>,
    mut n: Vector3<f64>,
    height: impl Fn(&Vector3<f64>) -> f64,
) -> Vector3<f64> {
    let mut highest = height(&n);
    for _ in 0..MAX_STEPS {
        let curvature = Curvature::new(&n, &surface.jet(&n));
        let across = Matrix3::identity() - curvature.normal * curvature.normal.transpose();
        let turn = across * towards;
        let size = curvature.area().sqrt();
        let step: Vector3<f64> = curvature
            .principal
            .into_iter()
            .zip(curvature.directions)
            .map(|(k, direction)| {
                // A flat or hollow place is climbed by steps of its own size.
                let k = k.max(0.1 / size);
                direction * (turn.dot(&direction) / k)
            })
            .sum();
        let step = curvature.turn(&step);
        let gains = |next: &Vector3<f64>| Some(height(next)).filter(|height| *height > highest);
        match shortened(&n, &step, gains) {
            Some((next, height)) => (n, highest) = (next, height),
            None => break,
        }
    }
    n
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Radial;
    use crate::shapes::{Body, Bump, Bumpy, Cuboid, Ellipsoid, Sampling, Sphere};
    use approx::assert_relative_eq;
    use std::f64::consts::FRAC_PI_2;

    /// The farthest point of an ellipsoid along d is (a² d_x, b² d_y, c² d_z) / |(a d_x, b d_y, c d_z)|.
    #[test]
    fn ellipsoids_reach_to_their_closed_form() {
        for axes in [[2.0, 2.0, 1.0], [3.0, 1.0, 0.5], [1.0, 1.0, 1.0]] {
            let semi_axes = Vector3::from(axes);
            for towards in Sampling::Cube.directions(98, 0).unwrap() {
                let scaled = semi_axes.component_mul(&towards);
                let exact = semi_axes.component_mul(&scaled) / scaled.norm();
                let found = support(&Radial(&Ellipsoid { semi_axes }), &towards);
                assert!(found.is_smooth, "{towards}");
                assert_relative_eq!(found.point, exact, epsilon = 1e-7);
                let height = found.point.dot(&towards);
                assert_relative_eq!(height, scaled.norm(), max_relative = 1e-14);
            }
        }
    }

    #[test]
    fn grains_are_not_seen_above_it() {
        for body in [Body::Bean, Body::Chickpea, Body::Maize] {
            let surface = body.surface();
            let directions = Sampling::Fibonacci.directions(5000, 0).unwrap();
            for towards in Sampling::Fibonacci.directions(60, 0).unwrap() {
                let found = support(&Radial(surface.as_ref()), &towards);
                assert!(found.is_smooth, "{body} along {towards}");
                let height = found.point.dot(&towards);
                for n in &directions {
                    assert!(surface.radius(n) * n.dot(&towards) <= height);
                }
            }
        }
    }

    /// The lower horn is on a direction of the grid, the higher in the middle of a cell.
    #[test]
    fn the_higher_of_two_narrow_horns_is_found() {
        let at = |x: f64, y: f64| [x, y].map(|steps| (steps * FRAC_PI_2 / START as f64).tan());
        let horn = |height: f64, [x, y]: [f64; 2]| Bump::round(height, 1000.0, [x, y, 1.0]);
        let horns = Bumpy {
            base: Sphere { radius: 1.0 },
            bumps: vec![horn(0.30, at(-4.0, 0.0)), horn(0.32, at(4.5, 0.5))],
        };
        let found = support(&Radial(&horns), &Vector3::z());
        assert!(found.direction.x > 0.0, "{}", found.direction);
    }

    #[test]
    fn a_corner_is_found_and_told_from_a_smooth_point() {
        let cuboid = Cuboid {
            half_edges: Vector3::new(1.0, 2.0, 3.0),
        };
        let found = support(&Radial(&cuboid), &Vector3::new(0.5, 0.6, 0.7).normalize());
        assert!(!found.is_smooth);
        assert_relative_eq!(found.point, Vector3::new(1.0, 2.0, 3.0), epsilon = 1e-9);
    }
}
