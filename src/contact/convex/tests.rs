//! Contacts with a closed form, and contacts that are singular.

use super::*;
use crate::model::{Frame, Superquadric};
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

const METHODS: [Method; 3] = [Method::Minimax, Method::Portal, Method::Midway];

fn at(centre: Vector3<f64>) -> Frame {
    Frame {
        centre: Point3::from(centre),
        axes: Matrix3::identity(),
    }
}

#[test]
fn two_spheres_have_the_contact_of_spheres() {
    let (small, large) = (
        Superquadric::single([1.0; 3], 2.0, 2.0).unwrap(),
        Superquadric::single([2.0; 3], 2.0, 2.0).unwrap(),
    );
    let towards = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    for distance in [2.5, 2.99, 3.2] {
        let places = (at(Vector3::new(5.0, 1.0, 0.0)), towards * distance);
        let other = at(places.0.centre.coords + places.1);
        let pair = ConvexPair::new((&small, &places.0), (&large, &other));
        for method in METHODS {
            let contact = pair.resolved(method, 1e-6);
            let expected = match distance < 3.0 {
                true => ConvexStatus::Touching,
                false => ConvexStatus::Apart,
            };
            assert_eq!(contact.status, expected, "{method:?}");
            assert_relative_eq!(contact.ratio, distance / 3.0, max_relative = 1e-6);
            assert_relative_eq!(contact.normal, towards, epsilon = 1e-3);
            let middle = places.0.centre + places.1 / 3.0;
            assert_relative_eq!(contact.point, middle, epsilon = 1e-3);
            assert_relative_eq!(pair.overlap(&contact), 3.0 - distance, epsilon = 1e-5);
        }
    }
}

#[test]
fn stacked_faces_are_resolved_though_their_matrix_is_singular() {
    let cube = Superquadric::single([1.0; 3], 8.0, 8.0).unwrap();
    for aside in [0.0, 0.1, 0.5] {
        let other = at(Vector3::new(aside, 0.0, 1.95));
        let here = at(Vector3::zeros());
        let pair = ConvexPair::new((&cube, &here), (&cube, &other));
        for method in [Method::Minimax, Method::Portal] {
            let contact = pair.resolved(method, 1e-6);
            assert_eq!(contact.status, ConvexStatus::Touching);
            assert!(contact.gap <= 1e-6 && contact.normal.z > 0.99);
        }
    }
}

#[test]
fn bodies_with_one_centre_or_nearly_touch() {
    let body = Superquadric::single([3.0, 2.0, 1.0], 5.0, 3.0).unwrap();
    for offset in [0.0, 1e-300, 1e-12, 1e-3] {
        let turned = Frame {
            axes: Rotation3::from_euler_angles(0.3, 0.4, 0.5).into_inner(),
            ..at(Vector3::new(offset, offset, 0.0))
        };
        let here = at(Vector3::zeros());
        let contact = ConvexPair::new((&body, &here), (&body, &turned)).contact(None);
        assert_eq!(contact.status, ConvexStatus::Touching, "{offset}");
        assert!(contact.normal.norm() > 0.99 && contact.point.coords.norm() < 1.0);
    }
}

#[test]
fn the_last_normal_proves_bodies_apart_and_a_warm_start_is_short() {
    let body = Superquadric::single([3.0, 2.0, 1.0], 5.0, 3.0).unwrap();
    let here = at(Vector3::zeros());
    let other = Frame {
        axes: Rotation3::from_euler_angles(0.3, 0.4, 0.5).into_inner(),
        ..at(Vector3::new(4.2, 1.0, 0.5))
    };
    let cold = ConvexPair::new((&body, &here), (&body, &other)).contact(None);
    assert_eq!(cold.status, ConvexStatus::Touching);
    let warm = Warm {
        point: cold.point,
        normal: cold.normal,
    };
    let again = ConvexPair::new((&body, &here), (&body, &other)).contact(Some(&warm));
    assert_relative_eq!(again.ratio, cold.ratio, max_relative = 1e-6);
    assert!(again.iterations < cold.iterations);
    let away = Frame {
        centre: other.centre * 1.3,
        ..other
    };
    let apart = ConvexPair::new((&body, &here), (&body, &away)).contact(Some(&warm));
    assert_eq!((apart.status, apart.iterations), (ConvexStatus::Apart, 0));
}

#[test]
fn the_contact_turns_and_moves_with_the_bodies() {
    let one = Superquadric::poly12(
        [[1.0, 1.5], [2.0, 1.0], [0.7, 0.9]],
        [2.5, 4.0],
        [[2.0, 3.0], [5.0, 1.8]],
    )
    .unwrap();
    let other = Superquadric::single([1.0, 2.0, 0.5], 3.0, 6.0).unwrap();
    let places = [
        at(Vector3::zeros()),
        Frame {
            axes: Rotation3::from_euler_angles(-0.3, 1.4, 0.5).into_inner(),
            ..at(Vector3::new(0.9, 1.0, 1.0))
        },
    ];
    let turn = Rotation3::from_euler_angles(2.0, -0.7, 0.9);
    let moved = places.map(|frame| Frame {
        centre: turn * frame.centre + Vector3::new(100.0, -50.0, 3.0),
        axes: turn.matrix() * frame.axes,
    });
    let found = ConvexPair::new((&one, &places[0]), (&other, &places[1])).contact(None);
    let turned = ConvexPair::new((&one, &moved[0]), (&other, &moved[1])).contact(None);
    assert_relative_eq!(turned.ratio, found.ratio, max_relative = 1e-10);
    assert_relative_eq!(turned.normal, turn * found.normal, epsilon = 1e-9);
    // The other way round, the gap lets normals and points differ a little.
    let swapped = ConvexPair::new((&other, &places[1]), (&one, &places[0])).contact(None);
    assert_relative_eq!(swapped.ratio, found.ratio, max_relative = 2e-6);
    assert_relative_eq!(swapped.normal, -found.normal, epsilon = 1e-2);
}

#[test]
fn ellipsoids_have_the_contact_that_portal_refinement_finds() {
    let slender = Superquadric::single([5.0, 1.0, 0.2], 2.0, 2.0).unwrap();
    let round = Superquadric::single([1.0, 1.5, 0.7], 2.0, 2.0).unwrap();
    for i in 0..40 {
        let angle = 0.7 * f64::from(i);
        let towards = Rotation3::from_euler_angles(angle, 2.0 * angle, 0.3) * Vector3::x();
        let turned = Frame {
            axes: Rotation3::from_euler_angles(0.4, angle, -angle).into_inner(),
            ..at(towards * (0.5 + 0.05 * f64::from(i)))
        };
        let here = at(Vector3::zeros());
        let pair = ConvexPair::new((&slender, &here), (&round, &turned));
        let found = pair.resolved(Method::Minimax, 1e-10);
        let portal = pair.resolved(Method::Portal, 1e-8);
        assert!(found.gap <= 1e-10, "{i}: {found:?}");
        assert_relative_eq!(found.ratio, portal.ratio, max_relative = 1e-8);
        assert_relative_eq!(found.normal, portal.normal, epsilon = 1e-2);
        // The planes that touch both grown by the ratio, normal to it, are one.
        let [first, second] = pair.supports(&found.normal);
        let reach = found.normal.dot(&turned.centre.coords);
        assert_relative_eq!(
            found.ratio * (first.0 + second.0),
            reach,
            max_relative = 1e-8
        );
    }
}

#[test]
fn the_overlap_of_bodies_with_one_centre_is_how_far_both_reach() {
    let flat = Superquadric::single([3.0, 2.0, 1.0], 4.0, 6.0).unwrap();
    let cube = Superquadric::single([1.0; 3], 100.0, 100.0).unwrap();
    let ball = Superquadric::single([1.0; 3], 2.0, 2.0).unwrap();
    for (body, expected) in [(&flat, 6.0), (&cube, 2.0), (&ball, 2.0)] {
        for offset in [0.0, 1e-300, 1e-150] {
            let (here, there) = (at(Vector3::zeros()), at(Vector3::new(offset, 0.0, 0.0)));
            let pair = ConvexPair::new((body, &here), (body, &there));
            let contact = pair.contact(None);
            assert_eq!(contact.status, ConvexStatus::Touching);
            assert_relative_eq!(pair.overlap(&contact), expected, max_relative = 1e-9);
        }
    }
    // Of two kinds, the way out of both counts.
    let here = at(Vector3::zeros());
    let pair = ConvexPair::new((&flat, &here), (&cube, &here));
    assert_relative_eq!(pair.overlap(&pair.contact(None)), 4.0, max_relative = 1e-9);
}

#[test]
fn nothing_is_said_of_bodies_that_are_nowhere() {
    let cube = Superquadric::single([1.0; 3], 8.0, 8.0).unwrap();
    let ball = Superquadric::single([1.0; 3], 2.0, 2.0).unwrap();
    let here = at(Vector3::zeros());
    for bad in [f64::NAN, f64::INFINITY] {
        let mut turned = at(Vector3::x());
        turned.axes[(1, 2)] = bad;
        for there in [at(Vector3::new(0.0, bad, 0.0)), turned] {
            for body in [&cube, &ball] {
                let pair = ConvexPair::new((body, &here), (body, &there));
                for method in METHODS {
                    let contact = pair.contact_by(method, None);
                    assert_eq!(contact.status, ConvexStatus::Unresolved, "{method:?} {bad}");
                }
            }
        }
    }
}

#[test]
fn what_is_known_from_before_proves_nothing_if_it_is_not_finite() {
    let cube = Superquadric::single([1.0; 3], 8.0, 8.0).unwrap();
    let (here, there) = (at(Vector3::zeros()), at(Vector3::new(1.9, 0.0, 0.0)));
    let pair = ConvexPair::new((&cube, &here), (&cube, &there));
    let cold = pair.contact(None);
    assert_eq!(cold.status, ConvexStatus::Touching);
    for bad in [f64::NAN, f64::INFINITY] {
        let points = [Vector3::zeros(), Vector3::new(0.0, bad, 0.0)];
        for (point, normal) in [(points[1], Vector3::x()), (points[0], points[1])] {
            let point = Point3::from(point);
            assert_eq!(pair.contact(Some(&Warm { point, normal })), cold, "{bad}");
        }
    }
}
