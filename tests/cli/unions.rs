//! Unions of superquadrics that no centre sees whole: measured, meshed and refused.

use super::{errors, folder, grainform, json, succeed};
use std::f64::consts::PI;
use tempfile::TempDir;

/// A folder with a union of balls of radius 1 at these places.
fn balls(places: &[[f64; 3]]) -> TempDir {
    let ball = |place: &[f64; 3]| {
        format!(
            r#"{{"centre": {place:?}, "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "n1": [2, 2], "n2": [[2, 2], [2, 2]],
                "semi_axes": [[1, 1], [1, 1], [1, 1]]}}"#
        )
    };
    let parts: Vec<String> = places.iter().map(ball).collect();
    let text = format!(
        r#"{{"format": "grainform model", "version": 5, "centre": [0, 0, 0],
            "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "superquadrics": [{}]}}"#,
        parts.join(", ")
    );
    let folder = folder();
    std::fs::write(folder.path().join("u.json"), text).unwrap();
    folder
}

/// Five balls round a corner, of which each but the last reaches .5 into the next; the last is hidden from the first.
fn elbow() -> TempDir {
    balls(&[
        [0.0, 0.0, 0.0],
        [1.5, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.5, 0.0],
        [3.0, 3.0, 0.0],
    ])
}

/// The volume of the elbow: four lenses are of two balls each.
fn volume() -> f64 {
    5.0 * 4.0 / 3.0 * PI - 4.0 * PI * 5.5 * 0.25 / 12.0
}

#[test]
fn what_a_centre_does_not_see_is_measured_all_the_same() {
    let folder = elbow();
    let found = json(&folder, &["measure", "u.json"]);
    // Either side of a joint lacks a cap of height .25.
    let area = 5.0 * 4.0 * PI - 8.0 * 2.0 * PI * 0.25;
    for (figure, truth) in [("volume", volume()), ("area", area)] {
        let told = found[figure].as_f64().unwrap();
        let error = found[format!("{figure}_error")].as_f64().unwrap();
        assert!(error < 1e-4, "{figure}: {error:e}");
        assert!(
            (told / truth - 1.0).abs() <= error,
            "{figure}: {told} {truth}"
        );
    }
    let centroid = found["centroid"][2].as_f64().unwrap();
    assert!(centroid.abs() < 1e-4, "{centroid}");
    let sphericity = found["sphericity"]["wadell"].as_f64().unwrap();
    assert!((sphericity - (36.0 * PI * volume().powi(2)).cbrt() / area).abs() < 1e-4);
    let not_measured = found["not_measured"].to_string();
    for measure in ["curvature", "roundness", "regularity", "spectrum"] {
        assert!(not_measured.contains(measure), "{not_measured}");
    }
    assert!(
        not_measured.contains("hides a part of its surface"),
        "{not_measured}"
    );
    let text = succeed(&folder, &["measure", "u.json", "--only", "volume"]);
    assert!(text.contains(", integrated to "), "{text}");
}

#[test]
fn its_mesh_is_its_own_surface() {
    let folder = elbow();
    for name in ["u.stl", "u.ply"] {
        succeed(
            &folder,
            &["mesh", "u.json", "--resolution", "48", "-o", name],
        );
        let found = json(&folder, &["measure", name, "--only", "volume,area"]);
        assert!(
            (found["volume"].as_f64().unwrap() / volume() - 1.0).abs() < 5e-3,
            "{found}"
        );
        assert_eq!(found["faces"]["bodies"], 1);
    }
    let clump = json(&folder, &["clump", "u.json", "--spheres", "5"]);
    let told = clump["volume"].as_f64().unwrap();
    assert!((told / volume() - 1.0).abs() < 1e-4, "{told}");
}

/// Balls round a corner that meet by a twentieth of their radius: clefts between them are narrower than triangles.
#[test]
fn what_a_mesh_lacks_in_clefts_is_told_and_is_not_measured() {
    let places = [[0.0, 0.0], [1.9, 0.0], [3.8, 0.0], [3.8, 1.9], [3.8, 3.8]];
    let folder = balls(&places.map(|[x, y]| [x, y, 0.0]));
    let words = ["measure", "u.json", "--only", "area,convexity"];
    let found = json(&folder, &words);
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    // The hull is the triangle of the outer centres, rounded by a ball.
    let (sides, triangle) = (2.0 * 3.8 + 3.8 * 2.0_f64.sqrt(), 3.8 * 3.8 / 2.0);
    let hull = 2.0 * triangle + PI * sides + 4.0 * PI;
    let told = number(&found["convexity"]["area"]) * number(&found["area"]);
    assert!((told / hull - 1.0).abs() < 1e-3, "{told} {hull}");

    let coarse = ["mesh", "u.json", "--resolution", "16", "-o", "u.stl"];
    let told = errors(&grainform(&folder, &coarse));
    assert!(told.contains("less area than the model"), "{told}");
    let mesh = json(&folder, &["measure", "u.stl", "--only", "area"]);
    let share = 100.0 * (1.0 - number(&mesh["area"]) / number(&found["area"]));
    let share = format!("has {share:.1} % less");
    assert!(told.contains(&share), "{told} {share}");
    let mut fine = coarse;
    fine[3] = "400";
    let told = errors(&grainform(&folder, &fine));
    assert!(!told.contains("less area"), "{told}");
}

#[test]
fn what_takes_its_surface_over_directions_is_refused() {
    let folder = elbow();
    let pose = ["--pose-b", "0,0,1.9,1,0,0,0", "--unit", "mm"];
    let placed = [&["contact", "u.json", "u.json"], &pose[..]].concat();
    let touches = json(&folder, &placed);
    assert_eq!(touches["unit"], "mm");
    assert_eq!(touches["touches"].as_array().unwrap().len(), 5);
    let hertz = [&placed[..], &["--youngs-modulus-mpa", "10"]].concat();
    // Two balls with a radius of a millimetre: E* = E / 2 (1 - .3²), R = .5 mm, F = 4/3 E* R^.5 d^1.5.
    let modulus = 1e7 / (2.0 * 0.91);
    for touch in json(&folder, &hertz)["touches"].as_array().unwrap() {
        let depth = 1e-3 * touch["overlap"].as_f64().unwrap();
        let force = 4.0 / 3.0 * modulus * 5e-4_f64.sqrt() * depth.powf(1.5);
        let told = touch["normal_force_n"].as_f64().unwrap();
        assert!((told / force - 1.0).abs() < 1e-6, "{told} {force}");
    }
    let shared = [&hertz[..], &["--law", "volume"]].concat();
    for words in [&shared[..], &["report", "u.json", "-o", "r.html"]] {
        let output = grainform(&folder, words);
        assert_eq!(output.status.code(), Some(2));
        let told = errors(&output);
        assert!(
            told.contains("hides a part of its surface from its centre"),
            "{told}"
        );
    }
}

#[test]
fn parts_that_lie_apart_are_no_grain() {
    let folder = balls(&[[0.0; 3], [20.0, 0.0, 0.0]]);
    for words in [
        &["measure", "u.json"][..],
        &["mesh", "u.json", "-o", "u.stl"],
    ] {
        let output = grainform(&folder, words);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            errors(&output).contains("part 1 of the union"),
            "{}",
            errors(&output)
        );
    }
}

#[test]
fn points_that_no_centre_sees_are_fitted_by_a_union_all_of_them() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "hook", "--points", "1500", "-o", "s.ply"],
    );
    let found = json(
        &folder,
        &["fit", "s.ply", "--surface", "multi:3", "-o", "u.json"],
    );
    assert_eq!(found["points"], 1500);
    let measured = json(&folder, &["measure", "u.json", "--only", "volume"]);
    let [told, again] = [&found, &measured].map(|report| report["volume"].as_f64().unwrap());
    assert!((told / again - 1.0).abs() < 1e-12, "{told} {again}");
}

#[test]
fn a_body_that_so_few_parts_are_not_is_told_of() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "cup", "--points", "1500", "-o", "s.ply"],
    );
    let found = json(&folder, &["fit", "s.ply", "--surface", "multi:1"]);
    let warnings = found["warnings"].to_string();
    assert!(
        warnings.contains("area and volume are theirs"),
        "{warnings}"
    );
}

/// A union has no contact with what holds all of it.
#[test]
fn one_wholly_in_another_is_refused() {
    let folder = elbow();
    let ball = r#"{"format": "grainform model", "version": 5, "centre": [0, 0, 0],
        "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "superquadrics": [{"centre": [0, 0, 0],
        "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "n1": [2, 2], "n2": [[2, 2], [2, 2]],
        "semi_axes": [[9, 9], [9, 9], [9, 9]]}]}"#;
    std::fs::write(folder.path().join("ball.json"), ball).unwrap();
    for (bodies, pose) in [
        (["ball.json", "u.json"], "0,0,0,1,0,0,0"),
        (["u.json", "ball.json"], "3,0,0,1,0,0,0"),
        (["u.json", "u.json"], "0,0,0,1,0,0,0"),
    ] {
        let words = [&["contact"], &bodies[..], &["--pose-b", pose]].concat();
        let output = grainform(&folder, &words);
        assert_eq!(output.status.code(), Some(2), "{bodies:?}");
        let told = errors(&output);
        assert!(
            told.contains("one body lies wholly inside the other"),
            "{told}"
        );
    }
    let touching = [
        "contact",
        "ball.json",
        "u.json",
        "--pose-b",
        "7,0,0,1,0,0,0",
    ];
    assert!(
        !json(&folder, &touching)["touches"]
            .as_array()
            .unwrap()
            .is_empty()
    );
}
