use super::*;
use crate::measure::integrals::nodes::curved_nodes;
use crate::model::{Frame, Radial, Superquadric, SuperquadricGrain};
use crate::shapes::{Body, Ellipsoid, Sampling};
use approx::assert_relative_eq;
use nalgebra::Rotation3;

/// Share of the largest curvature to which that of a cusp is known.
const CUSP: f64 = 1e-3;

/// An ellipsoid as the superquadric it is, turned so that no node lies on its tips.
fn ellipsoid(semi_axes: [f64; 3]) -> SuperquadricGrain {
    let turn = Rotation3::from_euler_angles(0.3, 0.5, 0.7).into_inner();
    let frame = Frame {
        axes: turn,
        ..Frame::SCAN
    };
    SuperquadricGrain::single(frame, Superquadric::single(semi_axes, 2.0, 2.0).unwrap()).unwrap()
}

#[test]
fn tips_of_ellipsoids_have_their_closed_form() {
    for [a, b, c] in [
        [3.0, 2.0, 1.0],
        [5.0, 1.0, 1.0],
        [20.0, 1.0, 1.0],
        [2.0, 2.0, 1.0],
        [9.0, 8.0, 1.0],
    ] {
        let grain = ellipsoid([a, b, c]);
        let nodes = curved_nodes(&grain);
        let sharpest = highest(&grain, &nodes, &[], |[larger, _]| larger);
        assert_relative_eq!(sharpest.value, a / (c * c), max_relative = TOLERANCE);
        let gaussian = highest(&grain, &nodes, &[], |[larger, smaller]| larger * smaller);
        assert_relative_eq!(
            gaussian.value,
            (a / (b * c)).powi(2),
            max_relative = TOLERANCE
        );
        let flattest = highest(&grain, &nodes, &[], |[_, smaller]| -smaller);
        assert_relative_eq!(-flattest.value, c / (a * a), max_relative = TOLERANCE);
        if a > b {
            assert_relative_eq!(sharpest.place.norm(), a, max_relative = 1e-4);
        }
    }
}

#[test]
fn no_place_of_the_maize_kernel_is_higher() {
    let surface = Body::Maize.surface();
    let surface = Radial(surface.as_ref());
    let nodes = curved_nodes(&surface);
    for sign in [1.0, -1.0] {
        let found = highest(&surface, &nodes, &[], |[larger, smaller]| {
            sign * larger * smaller
        });
        let dense = Sampling::Fibonacci.directions(100_000, 0).unwrap();
        let sampled = dense
            .iter()
            .map(|n| sign * Curvature::new(n, &surface.jet(n)).gaussian());
        let sampled = sampled.fold(f64::NEG_INFINITY, f64::max);
        assert!(
            sampled <= found.value + TOLERANCE * found.value.abs(),
            "{sampled} {found:?}"
        );
        assert!(
            sampled > found.value - 0.01 * found.value.abs(),
            "{sampled} {found:?}"
        );
    }
}

#[test]
fn superquadrics_between_ellipsoid_and_box_are_flat_where_their_axes_leave_them() {
    for exponents in [[2.3, 2.8], [2.5, 2.2], [3.5, 2.1], [2.05, 6.0], [2.1, 2.5]] {
        let shape = Superquadric::single([3.0, 2.0, 1.0], exponents[0], exponents[1]).unwrap();
        let grain = SuperquadricGrain::single(Frame::SCAN, shape).unwrap();
        let nodes = curved_nodes(&grain);
        let largest = highest(&grain, &nodes, &[], |[larger, _]| larger).value;
        let least = highest(&grain, &nodes, &[], |[_, smaller]| -smaller).value;
        assert!(
            largest.is_finite() && least.abs() < CUSP * largest,
            "{least} {largest}"
        );
        let mean = highest(&grain, &nodes, &[], |[larger, smaller]| -larger - smaller).value;
        assert!(mean.abs() < CUSP * largest, "{mean} {largest}");
    }
}

#[test]
fn what_grows_without_bound_is_infinite_and_what_is_alike_everywhere_is_met_at_once() {
    let edged = Superquadric::single([1.0; 3], 1.5, 1.5).unwrap();
    let edged = Radial(&edged);
    let found = highest(&edged, &curved_nodes(&edged), &[], |[larger, _]| larger);
    assert_eq!(found.value, f64::INFINITY);
    let sphere = Ellipsoid {
        semi_axes: Vector3::repeat(2.0),
    };
    let sphere = Radial(&sphere);
    let found = highest(&sphere, &curved_nodes(&sphere), &[], |[larger, _]| larger);
    assert_relative_eq!(found.value, 0.5, max_relative = 1e-12);
    assert_eq!(
        highest(&sphere, &[], &[], |[larger, _]| larger).value,
        f64::NEG_INFINITY
    );
}
