mod errors;
mod levels;

use super::cloud::Cloud;
use super::functions::Functions;
use super::map::MapError;
use super::rounds::crossing_places;
use super::*;
use crate::measure::mesh_properties;
use crate::measure::{grain_properties, support};
use crate::mesh::Mesh;
use crate::model::PositionGrain;
use crate::shapes::{Curled, CurledOptions, synthesize_curled};
use crate::sphere::{CubeCell, GaussLegendre, coefficient_count, cube_grid, harmonics};
use approx::assert_relative_eq;
use nalgebra::{Rotation3, Vector3};
use std::f64::consts::FRAC_PI_2;
use std::f64::consts::PI;

/// A mesh over the directions of a cube with so many cells per edge.
fn mesh(resolution: usize, point: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Mesh {
    let (directions, triangles) = cube_grid(resolution);
    Mesh {
        vertices: directions.iter().map(|n| Point3::from(point(n))).collect(),
        triangles,
    }
}

/// An ellipsoid bent along its length, by 166 degrees: no centre sees it. Its sections are round about the arc, so that
/// its volume is that of the ellipsoid (Pappus).
fn banana(n: &Vector3<f64>) -> Vector3<f64> {
    let (sin, cos) = (BEND * n.z).sin_cos();
    let radius = 2.0 + THICKNESS * n.x;
    Vector3::new(radius * cos, THICKNESS * n.y, radius * sin)
}

const BEND: f64 = 1.45;
const THICKNESS: f64 = 0.45;
const BANANA_VOLUME: f64 = 4.0 / 3.0 * PI * THICKNESS * THICKNESS * 2.0 * BEND;

fn fitted(mesh: &Mesh, options: &FitOptions) -> PositionFit {
    let scan = Scan::from_mesh(mesh.clone()).unwrap();
    fit_position(&scan, options, &Context::default()).unwrap()
}

/// Area and volume of a fitted surface.
fn area_and_volume(fit: &PositionFit) -> [f64; 2] {
    let mesh = mesh(64, |n| fit.surface.point(n));
    let found = mesh_properties(&mesh).unwrap();
    [found.area, found.volume]
}

fn turn() -> Rotation3<f64> {
    Rotation3::from_euler_angles(0.4, -1.1, 2.3)
}

#[test]
fn an_ellipsoid_is_met_by_harmonics_of_degree_one() {
    let semi_axes = Vector3::new(3.0, 2.0, 1.0);
    let centre = Vector3::new(40.0, -7.0, 1.0);
    let ellipsoid = mesh(20, |n| turn() * n.component_mul(&semi_axes) + centre);
    let fit = fitted(&ellipsoid, &FitOptions::default());
    assert_eq!(fit.surface.coefficient_count(), 12);
    assert!(fit.distance.max < 1e-5 * fit.radius, "{:?}", fit.distance);
    assert!(fit.held_out.max < 1e-5 * fit.radius, "{:?}", fit.held_out);
    // The mesh is within the ellipsoid, the surface is not.
    let [_, volume] = area_and_volume(&fit);
    assert_relative_eq!(volume, 8.0 * PI, max_relative = 2e-3);
    let middle = (fit.surface.point(&Vector3::x()) + fit.surface.point(&-Vector3::x())) * 0.5;
    assert_relative_eq!(fit.frame.to_scan(&middle).coords, centre, epsilon = 1e-4);
}

#[test]
fn slender_and_flat_ellipsoids_are_met_by_degree_one_too() {
    for semi_axes in [Vector3::new(30.0, 1.0, 1.0), Vector3::new(1.0, 1.0, 0.02)] {
        let ellipsoid = mesh(20, |n| turn() * n.component_mul(&semi_axes));
        let options = FitOptions::default().with_degree(1);
        for options in [options.clone(), options.with_segments(1)] {
            let fit = fitted(&ellipsoid, &options);
            assert_eq!(fit.surface.coefficient_count(), 12);
            assert!(fit.distance.max < 1e-5 * fit.radius, "{:?}", fit.distance);
        }
    }
}

#[test]
fn a_degree_of_zero_is_refused_whatever_kind_was_asked_for() {
    let scan = Scan::from_mesh(mesh(4, |n| *n)).unwrap();
    let options = FitOptions::default().with_degree(0);
    let found = fit_position(&scan, &options, &Context::default());
    assert_eq!(found.unwrap_err(), FitError::PointOfDegreeZero);
}

#[test]
fn a_banana_is_fitted_whole() {
    let options = FitOptions::default().with_segments(24);
    let fit = fitted(&mesh(24, banana), &options);
    assert_eq!(fit.surface.coefficient_count(), 3 * 24 * 16);
    assert!(fit.distance.rms < 2e-3 * fit.radius, "{:?}", fit.distance);
    assert!(fit.held_out.rms < 3e-3 * fit.radius, "{:?}", fit.held_out);
    assert_eq!((fit.turned_over, fit.crossings), (0, 0));
    let [_, volume] = area_and_volume(&fit);
    assert_relative_eq!(volume, BANANA_VOLUME, max_relative = 5e-3);
}

/// A rod that is wound up three times.
fn spring(n: &Vector3<f64>) -> Vector3<f64> {
    let angle = 9.0 * n.z;
    let (sin, cos) = angle.sin_cos();
    let radius = 2.0 + 0.3 * n.x;
    Vector3::new(radius * cos, radius * sin, 0.3 * n.y + 0.35 * angle)
}

#[test]
fn a_fit_is_given_up_where_the_surface_is_turned_over_in_many_places() {
    let options = FitOptions::default().with_segments(24);
    for (body, is_hopeless) in [(mesh(24, spring), true), (mesh(12, banana), false)] {
        let fit = fitted(&body, &options);
        let told = (fit.is_hopeless, fit.turned_over, fit.crossings);
        assert_eq!(fit.is_hopeless, is_hopeless, "{told:?}");
        // Nor is it tried with more roughness.
        assert!(fit.roughness < 1e-6, "{}", fit.roughness);
    }
}

/// No more is done for a surface that its held-out distance makes no use of.
#[test]
fn a_fit_is_given_up_at_its_held_out_distance() {
    let scan = Scan::from_mesh(mesh(12, banana)).unwrap();
    let options = FitOptions::default().with_segments(6);
    let context = Context::default();
    let fit = fit_position(&scan, &options, &context).unwrap();
    let of_fit = Rival {
        coefficients: fit.surface.coefficient_count(),
        rms: fit.held_out.rms,
    };
    for factor in [0.999, 1.001] {
        let is_worth = |rival: Rival| {
            assert_eq!(rival.coefficients, of_fit.coefficients);
            rival.rms < factor * of_fit.rms
        };
        let found = fit_position_if(&scan, &options, &context, &is_worth);
        match factor < 1.0 {
            true => assert_eq!(found.unwrap_err(), FitError::NoPositions),
            false => assert_eq!(found.unwrap().held_out.rms, of_fit.rms),
        }
    }
}

#[test]
fn motion_and_scale_change_nothing() {
    let body = mesh(12, banana);
    let options = FitOptions::default().with_segments(6);
    let [area, volume] = area_and_volume(&fitted(&body, &options));
    let scale = 1e-3;
    let place = |point: &Point3<f64>| {
        Point3::from(turn() * point.coords * scale + Vector3::new(5.0, 0.0, -3.0))
    };
    let moved = Mesh {
        vertices: body.vertices.iter().map(place).collect(),
        triangles: body.triangles,
    };
    let found = area_and_volume(&fitted(&moved, &options));
    assert_relative_eq!(found[0], area * scale.powi(2), max_relative = 1e-4);
    assert_relative_eq!(found[1], volume * scale.powi(3), max_relative = 1e-4);
}

#[test]
fn a_coarse_mesh_is_sampled_inside_its_faces() {
    let body = mesh(4, |n| n.component_mul(&Vector3::new(1.0, 1.2, 1.4)));
    let fit = fitted(&body, &FitOptions::default().with_segments(24));
    assert!(fit.samples > 3 * 24 * 16, "{}", fit.samples);
    let [_, volume] = area_and_volume(&fit);
    assert_relative_eq!(volume, fit.reference.volume, max_relative = 0.01);
}

#[test]
fn noise_is_not_followed() {
    let size = BANANA_VOLUME.cbrt();
    let noise = |n: &Vector3<f64>| {
        let arbitrary = |k: f64| ((n.x * 91.0 + n.y * 57.0 + n.z * 73.0 + k) * 999.0).sin();
        Vector3::new(arbitrary(0.1), arbitrary(1.7), arbitrary(2.9)) * (0.01 * size)
    };
    let fit = fitted(&mesh(24, |n| banana(n) + noise(n)), &FitOptions::default());
    let found = mesh(24, |n| fit.surface.point(n));
    assert!(fit.surface.coefficient_count() < 3 * 500);
    assert_eq!((fit.turned_over, fit.crossings), (0, 0));
    let volume = mesh_properties(&found).unwrap().volume;
    assert_relative_eq!(volume, BANANA_VOLUME, max_relative = 0.01);
}

#[test]
fn points_stand_for_the_area_that_is_nearest_to_them() {
    let ball = mesh(8, |n| *n);
    let dense = mesh(24, |n| *n).vertices.into_iter();
    let upper = dense.filter(|vertex| vertex.z > 0.0);
    let lower = ball
        .vertices
        .iter()
        .copied()
        .filter(|vertex| vertex.z < 0.0);
    let points: Vec<_> = upper.chain(lower).map(|vertex| vertex.coords).collect();
    let map = ball.vertices.iter().map(|vertex| vertex.coords).collect();
    let cloud = Cloud::of_points(&ball, map, points);
    let areas = cloud.areas_of_points().unwrap();
    let above: f64 = (0..areas.len())
        .filter(|&at| cloud.points[at].z > 0.0)
        .map(|at| areas[at])
        .sum();
    let all: f64 = areas.iter().sum();
    assert_relative_eq!(all, cloud.area(), max_relative = 1e-12);
    assert_relative_eq!(above / all, 0.5, epsilon = 0.05);
    assert!(
        Cloud::new(&ball, cloud.points[..ball.vertices.len()].to_vec())
            .areas_of_points()
            .is_none()
    );
}

#[test]
fn roughness_is_that_of_harmonics_in_closed_form() {
    // The mean of |Hess Y + Y g|² is (k - 1) (k - 2) / (4 pi) with k = l (l + 1).
    let degree = 4;
    let functions = Functions::whole(degree);
    let mut sums = vec![0.0; coefficient_count(degree)];
    for rows in functions.roughness() {
        let columns = rows.values.chunks_exact(rows.members.len());
        for (sum, column) in sums.iter_mut().zip(columns) {
            *sum += column.iter().map(|value| value * value).sum::<f64>();
        }
    }
    for (j, sum) in sums.iter().enumerate() {
        let l = j.isqrt() as f64;
        let k = l * (l + 1.0);
        let expected = (k - 1.0) * (k - 2.0) / (4.0 * PI);
        assert!(
            (sum - expected).abs() < 0.01 * expected + 1e-12,
            "{j}: {sum} {expected}"
        );
    }
}

/// A surface with the coordinates of a function of degree 3 or less.
fn expanded(point: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Position {
    let rule = GaussLegendre::new(8);
    let mut coefficients = vec![0.0; 48];
    for cell in CubeCell::uniform(2) {
        for (n, solid_angle) in cell.rectangle().nodes(&rule) {
            let point = point(&n) * solid_angle;
            for (triple, value) in coefficients.chunks_mut(3).zip(harmonics(3, &n)) {
                for axis in 0..3 {
                    triple[axis] += point[axis] * value;
                }
            }
        }
    }
    Position::whole(coefficients).unwrap()
}

#[test]
fn surfaces_that_go_through_themselves_are_told_of() {
    assert_eq!(crossing_places(&expanded(|n| *n)).len(), 0);
    assert_eq!(
        crossing_places(&expanded(|n| n * (1.0 - 0.8 * n.z * n.z))).len(),
        0
    );
    // Both poles go through the centre, to the other side.
    assert!(crossing_places(&expanded(|n| n * (1.0 - 1.5 * n.z * n.z))).len() > 100);
}

#[test]
fn what_is_no_single_closed_surface_is_refused() {
    let refusal = |scan: &Scan| {
        let options = FitOptions::default();
        fit_position(scan, &options, &Context::default()).expect_err("no fit")
    };
    let ring = |n: usize, m: usize| {
        let vertex = |i: usize, j: usize| {
            let (u, v) = (
                4.0 * FRAC_PI_2 * i as f64 / n as f64,
                4.0 * FRAC_PI_2 * j as f64 / m as f64,
            );
            Point3::new(
                (2.0 + v.cos()) * u.cos(),
                (2.0 + v.cos()) * u.sin(),
                v.sin(),
            )
        };
        let at = |i: usize, j: usize| (i % n * m + j % m) as u32;
        let cells: Vec<_> = (0..n).flat_map(|i| (0..m).map(move |j| (i, j))).collect();
        let triangles = cells.iter().flat_map(|&(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        Mesh {
            triangles: triangles.collect(),
            vertices: cells.iter().map(|&(i, j)| vertex(i, j)).collect(),
        }
    };
    let ring = Scan::from_mesh(ring(24, 12)).unwrap();
    let handles = MapError::Handles { genus: 1 };
    assert_eq!(refusal(&ring), FitError::NotMapped(handles));
    let mut open = mesh(8, |n| *n);
    open.triangles.truncate(500);
    let open = Scan::from_mesh(open).unwrap();
    assert_eq!(refusal(&open), FitError::NoFaces);
}
