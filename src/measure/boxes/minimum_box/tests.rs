use super::*;
use crate::measure::convex_hull;
use crate::shapes::{Body, Sampling};
use approx::assert_relative_eq;
use nalgebra::{Point3, Rotation2, Rotation3, Vector2};
use proptest::prelude::*;
use std::f64::consts::PI;

fn turn(angles: [f64; 3]) -> Rotation3<f64> {
    Rotation3::from_euler_angles(angles[0], angles[1], angles[2])
}

/// The hull of points turned by these angles and moved.
fn hull(points: &[[f64; 3]], angles: [f64; 3]) -> Mesh {
    let shift = Vector3::new(3.0, -2.0, 1.0);
    let place = |p: &[f64; 3]| turn(angles) * Point3::from(*p) + shift;
    convex_hull(&points.iter().map(place).collect::<Vec<_>>()).unwrap()
}

fn assert_holds(found: &OrientedBox, hull: &Mesh) {
    let axes = found.axes;
    assert_relative_eq!(axes.tr_mul(&axes), Matrix3::identity(), epsilon = 1e-12);
    assert_relative_eq!(axes.determinant(), 1.0, epsilon = 1e-12);
    for vertex in &hull.vertices {
        let place = axes.tr_mul(&(vertex - found.centre));
        let excess = place.abs() - found.extents / 2.0;
        assert!(excess.max() <= 1e-12 * found.extents.x);
    }
}

/// Of this cuboid a search that goes on from its own axes made them shorter by 3e-13.
#[test]
fn axes_keep_their_length() {
    let [x, y, z] = [1.0021161929016356, 0.5475422343506823, 1.3864477429514295];
    let corners: Vec<_> = (0..8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
        .map(|c| [c[0] * x, c[1] * y, c[2] * z])
        .collect();
    let angles = [
        -0.22966835761953744,
        0.01898615905840388,
        -0.5402010273548933,
    ];
    let axes = minimum_box(&hull(&corners, angles)).unwrap().axes;
    assert_relative_eq!(axes.tr_mul(&axes), Matrix3::identity(), epsilon = 1e-14);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_cuboid_of_any_rotation_is_its_own_box(
        sides in prop::array::uniform3(0.2..2.0_f64),
        angles in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let corners: Vec<_> = (0..8)
            .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
            .map(|c| [c[0] * sides[0], c[1] * sides[1], c[2] * sides[2]])
            .collect();
        let hull = hull(&corners, angles);
        let found = minimum_box(&hull).unwrap();
        assert_holds(&found, &hull);
        let mut sides = sides;
        sides.sort_by(|a, b| b.total_cmp(a));
        assert_relative_eq!(found.extents, Vector3::from(sides), max_relative = 1e-9);
    }

    #[test]
    fn the_box_of_a_regular_tetrahedron_is_the_cube_round_it(
        angles in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let found = minimum_box(&hull(&corners, angles)).unwrap();
        // Edges of 2 sqrt2, a cube of edge 2.
        assert_relative_eq!(found.volume(), 8.0, max_relative = 1e-9);
        assert_relative_eq!(found.extents, Vector3::repeat(2.0), max_relative = 1e-9);
    }

    #[test]
    fn no_direction_gives_a_smaller_box(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 12..60),
        angles in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let here = hull(&points, [0.0; 3]);
        let found = minimum_box(&here).unwrap();
        assert_holds(&found, &here);
        let all = ExtremePoints { points: here.vertices.clone() };
        for direction in Sampling::Fibonacci.directions(20_000, 0).unwrap() {
            let volume = all.least_box(&direction).unwrap().volume;
            prop_assert!(found.volume() <= volume * (1.0 + 1e-6), "{} {volume}", found.volume());
        }
        let turned = minimum_box(&hull(&points, angles)).unwrap();
        assert_relative_eq!(turned.volume(), found.volume(), max_relative = 1e-6);
    }
}

/// The hull of a body with the given number of points.
fn body_hull(body: Body, points: usize, angles: [f64; 3]) -> Mesh {
    let surface = body.surface();
    let directions = Sampling::Fibonacci.directions(points, 0).unwrap();
    let points: Vec<_> = directions
        .iter()
        .map(|n| <[f64; 3]>::from(n * surface.radius(n)))
        .collect();
    hull(&points, angles)
}

#[test]
fn the_box_of_a_grain_does_not_depend_on_its_rotation_and_beats_the_principal_axes() {
    // The chickpea is nearly round: it has many boxes of nearly the same volume.
    for (body, tolerance) in [
        (Body::Bean, 1e-5),
        (Body::Chickpea, 1e-3),
        (Body::Maize, 1e-5),
    ] {
        let here = body_hull(body, 5000, [0.0; 3]);
        let found = minimum_box(&here).unwrap();
        assert_holds(&found, &here);
        let principal = mesh_properties(&here).unwrap().principal().unwrap();
        let along = box_along(&here.vertices, &principal.axes);
        assert!(found.volume() <= along.volume());
        for angles in [[0.3, 0.7, -1.1], [2.0, -0.4, 0.1]] {
            let turned = minimum_box(&body_hull(body, 5000, angles)).unwrap();
            assert_relative_eq!(turned.volume(), found.volume(), max_relative = tolerance);
        }
    }
}

#[test]
fn the_box_of_an_ellipsoid_has_its_axes() {
    // The box with axes R has the volume 8 prod sqrt(sum_j R_ij² a_j²), least at the semi-axes.
    let hull = body_hull(Body::Ellipsoid, 20_000, [0.4, 1.0, -2.0]);
    let found = minimum_box(&hull).unwrap();
    assert_relative_eq!(
        found.extents,
        Vector3::new(4.0, 4.0, 2.0),
        max_relative = 1e-3
    );
}

#[test]
fn broken_meshes_are_refused() {
    let mut mesh = hull(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [0.0; 3],
    );
    let flat = Mesh {
        vertices: vec![mesh.vertices[0]; 4],
        ..mesh.clone()
    };
    for bad in [flat, Mesh::default()] {
        let found = minimum_box(&bad);
        assert!(
            matches!(found, Err(MeshIntegralError::NoVolume { .. })),
            "{found:?}"
        );
    }
    mesh.vertices[2].x = f64::NAN;
    assert!(minimum_box(&mesh).is_err());
    mesh.triangles[0][1] = 9;
    assert!(matches!(
        minimum_box(&mesh),
        Err(MeshIntegralError::MissingVertex { .. })
    ));
}

/// On each side of a triangle stands a rectangle round it of twice its area: of a prism over one of sides 3, 4 and 5 two boxes are as
/// small, 3 by 4 and 5 by 2.4 wide.
#[test]
fn boxes_that_are_as_small_are_among_the_others() {
    let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]];
    let corners = corners
        .iter()
        .flat_map(|[x, y]| [0.0, 2.0].map(|z| [*x, *y, z]));
    let prism = hull(&corners.collect::<Vec<_>>(), [0.3, 0.2, 0.1]);
    let found = least_boxes(&prism).unwrap();
    assert_relative_eq!(found.least.volume(), 24.0, max_relative = 1e-9);
    for sides in [[4.0, 3.0, 2.0], [5.0, 2.4, 2.0]] {
        let is_like = |other: &OrientedBox| (other.extents - Vector3::from(sides)).amax() < 0.05;
        assert!(
            found.others.iter().any(is_like),
            "{sides:?} {:?}",
            found.others
        );
    }
}

/// A disc that is cut by roofs of three degrees above and below: the box may lie along one side of them or along the other.
#[test]
fn boxes_beside_the_least_one_are_found() {
    let disc =
        (-400..400).map(|i| Rotation2::new(f64::from(i) / 400.0 * PI) * Vector2::new(1.5, 0.0));
    let slope = 3.0_f64.to_radians().tan();
    let ends = disc.filter(|p| p.y.abs() < 1.0 - slope * p.x.abs());
    let ridges = [1.0, -1.0].map(|y| Vector2::new(0.0, y));
    let corners = ends.chain(ridges);
    let corners: Vec<[f64; 3]> = corners
        .flat_map(|c| [0.0, 1.0].map(|z| [c.x, c.y, z]))
        .collect();
    let prism = hull(&corners, [0.3, 0.2, 0.1]);
    let least = least_boxes(&prism).unwrap().least;
    let angles = |larger: [f64; 2]| {
        let beside = boxes_beside(&prism, &least, larger).into_iter();
        let angles =
            beside.map(|other| other.axes.column(0).dot(&least.axes.column(0)).abs().acos());
        angles.map(f64::to_degrees).collect::<Vec<_>>()
    };
    let near_six = |angle: &f64| (angle - 6.0).abs() < 0.5;
    assert!(angles([-1e-3, 1e-3]).iter().any(near_six));
    assert!(!angles([-1e-3, -1e-3]).iter().any(near_six));
    let close = angles([0.05, 0.0]);
    assert!(
        close.iter().any(|angle| (0.2..2.0).contains(angle)),
        "{close:?}"
    );
}
