use super::*;
use crate::measure::mesh_properties;
use crate::shapes::{Body, Sampling};
use nalgebra::Rotation3;
use proptest::prelude::*;

/// Checks by the exact predicate that no point is outside any facet.
fn assert_holds(mesh: &Mesh, points: &[Point3<f64>]) {
    mesh.check_closed().expect("closed");
    for corners in &mesh.triangles {
        let corners = corners.map(|corner| mesh.vertices[corner as usize]);
        for point in points {
            assert!(orient3d(corners, *point) >= 0.0, "{point} is outside");
        }
    }
}

fn lattice(n: usize) -> Vec<Point3<f64>> {
    (0..n * n * n)
        .map(|i| Point3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64))
        .collect()
}

#[test]
fn a_cube_lattice_has_the_hull_of_the_cube() {
    for n in [2, 3, 6] {
        let points = lattice(n);
        let hull = convex_hull(&points).unwrap();
        assert_holds(&hull, &points);
        let side = (n - 1) as f64;
        let solid = mesh_properties(&hull).unwrap();
        assert!((solid.area - 6.0 * side * side).abs() < 1e-12 * solid.area);
        assert!((solid.volume - side * side * side).abs() < 1e-12 * solid.volume);
    }
}

#[test]
fn a_turned_cube_lattice_with_rounding_is_enclosed() {
    let turn = Rotation3::from_euler_angles(0.3, 0.7, -1.1);
    let points: Vec<_> = lattice(6).iter().map(|p| turn * p).collect();
    let hull = convex_hull(&points).unwrap();
    assert_holds(&hull, &points);
    assert!((mesh_properties(&hull).unwrap().volume - 125.0).abs() < 1e-10);
}

#[test]
fn all_points_of_a_sphere_are_on_its_hull() {
    for sampling in [Sampling::Fibonacci, Sampling::Rings, Sampling::Cube] {
        let directions = sampling.directions(20_000, 0).unwrap();
        let points: Vec<_> = directions.into_iter().map(Point3::from).collect();
        let hull = convex_hull(&points).unwrap();
        hull.check_closed().unwrap();
        assert_eq!(hull.vertices, points);
    }
}

#[test]
fn a_dent_is_bridged() {
    let maize = Body::Maize.surface();
    let directions = Sampling::Fibonacci.directions(2000, 0).unwrap();
    let points: Vec<_> = directions
        .iter()
        .map(|n| Point3::from(n * maize.radius(n)))
        .collect();
    let hull = convex_hull(&points).unwrap();
    assert_holds(&hull, &points);
    assert!(hull.vertices.len() < points.len());
    // The hull of the hull is itself.
    assert_eq!(convex_hull(&hull.vertices).unwrap().vertices, hull.vertices);
}

#[test]
fn tiny_clusters_far_away_are_enclosed() {
    let directions = Sampling::Random.directions(500, 3).unwrap();
    let mut points = lattice(3);
    points.extend(
        directions
            .iter()
            .map(|n| Point3::new(2.0, 2.0, 2.0) + n * 1e-15),
    );
    points.extend(
        directions
            .iter()
            .map(|n| Point3::new(1.0, 0.0, 0.0) + n * 1e-9),
    );
    assert_holds(&convex_hull(&points).unwrap(), &points);
}

#[test]
fn sizes_do_not_matter() {
    for size in [1e-300, 1e-160, 1e160, 1e300] {
        let points: Vec<_> = lattice(3).iter().map(|p| p * size).collect();
        let hull = convex_hull(&points).unwrap();
        hull.check_closed().unwrap();
        assert!(hull.vertices.len() >= 8);
    }
}

#[test]
fn points_without_a_volume_are_refused() {
    let corner = |i: i32| Point3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
    let line: Vec<_> = (0..50)
        .map(|i| Point3::new(1.0, 2.0, 3.0) * f64::from(i))
        .collect();
    let plane: Vec<_> = (0..64)
        .map(|i| Point3::new((i % 8).into(), (i / 8).into(), ((i % 8) - (i / 8)).into()))
        .collect();
    let same = vec![corner(3); 100];
    for flat in [
        vec![],
        vec![corner(0)],
        (0..3).map(corner).collect(),
        line,
        plane,
        same,
    ] {
        assert_eq!(convex_hull(&flat), Err(HullError::Flat));
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let mut points = lattice(3);
        points[7].y = bad;
        assert_eq!(convex_hull(&points), Err(HullError::NotFinite { point: 7 }));
    }
}

#[test]
fn coordinates_of_all_orders_of_magnitude_do_no_harm() {
    let mut points = Vec::new();
    for i in 0..60_i32 {
        let tiny = 2.0_f64.powi(-17 * i);
        points.push(Point3::new(tiny, tiny * tiny, 1.0 - tiny));
        points.push(Point3::new(-tiny, 1e-300 * tiny, tiny));
    }
    if let Ok(hull) = convex_hull(&points) {
        hull.check_closed().unwrap();
    }
}

proptest! {
    #[test]
    fn lattice_points_are_enclosed(
        points in prop::collection::vec(prop::array::uniform3(0..4_i32), 1..80),
    ) {
        let points: Vec<_> = points.into_iter().map(|p| Point3::from(p.map(f64::from))).collect();
        match convex_hull(&points) {
            Ok(hull) => assert_holds(&hull, &points),
            Err(error) => {
                prop_assert_eq!(error, HullError::Flat);
                let exact = |p: &Point3<f64>| [p.x as i64, p.y as i64, p.z as i64];
                let flat = points.iter().all(|p| points.iter().all(|q| points.iter().all(|r| {
                    let [o, p, q, r] = [&points[0], p, q, r].map(exact);
                    let d = |a: [i64; 3]| [a[0] - o[0], a[1] - o[1], a[2] - o[2]];
                    let (p, q, r) = (d(p), d(q), d(r));
                    p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2])
                        + p[2] * (q[0] * r[1] - q[1] * r[0]) == 0
                })));
                prop_assert!(flat);
            }
        }
    }

    #[test]
    fn near_lattice_points_are_enclosed(
        points in prop::collection::vec(prop::array::uniform3((0..4_i32, -3..4_i32)), 4..60),
    ) {
        let points: Vec<_> = points
            .into_iter()
            .map(|p| Point3::from(p.map(|(at, ulps)| 0.1 * f64::from(at) + f64::from(ulps) * 1e-17)))
            .collect();
        if let Ok(hull) = convex_hull(&points) {
            assert_holds(&hull, &points);
        }
    }

    #[test]
    fn hulls_do_not_depend_on_order_and_rotation(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 10..80),
        angles in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let points: Vec<_> = points.into_iter().map(Point3::from).collect();
        let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
        let turned: Vec<_> = points.iter().rev().map(|p| turn * p).collect();
        let [hull, other] = [convex_hull(&points).unwrap(), convex_hull(&turned).unwrap()];
        prop_assert_eq!(hull.vertices.len(), other.vertices.len());
        let [hull, other] = [hull, other].map(|hull| mesh_properties(&hull).unwrap());
        prop_assert!((hull.volume - other.volume).abs() < 1e-12);
        prop_assert!((hull.area - other.area).abs() < 1e-12);
    }
}
