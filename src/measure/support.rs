//! Where a surface reaches farthest in a direction: the point by which it touches a plane.

use super::Curvature;
use crate::model::Surface;
use crate::sphere::{compass, cube_grid};
use nalgebra::{Matrix3, Vector3};

/// Cells along a cube's edge of the directions that the search starts from: 1538 directions, 6 degrees
/// apart. A second maximum narrower than that can be missed.
const START: usize = 16;

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
/// The best of a grid of directions is refined by Newton's iteration on the normal, and where that
/// does not climb (on an edge or an apex) by a compass search. Error: rounding at a smooth point, 1e-12
/// of the radius on an edge.
pub fn support(surface: &(impl Surface + ?Sized), towards: &Vector3<f64>) -> Support {
    let towards = &towards.normalize();
    let (directions, _) = cube_grid(START);
    let heights = surface.places(&directions).into_iter();
    let start = directions
        .iter()
        .zip(heights.map(|place| place.dot(towards)))
        .fold((Vector3::z(), f64::NEG_INFINITY), |best, (n, height)| {
            if height > best.1 { (*n, height) } else { best }
        });
    support_near(surface, towards, &start.0)
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
        let tried = [1.0, 0.5, 0.25, 0.1, 0.01].into_iter().find_map(|share| {
            let next = (n + step * share).try_normalize(0.0)?;
            let height = height(&next);
            (height > highest).then_some((next, height))
        });
        match tried {
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
    use crate::shapes::{Body, Cuboid, Ellipsoid, Sampling};
    use approx::assert_relative_eq;

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
