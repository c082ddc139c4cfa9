//! The overlap of two bodies along a line.

use super::pair::ConvexPair;
use crate::model::Superquadric;
use nalgebra::Vector3;

/// Steps allowed to a way out; from a point near the surface it takes three.
const MAX_STEPS: usize = 50;

/// A step below this share of the way from the centre is the last.
const LAST_STEP: f64 = 1e-10;

/// How far the first body reaches beyond where the second begins, along the line through `point`: of ellipsoids a closed
/// form, otherwise Newton's iteration on both gauges, which are convex along the line, outwards from the point; or, where
/// a gauge does not grow along the line there, as at the body's centre, from beyond the body.
pub(super) fn overlap(pair: &ConvexPair<'_>, point: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    let bodies = [pair.first, pair.second];
    let from = [*point, pair.seen_from_second(point)];
    let along = [*normal, -pair.turn.tr_mul(normal)];
    if let [Some(first), Some(second)] = bodies.map(Superquadric::ellipsoid) {
        return way_out(first, &from[0], &along[0]) + way_out(second, &from[1], &along[1]);
    }
    let mut ways = [0.0; 2];
    for _ in 0..MAX_STEPS {
        let places = [0, 1].map(|i| from[i] + along[i] * ways[i]);
        let gauges = Superquadric::gauges_and_slopes(bodies, places.each_ref());
        let steps = [0, 1].map(|i| {
            let (gauge, slope) = (gauges[i].0, gauges[i].1.dot(&along[i]));
            match slope > 0.0 || ways[i] != 0.0 {
                true => (1.0 - gauge) / slope,
                false => 2.0 * bodies[i].bounding_radius(),
            }
        });
        let is_long = |i: usize| steps[i].abs() > LAST_STEP * places[i].norm();
        ways = [0, 1].map(|i| ways[i] + steps[i]);
        // Written so that NaN ends.
        if !(is_long(0) || is_long(1)) {
            break;
        }
    }
    ways[0] + ways[1]
}

/// How far along a unit vector it is to where a line through a point leaves an ellipsoid.
fn way_out(semi_axes: [f64; 3], from: &Vector3<f64>, along: &Vector3<f64>) -> f64 {
    let semi_axes = Vector3::from(semi_axes);
    let [from, along] = [from, along].map(|v| v.component_div(&semi_axes));
    let (square, half) = (along.norm_squared(), from.dot(&along));
    let rest = from.norm_squared() - 1.0;
    let root = (half * half - square * rest).max(0.0).sqrt();
    match half > 0.0 {
        true => -rest / (half + root),
        false => (root - half) / square,
    }
}
