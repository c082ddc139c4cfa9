//! Unions fitted to points of bodies with dents, that cross, and that stand in one another.

use super::super::tests::{grain, points_on};
use super::*;
use crate::model::{StarSurface, Superquadric};
use crate::shapes::Body;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

#[test]
fn a_dent_asks_for_four_parts() {
    let points = grain(Body::Bean);
    let cloud = Cloud::new(&points, None, 1).unwrap();
    let dent = -cloud.axes.column(1);
    let dented = cloud.points.iter().map(|p| {
        let angle = p.normalize().dot(&dent).clamp(-1.0, 1.0).acos();
        Point3::from(p * (1.0 - 0.3 * (-(angle / 0.45).powi(2)).exp()))
    });
    let dented: Vec<_> = dented.collect();
    let found = fit_multi_superquadric(&dented, None, 4, &Context::default()).unwrap();
    assert_eq!(found.union.parts().len(), 4);
    let share = found.residuals.rms / found.mean_radius;
    assert!(share < 0.013, "{share}");
    assert!(
        found
            .held_out
            .windows(2)
            .all(|errors| errors[1] < errors[0])
    );
}

#[test]
fn bodies_that_cross_are_the_parts_of_a_union() {
    let random = &mut ChaCha8Rng::seed_from_u64(5);
    let along = [[2.0, 0.7, 0.8], [0.75, 1.9, 0.7]];
    let parts = along.map(|axes| Superquadric::single(axes, 3.0, 2.5).unwrap());
    let mut points = Vec::new();
    for (part, other) in [(0, 1), (1, 0)] {
        let own = points_on(&parts[part], 1500, random);
        let is_outside = |p: &Vector3<f64>| p.norm() > parts[other].radius(&p.normalize());
        points.extend(own.into_iter().filter(is_outside).map(Point3::from));
    }
    let found = fit_multi_superquadric(&points, None, 2, &Context::default()).unwrap();
    let share = found.residuals.rms / found.mean_radius;
    assert!(found.union.parts().len() == 2 && share < 2e-3, "{share}");
}

/// Two rods as a T: the points tell nothing of the end of one in the other.
#[test]
fn a_union_has_no_more_parts_than_the_points_ask_for_and_none_beyond_them() {
    let random = &mut ChaCha8Rng::seed_from_u64(3);
    let along = [[2.0, 0.5, 0.5], [0.5, 0.5, 1.2]];
    let parts = along.map(|axes| Superquadric::single(axes, 3.0, 4.0).unwrap());
    let middles = [Vector3::zeros(), Vector3::z() * 1.2];
    let mut points = Vec::new();
    for (part, other) in [(0, 1), (1, 0)] {
        let is_outside = |p: &Vector3<f64>| {
            let ray = p - middles[other];
            ray.norm() > parts[other].radius(&ray.normalize())
        };
        let own = points_on(&parts[part], 300, random).into_iter();
        let own = own.map(|p| p + middles[part]).filter(is_outside);
        points.extend(own.map(Point3::from));
    }
    let found = fit_multi_superquadric(&points, None, 4, &Context::default()).unwrap();
    assert_eq!(found.union.parts().len(), 2, "{:?}", found.held_out);
    assert!(found.residuals.rms < 1e-3, "{:?}", found.residuals);
    for part in found.union.parts() {
        let far = part
            .shape
            .semi_axes()
            .into_iter()
            .flatten()
            .fold(0.0, f64::max);
        assert!(far < 3.0, "{part:?}");
    }
}
