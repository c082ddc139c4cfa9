//! What is told of a scan is right, or is not told.

use super::{deviation, errors, folder, grainform, json, number, succeed};
use grainform::Mesh;
use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

/// The points of a synthetic body.
fn points(folder: &TempDir, words: &[&str]) -> Vec<[f64; 3]> {
    succeed(folder, &[&["synth"], words, &["-o", "synth.xyz"]].concat());
    let text = fs::read_to_string(folder.path().join("synth.xyz")).unwrap();
    let rows = text.lines().map(|line| {
        let numbers: Vec<f64> = line
            .split_whitespace()
            .map(|x| x.parse().unwrap())
            .collect();
        [numbers[0], numbers[1], numbers[2]]
    });
    rows.collect()
}

pub(crate) fn save(folder: &TempDir, name: &str, points: &[[f64; 3]]) {
    let lines = points
        .iter()
        .map(|[x, y, z]| format!("{x:e} {y:e} {z:e}\n"));
    fs::write(folder.path().join(name), lines.collect::<String>()).unwrap();
}

fn save_mesh(folder: &TempDir, name: &str, mesh: &Mesh) {
    grainform::export::save_mesh(&folder.path().join(name), mesh).unwrap();
}

fn ball(resolution: usize, radius: f64, x: f64) -> Mesh {
    let mut mesh = Mesh::radial(resolution, |_| radius);
    for vertex in &mut mesh.vertices {
        vertex.x += x;
    }
    mesh
}

fn joined(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh::default();
    for mesh in meshes {
        let first = all.vertices.len() as u32;
        all.vertices.extend(&mesh.vertices);
        let moved = mesh.triangles.iter().map(|t| t.map(|i| i + first));
        all.triangles.extend(moved);
    }
    all
}

/// `fit` must refuse with these words and write nothing.
fn refused(folder: &TempDir, name: &str, words: &str) {
    let output = grainform(
        folder,
        &["fit", name, "-o", "model.json", "--mesh", "mesh.stl"],
    );
    let text = errors(&output);
    assert_eq!(output.status.code(), Some(2), "{name}: {text}");
    assert!(text.contains(words), "{name}: {words:?} in {text}");
    for file in ["model.json", "mesh.stl"] {
        assert!(!folder.path().join(file).exists(), "{name}: {file}");
    }
}

pub(crate) fn warns(report: &Value, words: &str) -> bool {
    let warnings = report["warnings"].as_array().unwrap();
    warnings.iter().any(|w| w.as_str().unwrap().contains(words))
}

#[test]
fn two_beans_in_one_cloud_are_refused_and_the_largest_is_fitted_if_asked_for() {
    let folder = folder();
    let one = points(&folder, &["bean"]);
    let other = points(&folder, &["bean", "--offset", "16,0,0", "--points", "1000"]);
    save(&folder, "two.xyz", &[one.clone(), other].concat());
    refused(&folder, "two.xyz", "2 separate bodies");
    let truth = json(&folder, &["synth", "bean"]);
    let report = json(&folder, &["fit", "two.xyz", "--largest"]);
    assert_eq!(report["points"], one.len());
    assert!(deviation(&report, &truth, "volume") < 1e-3);
    assert!(warns(&report, "Another body was left out"), "{report}");
    let search = json(&folder, &["search", "two.xyz", "--largest"]);
    assert!(warns(&search, "Another body was left out"), "{search}");
    let measured = grainform(&folder, &["measure", "two.xyz"]);
    assert_eq!(measured.status.code(), Some(2));
}

/// Points on the table about a grain are in company of each other, as outliers strewn about it are not.
#[test]
fn a_grain_on_its_table_is_refused_and_one_among_outliers_is_not() {
    let folder = folder();
    let bean = points(&folder, &["bean"]);
    let low = bean.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    let at = |i: i32| 0.2 * f64::from(i);
    let table = (-35..=35).flat_map(|i| (-30..=30).map(move |j| [at(i), at(j), low]));
    save(
        &folder,
        "table.xyz",
        &[bean.clone(), table.collect()].concat(),
    );
    refused(&folder, "table.xyz", "close to each other");
    let mut strewn = bean;
    for (number, point) in strewn.iter_mut().step_by(12).enumerate() {
        *point = point.map(|x| x * (1.15 + 0.01 * (number % 40) as f64));
    }
    save(&folder, "strewn.xyz", &strewn);
    let truth = json(&folder, &["synth", "bean"]);
    let report = json(&folder, &["fit", "strewn.xyz"]);
    assert!(deviation(&report, &truth, "volume") < 1e-3);
}

#[test]
fn two_balls_and_a_hollow_in_one_mesh_are_refused_and_the_largest_is_fitted_if_asked_for() {
    let folder = folder();
    let mut inner = ball(12, 0.5, 0.0);
    inner.triangles.iter_mut().for_each(|t| t.reverse());
    save_mesh(
        &folder,
        "two.stl",
        &joined(&[ball(12, 1.0, 0.0), ball(12, 1.5, 4.0)]),
    );
    save_mesh(&folder, "hollow.stl", &joined(&[ball(12, 1.0, 0.0), inner]));
    refused(&folder, "two.stl", "2 separate bodies");
    refused(&folder, "hollow.stl", "1 inner surface");
    for (name, radius, told) in [
        ("two.stl", 1.5_f64, "Another body was left out"),
        ("hollow.stl", 1.0, "The scan has 1 hollow in it"),
    ] {
        let report = json(&folder, &["fit", name, "--largest"]);
        let truth = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        assert!(
            (number(&report, "volume") / truth - 1.0).abs() < 1e-4,
            "{report}"
        );
        assert!(warns(&report, told), "{report}");
    }
}

/// A fiftieth of all points, strewn over a box around it, closes its crust round nothing.
#[test]
fn a_banana_among_strays_is_fitted_without_them() {
    let folder = folder();
    let mut all = points(&folder, &["banana", "--points", "6000"]);
    let banana = json(&folder, &["synth", "banana", "-o", "truth.ply"]);
    let bound = |axis: usize, sign: f64| {
        let places = all.iter().map(|p| sign * p[axis]);
        sign * places.fold(f64::NEG_INFINITY, f64::max)
    };
    let bounds = [0, 1, 2].map(|axis| [bound(axis, -1.0), bound(axis, 1.0)]);
    let steps = [0.819_172_513, 0.671_043_607, 0.549_700_478];
    for stray in 1..=120 {
        all.push([0, 1, 2].map(|axis| {
            let [low, high] = bounds[axis];
            let share = (f64::from(stray) * steps[axis]).fract() - 0.5;
            0.5 * (low + high) + 1.6 * share * (high - low)
        }));
    }
    save(&folder, "strewn.xyz", &all);
    let report = json(&folder, &["fit", "strewn.xyz"]);
    assert!(warns(&report, "points lie far off the surface"), "{report}");
    let off = deviation(&report, &banana, "volume");
    assert!(off < 0.01, "{off}");
    let error = number(&report["standard_errors"], "volume") / number(&report, "volume");
    assert!(off < 4.0 * error, "{off} {error}");
}

/// Two views of a ball, each of more than half of it, as they are before they are merged.
#[test]
fn views_that_were_not_merged_are_told_as_such() {
    let folder = folder();
    let view = |side: f64, radius: f64| {
        let mut mesh = ball(24, radius, 0.0);
        let is_seen = |t: &[u32; 3]| t.iter().all(|i| side * mesh.vertices[*i as usize].x > -0.3);
        let seen = mesh.triangles.iter().copied().filter(is_seen).collect();
        mesh.triangles = seen;
        mesh
    };
    save_mesh(
        &folder,
        "views.ply",
        &joined(&[view(1.0, 2.0), view(-1.0, 2.002)]),
    );
    refused(
        &folder,
        "views.ply",
        "2 surfaces with open rims: if they are views of one grain, merge them",
    );
}

#[test]
fn a_bean_on_its_table_or_above_it_is_no_grain() {
    let folder = folder();
    let bean = points(&folder, &["bean"]);
    let lowest = bean.iter().map(|p| p[2]).fold(f64::INFINITY, f64::min);
    for (half, steps, below) in [(15.0, 60, 0.0), (8.0, 32, 0.0), (15.0, 60, 3.0)] {
        let place = |i: i32| half * (2.0 * f64::from(i) / f64::from(steps) - 1.0);
        let row = |i: i32| (0..=steps).map(move |j| [place(i), place(j), lowest - below]);
        let table: Vec<[f64; 3]> = (0..=steps).flat_map(row).collect();
        save(&folder, "table.xyz", &[bean.clone(), table].concat());
        refused(&folder, "table.xyz", "cannot fit table.xyz");
    }
}

#[test]
fn halves_of_two_beans_and_points_in_a_plane_are_refused() {
    let folder = folder();
    let other = points(&folder, &["bean", "--offset", "16,0,0"]);
    let both = [points(&folder, &["bean"]), other].concat();
    let upper: Vec<[f64; 3]> = both.iter().copied().filter(|p| p[2] > -0.3).collect();
    save(&folder, "halves.xyz", &upper);
    refused(&folder, "halves.xyz", "cannot fit halves.xyz");
    let flat: Vec<[f64; 3]> = both.iter().map(|&[x, y, _]| [x, y, 0.1 * x]).collect();
    save(&folder, "flat.xyz", &flat);
    refused(&folder, "flat.xyz", "enclose no volume");
}

#[test]
fn what_hangs_together_loosely_is_one_body() {
    let folder = folder();
    let truth = json(&folder, &["synth", "bean"]);
    let bean = points(&folder, &["bean"]);
    let steep = |p: &&[f64; 3]| (p[2] / Vector3::from(**p).norm()).abs() > 0.4;
    let caps: Vec<[f64; 3]> = bean.iter().filter(steep).copied().collect();
    let uneven = bean.iter().enumerate();
    let uneven = uneven
        .filter(|(i, p)| p[0] < 0.0 || i % 20 == 0)
        .map(|(_, p)| *p);
    // Slices of an ellipsoid, a tenth as far apart on them as between them.
    let slices = (1..20).flat_map(|ring| {
        let theta = std::f64::consts::PI * f64::from(ring) / 20.0;
        (0..300).map(move |at| {
            let (y, x) = (std::f64::consts::TAU * f64::from(at) / 300.0).sin_cos();
            [
                3.0 * theta.sin() * x,
                2.0 * theta.sin() * y,
                6.0 * theta.cos(),
            ]
        })
    });
    let ellipsoid = json!({"volume": 48.0 * std::f64::consts::PI});
    let cases = [
        ("caps", caps, &truth),
        ("uneven", uneven.collect(), &truth),
        ("slices", slices.collect(), &ellipsoid),
        ("few", bean.iter().step_by(15).copied().collect(), &truth),
    ];
    for (name, points, truth) in cases {
        save(&folder, "loose.xyz", &points);
        let report = json(&folder, &["fit", "loose.xyz", "--extrapolate"]);
        let error = deviation(&report, truth, "volume");
        assert!(error < 0.02, "{name}: {error}");
    }
}

#[test]
fn a_clump_of_dust_is_left_out_and_a_dense_spot_is_no_gap() {
    let folder = folder();
    let truth = json(&folder, &["synth", "bean"]);
    let bean = points(&folder, &["bean"]);
    let dust = (0..12).map(|i| {
        [
            20.0 + 0.01 * f64::from(i),
            3.0 + 0.02 * f64::from(i % 3),
            0.1,
        ]
    });
    save(
        &folder,
        "dust.xyz",
        &[bean.clone(), dust.collect()].concat(),
    );
    let report = json(&folder, &["fit", "dust.xyz"]);
    assert!(deviation(&report, &truth, "volume") < 1e-4, "{report}");
    assert!(warns(&report, "12 of 1550 points"), "{report}");
    let [x, y, z] = bean[77];
    let spot = (0..2000).map(|i| [x, y + 1e-12 * f64::from(i), z]);
    save(
        &folder,
        "spot.xyz",
        &[bean.clone(), spot.collect()].concat(),
    );
    let report = json(&folder, &["fit", "spot.xyz"]);
    assert!(!warns(&report, "No point lies within"), "{report}");
}

#[test]
fn faces_are_used_and_small_holes_in_them_closed() {
    let folder = folder();
    let mut mesh = ball(16, 1.0, 0.0);
    mesh.triangles.truncate(mesh.triangles.len() - 6);
    save_mesh(&folder, "hole.ply", &mesh);
    let report = json(&folder, &["fit", "hole.ply"]);
    assert_eq!(report["reference"]["kind"], "faces");
    assert!(warns(&report, "closed"), "{report}");
    let measured = json(&folder, &["measure", "hole.ply"]);
    for what in ["area", "volume"] {
        let reference = number(&report["reference"], what);
        assert!((reference / number(&measured, what) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn what_large_holes_hide_is_not_told_unless_as_a_guess() {
    let folder = folder();
    let mut open = ball(16, 1.0, 0.0);
    open.triangles.retain(|corners| {
        let heights = corners.map(|i| open.vertices[i as usize].z);
        heights.iter().any(|z| *z < 0.6)
    });
    save_mesh(&folder, "open.ply", &open);
    let cap = json(
        &folder,
        &["synth", "maize", "--missing-cap", "85", "-o", "cap.ply"],
    );
    let ball =
        json!({"area": 4.0 * std::f64::consts::PI, "volume": 4.0 / 3.0 * std::f64::consts::PI});
    for (name, truth, words) in [
        ("cap.ply", &cap, "no point lies in holes as large as a cap"),
        ("open.ply", &ball, "holes between the faces"),
    ] {
        let report = json(&folder, &["fit", name]);
        for what in ["area", "volume", "principal", "dimensions"] {
            assert!(report[what].is_null(), "{name}: {what}");
        }
        for what in ["reference", "area_error", "volume_error", "standard_errors"] {
            assert!(report[what].is_null(), "{name}: {what}");
        }
        let missing = report["not_measured"].as_array().unwrap();
        assert_eq!(missing.len(), 4);
        assert!(
            missing[0]["reason"].as_str().unwrap().contains(words),
            "{report}"
        );
        let text = succeed(&folder, &["fit", name]);
        assert!(text.contains("not told      area, volume"), "{text}");

        let guess = json(&folder, &["fit", name, "--extrapolate"]);
        assert_eq!(guess["not_measured"], json!([]));
        for what in ["area", "volume"] {
            let error = (number(&guess, what) - number(truth, what)).abs();
            let told = number(&guess["standard_errors"], what);
            assert!(error < 1.96 * told, "{name}: {what} {error} {told}");
        }
    }
}

#[test]
fn few_large_faces_are_fitted_and_not_their_corners_alone() {
    let folder = folder();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let vertices = [-0.5, 0.5].map(|z| corners.map(|[x, y]| Point3::new(0.5 * x, 0.5 * y, z)));
    let cube = Mesh {
        vertices: vertices.concat(),
        triangles: vec![
            [0, 2, 1],
            [0, 3, 2],
            [4, 5, 6],
            [4, 6, 7],
            [0, 1, 5],
            [0, 5, 4],
            [1, 2, 6],
            [1, 6, 5],
            [2, 3, 7],
            [2, 7, 6],
            [3, 0, 4],
            [3, 4, 7],
        ],
    };
    save_mesh(&folder, "cube.obj", &cube);
    let report = json(&folder, &["fit", "cube.obj"]);
    let whole = json(&folder, &["fit", "cube.obj", "--segments", "1"]);
    // Measured: 0.6 and 0.2 %.
    for report in [&report, &whole] {
        assert!(
            (number(report, "area") / 6.0 - 1.0).abs() < 0.01,
            "{report}"
        );
        assert!((number(report, "volume") - 1.0).abs() < 0.005, "{report}");
    }

    // The order of vertices and faces, and the first corners of these, do not matter.
    let mut shuffled = cube.clone();
    shuffled.vertices.reverse();
    for corners in &mut shuffled.triangles {
        *corners = corners.map(|i| 7 - i);
        corners.rotate_left(1);
    }
    shuffled.triangles.reverse();
    save_mesh(&folder, "shuffled.obj", &shuffled);
    let other = json(&folder, &["fit", "shuffled.obj", "--segments", "1"]);
    for what in ["area", "volume"] {
        let change = number(&other, what) / number(&whole, what) - 1.0;
        assert!(change.abs() < 1e-6, "{what}: {change}");
    }
}

#[test]
fn grains_of_any_size_are_fitted_and_what_no_number_holds_is_null() {
    let folder = folder();
    let bean = points(&folder, &["bean"]);
    let plain = {
        save(&folder, "scaled.xyz", &bean);
        json(&folder, &["fit", "scaled.xyz"])
    };
    for size in [1e-60, 1e60, 1e-90, 1e95] {
        let scaled: Vec<_> = bean.iter().map(|p| p.map(|x| x * size)).collect();
        save(&folder, "scaled.xyz", &scaled);
        let report = json(&folder, &["fit", "scaled.xyz"]);
        let volume = number(&report, "volume") / number(&plain, "volume");
        assert!(
            (volume.ln() / size.ln() - 3.0).abs() < 1e-6,
            "{size:e}: {volume}"
        );
        let length = number(&report["dimensions"], "length");
        assert!((length / size / number(&plain["dimensions"], "length") - 1.0).abs() < 1e-6);
        let is_beyond = size.ln().abs() > 200.0;
        assert_eq!(report["principal"].is_null(), is_beyond);
        assert_eq!(
            report["not_measured"].as_array().unwrap().len(),
            usize::from(is_beyond)
        );
        assert!(report["standard_errors"].is_null(), "{size:e}");
    }
}

#[test]
fn noise_that_was_not_estimated_is_null() {
    let folder = folder();
    let few: Vec<_> = points(
        &folder,
        &["sphere", "--points", "16", "--sampling", "fibonacci"],
    );
    save(&folder, "few.xyz", &few);
    for words in [&["--seams", "none"][..], &["--symmetry", "xyz"]] {
        let report = json(&folder, &[&["fit", "few.xyz"], words].concat());
        assert_ne!(report["noise"], 0.0, "{report}");
    }
}

#[test]
fn the_choice_does_not_depend_on_order_place_or_turn() {
    let folder = folder();
    let maize = points(&folder, &["maize"]);
    let strides = (0..7).flat_map(|start| maize.iter().skip(start).step_by(7));
    let cases: [Vec<[f64; 3]>; 5] = [
        maize.clone(),
        strides.copied().collect(),
        maize
            .iter()
            .map(|&[x, y, z]| [x + 100.0, y + 50.0, z - 30.0])
            .collect(),
        maize.iter().map(|&[x, y, z]| [x, -z, y]).collect(),
        maize.iter().map(|&[x, y, z]| [-y, x, z]).collect(),
    ];
    let chosen = cases.map(|points| {
        save(&folder, "maize.xyz", &points);
        let report = json(&folder, &["fit", "maize.xyz"]);
        ["degree", "segments", "coefficients", "rule"].map(|name| match name {
            // The limit in it is a length, and rounded.
            "rule" => json!(report[name].as_str().unwrap().split_once(" of ").unwrap().0),
            _ => report[name].clone(),
        })
    });
    assert!(
        chosen.iter().all(|choice| *choice == chosen[0]),
        "{chosen:#?}"
    );
}

#[test]
fn two_layers_of_points_are_told_and_errors_hold_either() {
    let folder = folder();
    let one = points(
        &folder,
        &["maize", "--points", "3000", "--sampling", "random"],
    );
    let apart = 0.03;
    let two: Vec<[f64; 3]> = one
        .iter()
        .enumerate()
        .map(|(at, point)| match at % 2 {
            0 => *point,
            _ => point.map(|x| (1.0 + apart) * x),
        })
        .collect();
    save(&folder, "one.xyz", &one);
    save(&folder, "two.xyz", &two);
    let [clean, layered] = ["one.xyz", "two.xyz"].map(|name| json(&folder, &["fit", name]));
    assert!(!clean["warnings"].to_string().contains("two layers"));
    assert!(
        layered["warnings"].to_string().contains("two layers"),
        "{}",
        layered["warnings"]
    );
    let volume = number(&clean, "volume");
    let error = number(&layered["standard_errors"], "volume");
    for layer in [volume, volume * (1.0 + apart).powi(3)] {
        assert!(
            (number(&layered, "volume") - layer).abs() < 1.5 * error,
            "{error}"
        );
    }
    assert!(error < 2.0 * apart * volume, "{error}");
}
