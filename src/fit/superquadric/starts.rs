//! Where the fit of one superquadric begins.

use super::bodies::Body;
use super::cloud::Cloud;
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::f64::consts::FRAC_PI_4;
use std::ops::RangeInclusive;

/// The orders of axes that make different bodies.
const ORDERS: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];

/// The semi-axis over the standard deviation of points on a sphere.
const PER_DEVIATION: f64 = 1.732_050_807_568_877_2;

/// Ratios of semi-axes that are nearly alike.
const ALIKE: RangeInclusive<f64> = 0.6..=1.0 / 0.6;

/// The logarithm by which a body that leans is longer to one side, and shorter to the other.
const LEAN: f64 = 0.3;

/// The ellipsoid of equal second moments in three orders of axes.
pub(super) fn upright(cloud: &Cloud) -> impl Iterator<Item = Body> {
    ORDERS.into_iter().map(|order| {
        let axes = order.map(|i| cloud.axes.column(i).into_owned());
        let semi_axes = Vector3::from(order.map(|i| cloud.deviations[i] * PER_DEVIATION));
        Body::start(Vector3::zeros(), Matrix3::from_columns(&axes), semi_axes)
    })
}

/// A body with its axes in the two other orders, and in all three turned by half a right angle about the third where the
/// others are nearly alike: a box that lies along another axis, or is seen along its diagonals, may be a minimum, too (Liu
/// et al. 2022).
pub(super) fn turned(body: &Body) -> impl Iterator<Item = Body> {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_4);
    let ordered = ORDERS.map(|order| {
        let semi_axis = |i: usize| (0.5 * (body.logs[2 * i] + body.logs[2 * i + 1])).exp();
        let axes = order.map(|i| body.axes.column(i).into_owned());
        let semi_axes = Vector3::from(order.map(semi_axis));
        Body::start(body.centre, Matrix3::from_columns(&axes), semi_axes)
    });
    let diagonal = ordered.into_iter().filter_map(move |start| {
        let [a, b, c] = [0, 2, 4].map(|i| start.logs[i].exp());
        let across = (a * b).sqrt();
        ALIKE.contains(&(a / b)).then(|| {
            let axes = start.axes * turn.into_inner();
            Body::start(start.centre, axes, Vector3::new(across, across, c))
        })
    });
    ordered.into_iter().skip(1).chain(diagonal)
}

/// A body that leans to one side along each of its axes, in all ways: a body that is nearly alike on both sides may be a
/// saddle, which fits leave to whichever side rounding has it.
pub(super) fn leaning(body: &Body) -> impl Iterator<Item = Body> {
    (0..8).map(|way| {
        let mut leaning = *body;
        for axis in 0..3 {
            let lean = if way >> axis & 1 == 0 { LEAN } else { -LEAN };
            let sides = [2 * axis, 2 * axis + 1];
            let width = |body: &Body| sides.map(|side| body.logs[side].exp());
            let [positive, negative] = width(body);
            let middle = (0.5 * (positive + negative)).ln();
            leaning.logs[sides[0]] = middle + lean;
            leaning.logs[sides[1]] = middle - lean;
            let [longer, shorter] = width(&leaning);
            let aside = 0.5 * ((positive - negative) - (longer - shorter));
            leaning.centre += body.axes.column(axis) * aside;
        }
        leaning
    })
}
