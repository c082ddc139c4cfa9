use super::*;
use crate::mesh::Mesh;
use crate::shapes::{
    Body, Origin, Sampling, SynthOptions, SyntheticTray, TrayOptions, synthesize, synthesize_tray,
};
use nalgebra::{Rotation3, Vector3};
use std::f64::consts::{PI, TAU};

fn tray() -> SyntheticTray {
    let options = TrayOptions::clean(12).with_noise(0.002);
    synthesize_tray(&options).unwrap()
}

/// The grain that most points of a part are of, the share of its points that the part has, and that of others.
fn judged(grain: &SplitGrain, tray: &SyntheticTray) -> (usize, f64, f64) {
    let origins: Vec<Origin> = grain
        .indices
        .iter()
        .map(|&i| tray.origins[i as usize])
        .collect();
    let count = |all: &[Origin], of: Origin| all.iter().filter(|one| **one == of).count() as f64;
    let numbers = 0..12;
    let own = numbers
        .max_by_key(|&number| count(&origins, Origin::Grain(number)) as usize)
        .unwrap();
    let kept = count(&origins, Origin::Grain(own));
    let all = count(&tray.origins, Origin::Grain(own));
    (own, kept / all, 1.0 - kept / origins.len() as f64)
}

#[test]
fn a_tray_is_split_into_its_grains() {
    let tray = tray();
    assert_eq!(tray.touching, [[0, 1]]);
    let found = split(&Scan::from_points(tray.points.clone())).unwrap();
    assert_eq!((found.grains.len(), found.cuts()), (12, 1));
    assert_eq!((found.dust, found.dust_points), (24, 96));
    let mut owners = Vec::new();
    for grain in &found.grains {
        let (own, kept, foreign) = judged(grain, &tray);
        assert!(
            kept >= 0.99 && foreign <= 0.01,
            "grain {own}: {kept}, {foreign}"
        );
        let points = grain.indices.iter().map(|&i| tray.points[i as usize]);
        assert!(grain.scan.points().iter().copied().eq(points));
        owners.push(own);
    }
    owners.sort_unstable();
    assert!(owners.into_iter().eq(0..12));
}

#[test]
fn rows_of_what_was_not_seen_are_one_point_of_dust_and_carry_no_plane() {
    let tray = tray();
    let origins = tray.origins.iter();
    let table = origins.filter(|origin| **origin == Origin::Plane).count();
    let rows = vec![Point3::new(0.0, 0.0, 40.0); tray.points.len()];
    let points = [tray.points.clone(), rows].concat();
    let found = split(&Scan::from_points(points)).unwrap();
    assert_eq!((found.grains.len(), found.cuts()), (12, 1));
    assert!(found.plane.is_some() && found.plane_points * 50 <= table * 51);
    assert_eq!(found.dust, 25);
    assert_eq!(found.dust_points, 96 + tray.points.len());
}

#[test]
fn a_tray_that_is_moved_turned_scaled_and_shuffled_has_the_same_grains() {
    let tray = tray();
    let turn = Rotation3::from_euler_angles(0.3, -0.2, 0.0);
    let moved = |point: &Point3<f64>| turn * point * 25.4 + Vector3::new(1e4, -3e3, 20.0);
    let points: Vec<Point3<f64>> = tray.points.iter().rev().map(moved).collect();
    let last = points.len() as u32 - 1;
    let found = split(&Scan::from_points(points)).unwrap();
    assert_eq!((found.grains.len(), found.cuts()), (12, 1));
    for grain in &found.grains {
        let mut grain = grain.clone();
        grain
            .indices
            .iter_mut()
            .for_each(|index| *index = last - *index);
        let (own, kept, foreign) = judged(&grain, &tray);
        assert!(
            kept >= 0.98 && foreign <= 0.02,
            "grain {own}: {kept}, {foreign}"
        );
    }
}

/// The points of a tray of which so much of the table is left, turned and bent; and what they were taken from.
fn changed(tray: &SyntheticTray, table: f64, tilt: f64, bow: f64) -> SyntheticTray {
    let turn = Rotation3::from_euler_angles(tilt, 0.0, -tilt);
    let farthest = tray.points.iter().map(|point| point.coords.norm());
    let farthest = farthest.fold(0.0, f64::max);
    let kept = (0..).zip(tray.points.iter().zip(&tray.origins));
    let kept = kept.filter(|(i, (_, origin))| match origin {
        Origin::Plane => f64::from(i % 100) < 100.0 * table,
        _ => true,
    });
    let bent = |point: &Point3<f64>| {
        let share = point.coords.norm() / farthest;
        turn * (point + Vector3::z() * (bow * share * share))
    };
    let (points, origins) = kept.map(|(_, (p, &origin))| (bent(p), origin)).unzip();
    SyntheticTray {
        points,
        origins,
        touching: tray.touching.clone(),
    }
}

#[test]
fn grains_are_found_on_any_share_of_a_table_and_without_one() {
    for (seed, noise, table, tilt, bow) in [
        (1, 0.0, 0.0, 0.0, 0.0),
        (2, 0.002, 0.0, 0.7, 0.0),
        (3, 0.01, 0.0, 0.0, 0.0),
        (4, 0.0, 0.1, 0.7, 0.0),
        (5, 0.002, 0.1, 0.0, 0.0),
        (6, 0.01, 0.1, 1.5, 0.0),
        (7, 0.0, 0.4, 0.0, 0.5),
        (8, 0.002, 0.4, 0.7, 0.0),
        (9, 0.01, 1.0, 3.0, 0.0),
        (10, 0.002, 1.0, 0.0, 0.5),
    ] {
        let case = format!("seed {seed}, noise {noise}, table {table}, tilt {tilt}, bow {bow}");
        let options = TrayOptions::clean(12).with_noise(noise).with_seed(seed);
        let tray = changed(&synthesize_tray(&options).unwrap(), table, tilt, bow);
        let found = split(&Scan::from_points(tray.points.clone())).unwrap();
        assert_eq!(found.plane.is_some(), table > 0.0, "{case}");
        assert_eq!(found.grains.len(), 12, "{case}");
        for grain in &found.grains {
            let (_, kept, foreign) = judged(grain, &tray);
            let least = if bow > 0.0 { 0.95 } else { 0.98 };
            assert!(
                kept >= least && foreign <= 0.02,
                "{case}: {kept}, {foreign}"
            );
        }
        let of_plane = |origin: &&Origin| **origin == Origin::Plane;
        let table = tray.origins.iter().filter(of_plane).count();
        assert!(found.plane_points * 50 <= table * 51, "{case}");
    }
}

#[test]
fn a_table_with_nothing_on_it_has_no_grain() {
    let mut tray = tray();
    let mut origins = tray.origins.iter();
    tray.points
        .retain(|_| origins.next() == Some(&Origin::Plane));
    let found = split(&Scan::from_points(tray.points.clone())).unwrap();
    assert_eq!(found.plane_points, tray.points.len());
    assert!(found.grains.is_empty());
}

#[test]
fn a_body_is_one_grain_however_its_points_are_laid_out() {
    for body in Body::ALL {
        for sampling in Sampling::ALL {
            let options = SynthOptions::clean(body).with_sampling(sampling);
            let points = synthesize(&options).unwrap().points;
            let found = split(&Scan::from_points(points.clone())).unwrap();
            assert!(found.plane.is_none(), "{body}: a face is no tray");
            let [grain] = found.grains.as_slice() else {
                panic!("{body} {sampling}: {} grains", found.grains.len());
            };
            assert!(!grain.may_touch && found.dust_points * 200 < points.len());
            assert_eq!(grain.indices.len() + found.dust_points, points.len());
        }
    }
}

#[test]
fn parts_of_a_mesh_are_grains_in_the_order_of_their_places_and_points_met_often_are_kept() {
    let ball = Mesh::radial(8, |_| 1.0);
    let mut mesh = Mesh::default();
    for x in [9.0, -9.0, 0.0] {
        let first = mesh.vertices.len() as u32;
        mesh.vertices
            .extend(ball.vertices.iter().map(|v| v + Vector3::x() * x));
        mesh.triangles
            .extend(ball.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    let found = split(&Scan::from_mesh(mesh.clone()).unwrap()).unwrap();
    let firsts: Vec<f64> = found
        .grains
        .iter()
        .map(|grain| grain.scan.points()[0].x.round())
        .collect();
    let x = ball.vertices[0].x.round();
    assert_eq!(firsts, [x - 9.0, x, x + 9.0]);
    assert!(
        found
            .grains
            .iter()
            .all(|grain| grain.scan.topology().unwrap().closed)
    );
    // As corners of faces are that share no points.
    let loose: Vec<Point3<f64>> = mesh
        .triangles
        .iter()
        .flatten()
        .map(|&i| mesh.vertices[i as usize])
        .collect();
    let found = split(&Scan::from_points(loose.clone())).unwrap();
    assert_eq!(found.grains.len(), 3);
    let points: usize = found.grains.iter().map(|grain| grain.indices.len()).sum();
    assert_eq!(points, loose.len());
}

/// Balls of some radii about places on a line, each wound inwards where its radius is negative.
fn balls(balls: &[(f64, f64)]) -> Mesh {
    let mut mesh = Mesh::default();
    for &(x, radius) in balls {
        let ball = Mesh::radial(8, |_| radius.abs());
        let first = mesh.vertices.len() as u32;
        mesh.vertices
            .extend(ball.vertices.iter().map(|v| v + Vector3::x() * x));
        mesh.triangles.extend(ball.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|i| i + first);
            if radius > 0.0 { [a, b, c] } else { [a, c, b] }
        }));
    }
    mesh
}

#[test]
fn a_hollow_is_of_the_body_round_it_and_a_body_in_the_hollow_is_another() {
    let mesh = balls(&[(0.0, -3.0), (0.0, 4.0), (9.0, 4.0), (0.0, 2.0), (0.0, -1.0)]);
    let found = split(&Scan::from_mesh(mesh).unwrap()).unwrap();
    let volume = |scan: &Scan| scan.topology().unwrap().volume;
    let unit = volume(&Scan::from_mesh(Mesh::radial(8, |_| 1.0)).unwrap());
    let grains = found.grains.iter();
    let mut volumes: Vec<f64> = grains.map(|grain| volume(&grain.scan) / unit).collect();
    volumes.sort_by(f64::total_cmp);
    let expected = [8.0 - 1.0, 64.0 - 27.0, 64.0];
    assert_eq!(volumes.len(), 3);
    for (found, expected) in volumes.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{volumes:?}");
    }
}

#[test]
fn a_small_body_of_a_mesh_is_dust_however_many_points_it_has() {
    let mesh = balls(&[(0.0, 4.0), (9.0, 4.0), (18.0, 0.08), (27.0, 1.0)]);
    let speck = Mesh::radial(8, |_| 1.0).vertices.len();
    let found = split(&Scan::from_mesh(mesh).unwrap()).unwrap();
    assert_eq!(
        (found.grains.len(), found.dust, found.dust_points),
        (3, 1, speck)
    );
}

/// Points of balls of radius 3 about some places, 4000 of each.
fn touching(middles: &[[f64; 3]]) -> Vec<Point3<f64>> {
    let options = SynthOptions {
        points: 4000,
        ..SynthOptions::clean(Body::Sphere).with_sampling(Sampling::Random)
    };
    let ball = synthesize(&options).unwrap().points;
    let radius = ball[0].coords.norm();
    let middles = middles.iter().copied().map(Vector3::from);
    middles
        .flat_map(|middle| ball.iter().map(move |p| p * (3.0 / radius) + middle))
        .collect()
}

#[test]
fn a_row_of_balls_that_touch_is_cut_into_them() {
    let points = touching(&[[0.0; 3], [5.95, 0.0, 0.0], [11.9, 0.0, 0.0]]);
    let of_each = points.len() / 3;
    let found = split(&Scan::from_points(points)).unwrap();
    assert_eq!((found.grains.len(), found.cuts()), (3, 2));
    for (own, grain) in found.grains.iter().enumerate() {
        let indices = grain.indices.iter();
        let kept = indices.filter(|&&i| i as usize / of_each == own).count();
        let foreign = grain.indices.len() - kept;
        assert!(kept * 100 >= of_each * 97, "{kept} of {of_each}");
        assert!(foreign * 100 <= of_each * 3, "{foreign}");
        assert!(!grain.may_touch);
    }
}

/// Less than a tenth of the points are of the small one, between which and the large one the section is no narrow neck.
#[test]
fn a_small_ball_that_touches_a_large_one_is_cut_off() {
    let large = touching(&[[0.0; 3]]);
    let small = large.iter().step_by(12).map(|p| p / 3.0);
    let small: Vec<_> = small.map(|p| p + Vector3::new(3.9, 0.3, 0.2)).collect();
    let expected = [small.len(), large.len()];
    let found = split(&Scan::from_points([large, small].concat())).unwrap();
    let grains = found.grains.iter();
    let mut sizes: Vec<usize> = grains.map(|grain| grain.indices.len()).collect();
    sizes.sort_unstable();
    assert_eq!((sizes.len(), found.cuts()), (2, 1));
    for (size, expected) in sizes.into_iter().zip(expected) {
        assert!(
            size.abs_diff(expected) * 50 <= expected,
            "{size}, not {expected}"
        );
    }
}

/// A waist of three quarters, of a smooth body without noise: two outlines fit such a cloud far better than one.
#[test]
fn a_peanut_is_not_cut_in_two_but_told() {
    for resolution in [16, 24, 40] {
        let peanut = Mesh::radial(resolution, |n| 3.0 + 1.4 * (2.0 * n.z * n.z - 1.0));
        let turn = Rotation3::from_euler_angles(0.3, 0.9, 0.4);
        let points = peanut.vertices.iter().map(|p| turn * p).collect();
        let found = split(&Scan::from_points(points)).unwrap();
        let [grain] = found.grains.as_slice() else {
            panic!("{resolution}: {} grains", found.grains.len());
        };
        assert!(grain.may_touch && grain.cut.is_none(), "{resolution}");
    }
}

/// A tube of even thickness, bent by an angle, and closed by half balls.
fn bent_tube([radius, thickness, bend]: [f64; 3], [rings, around]: [u32; 2]) -> Vec<Point3<f64>> {
    let at = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        [Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0)]
    };
    let side = (0..rings).flat_map(|ring| {
        let [out, _] = at(bend * (f64::from(ring) / f64::from(rings - 1) - 0.5));
        (0..around).map(move |place| {
            let shift = 0.5 * f64::from(ring % 2);
            let (sin, cos) = (TAU * (f64::from(place) + shift) / f64::from(around)).sin_cos();
            out * (radius + thickness * cos) + Vector3::z() * (thickness * sin)
        })
    });
    let count = f64::from(around * around) / PI;
    let ball = Sampling::Fibonacci.directions(count as usize, 0).unwrap();
    let ends = [-1.0, 1.0].into_iter().flat_map(|end| {
        let [out, along] = at(0.5 * bend * end);
        let beyond = ball.iter().filter(move |n| n.dot(&along) * end > 0.05);
        beyond.map(move |n| out * radius + n * thickness)
    });
    side.chain(ends).map(Point3::from).collect()
}

#[test]
fn a_bent_tube_is_not_cut_to_slivers_but_told() {
    for (tube, points) in [
        ([1.2, 0.42, 260.0], [80, 30]),
        ([1.2, 0.42, 260.0], [60, 24]),
        ([1.5, 0.5, 250.0], [100, 40]),
    ] {
        let [radius, thickness, bend] = tube;
        let tube = bent_tube([radius, thickness, f64::to_radians(bend)], points);
        let found = split(&Scan::from_points(tube)).unwrap();
        assert_eq!(
            (found.grains.len(), found.cuts()),
            (1, 0),
            "{bend} {points:?}"
        );
        assert!(found.grains[0].may_touch);
    }
}

#[test]
fn what_was_cut_is_told_and_left_whole_where_that_is_asked_for() {
    let mut points = touching(&[[0.0; 3], [5.95, 0.0, 0.0]]);
    points.extend(touching(&[[0.0, 20.0, 0.0]]));
    let scan = Scan::from_points(points);
    let found = split(&scan).unwrap();
    assert_eq!((found.grains.len(), found.cuts()), (3, 1));
    let cuts: Vec<Cut> = found.grains.iter().filter_map(|grain| grain.cut).collect();
    let [one, other] = cuts[..] else {
        panic!("{cuts:?}");
    };
    assert!(one == other && one.neck > 0.1 && one.neck < 0.6, "{one:?}");
    let whole = split_uncut(&scan).unwrap();
    assert_eq!((whole.grains.len(), whole.cuts()), (2, 0));
    let told: Vec<bool> = whole.grains.iter().map(|grain| grain.may_touch).collect();
    let sizes = whole.grains.iter().map(|grain| grain.indices.len());
    let is_pair: Vec<bool> = sizes.map(|size| size > scan.points().len() / 2).collect();
    assert_eq!(told, is_pair);
}

#[test]
fn a_pile_that_has_no_neck_is_told_to_be_one() {
    let points = touching(&[
        [0.0; 3],
        [5.95, 0.0, 0.0],
        [2.975, 5.15, 0.0],
        [2.975, 1.72, 4.86],
    ]);
    let found = split(&Scan::from_points(points)).unwrap();
    let is_told = found.grains.iter().all(|grain| grain.may_touch);
    assert!(is_told || found.grains.len() == 4);
}
