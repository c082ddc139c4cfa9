//! Superquadrics from the command line: fitted, saved, measured, meshed, and placed beside each other.

use super::{errors, folder, grainform, json, succeed};

/// A folder with a scan of an oblate ellipsoid of semi-axes 2, 2 and 1.
fn ellipsoid() -> tempfile::TempDir {
    let folder = folder();
    succeed(&folder, &["synth", "ellipsoid", "-o", "s.ply"]);
    folder
}

#[test]
fn an_ellipsoid_is_a_superquadric_of_exponents_two() {
    let folder = ellipsoid();
    let volume = 16.0 / 3.0 * std::f64::consts::PI;
    for (surface, numbers) in [("superquadric", 5), ("poly", 8), ("poly12", 12)] {
        let fit = [
            "fit",
            "s.ply",
            "--surface",
            surface,
            "-o",
            "m.json",
            "--mesh",
            "m.ply",
        ];
        let report = json(&folder, &fit);
        assert!((report["volume"].as_f64().unwrap() / volume - 1.0).abs() < 1e-4);
        assert!(report["rms"].as_f64().unwrap() < 1e-4);
        let part = &report["parts"][0];
        assert!(
            (part["n1"][0].as_f64().unwrap() - 2.0).abs() < 1e-2,
            "{numbers}"
        );
        let measured = json(&folder, &["measure", "m.json", "--only", "area,volume"]);
        for figure in ["area", "volume"] {
            let [told, found] = [&report[figure], &measured[figure]].map(|x| x.as_f64().unwrap());
            assert!(
                (found / told - 1.0).abs() < 1e-6,
                "{figure}: {told} {found}"
            );
        }
        let mesh = json(&folder, &["measure", "m.ply", "--only", "volume"]);
        assert!((mesh["volume"].as_f64().unwrap() / volume - 1.0).abs() < 1e-2);
    }
}

#[test]
fn exponents_at_their_bounds_are_warned_of() {
    let folder = ellipsoid();
    succeed(&folder, &["synth", "cuboid", "-o", "c.ply"]);
    let told = |scan: &str| {
        let words = ["fit", scan, "--surface", "superquadric"];
        errors(&grainform(&folder, &words)).contains("An exponent is at its bound")
    };
    assert!(told("c.ply") && !told("s.ply"));
}

#[test]
fn a_union_is_saved_with_all_its_parts() {
    let folder = folder();
    succeed(&folder, &["synth", "bean", "-o", "s.ply"]);
    let fit = ["fit", "s.ply", "--surface", "multi:2", "-o", "m.json"];
    let text = succeed(&folder, &fit);
    assert!(
        text.contains("2 superquadrics") && text.contains("held-out RMS"),
        "{text}"
    );
    let report = json(&folder, &["fit", "s.ply", "--surface", "multi:2"]);
    let measured = json(&folder, &["measure", "m.json", "--only", "area,volume"]);
    for figure in ["area", "volume"] {
        let [told, found] = [&report[figure], &measured[figure]].map(|x| x.as_f64().unwrap());
        assert!(
            (found / told - 1.0).abs() < 1e-3,
            "{figure}: {told} {found}"
        );
    }
}

#[test]
fn two_bodies_touch_where_they_are_placed() {
    let folder = ellipsoid();
    succeed(
        &folder,
        &["fit", "s.ply", "--surface", "superquadric", "-o", "m.json"],
    );
    let placed = |pose: &str| json(&folder, &["contact", "m.json", "m.json", "--pose-b", pose]);
    let stacked = placed("0,0,1.98,1,0,0,0");
    let touches = stacked["touches"].as_array().unwrap();
    assert_eq!(touches.len(), 1);
    assert!((touches[0]["overlap"].as_f64().unwrap() - 0.02).abs() < 1e-3);
    assert!(touches[0]["normal"][2].as_f64().unwrap() > 0.999);
    // Turned by a right angle about y, it stands on its rim.
    let rim = placed("0,0,2.98,0.7071067811865476,0,0.7071067811865476,0");
    assert!((rim["touches"][0]["overlap"].as_f64().unwrap() - 0.02).abs() < 1e-3);
    assert_eq!(
        placed("0,0,2.1,1,0,0,0")["touches"]
            .as_array()
            .unwrap()
            .len(),
        0
    );
}

#[test]
fn of_a_body_that_was_not_seen_whole_area_and_volume_are_guesses() {
    let folder = folder();
    let synth = ["synth", "ellipsoid", "--missing-cap", "80", "-o", "s.ply"];
    succeed(
        &folder,
        &[&synth[..], &["--points", "400", "--noise", "0.5%"]].concat(),
    );
    let fit = ["fit", "s.ply", "--surface", "superquadric", "-o", "m.json"];
    let report = json(&folder, &fit);
    assert!(report["area"].is_null() && report["volume_error"].is_null());
    assert_eq!(report["not_measured"].as_array().unwrap().len(), 2);
    assert!(report["reference"].is_null());
    let text = succeed(&folder, &fit);
    assert!(
        text.contains("not told      area, volume: no point lies in"),
        "{text}"
    );
    let measured = json(&folder, &["measure", "m.json", "--only", "volume"]);
    assert!(measured["volume"].is_null());
    let guessed = json(&folder, &[&fit[..4], &["--extrapolate"]].concat());
    assert!(guessed["volume"].as_f64().unwrap() > 10.0);
}

#[test]
fn what_does_not_go_with_superquadrics_is_refused() {
    let folder = ellipsoid();
    for (words, reason) in [
        (&["--surface", "multi:0"][..], "from 1 to 12 parts"),
        (&["--surface", "cube"], "expected auto, star"),
        (
            &["--surface", "poly", "--degree", "3"],
            "leave these options away",
        ),
    ] {
        let output = grainform(&folder, &[&["fit", "s.ply"], words].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(errors(&output).contains(reason), "{}", errors(&output));
    }
}
