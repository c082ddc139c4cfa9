//! A model's file tells the standard errors of its fit, or why there are none, wherever it is measured.

use super::{folder, grain, json, succeed};
use serde_json::Value;
use std::fs;
use tempfile::TempDir;

/// What the fit of a scan with these options tells of errors, and what is measured of its model.
fn told(folder: &TempDir, scan: &str, options: &str) -> [Value; 2] {
    let options = options.split_whitespace();
    let fit: Vec<&str> = ["fit", scan, "-o", "m.json"]
        .into_iter()
        .chain(options)
        .collect();
    [json(folder, &fit), json(folder, &["measure", "m.json"])]
}

#[test]
fn errors_of_a_model_are_those_of_its_fit() {
    let folder = folder();
    let noisy = "synth bean --points 800 --noise 0.005 -o s.ply";
    succeed(&folder, &noisy.split(' ').collect::<Vec<_>>());
    succeed(&folder, &["synth", "banana", "-o", "banana.ply"]);
    succeed(
        &folder,
        &["synth", "cube", "--points", "1538", "-o", "cube.ply"],
    );
    for (scan, options, has_errors) in [
        ("s.ply", "", true),
        ("s.ply", "--segments 1", true),
        ("s.ply", "--surface position", true),
        ("banana.ply", "", true),
        ("s.ply", "--seams none", false),
        ("s.ply", "--symmetry z --degree 3", false),
        ("cube.ply", "", false),
    ] {
        let [fit, measured] = told(&folder, scan, options);
        for key in ["standard_errors", "no_standard_errors"] {
            assert_eq!(fit[key], measured[key], "{scan} {options}: {key}");
        }
        let model = fs::read_to_string(folder.path().join("m.json")).unwrap();
        let model: Value = serde_json::from_str(&model).unwrap();
        let errors = &fit["standard_errors"];
        assert!(!has_errors || errors["axes"] == model["axes"], "{errors}");
        assert_eq!(measured["standard_errors"].is_object(), has_errors);
        assert_eq!(measured["no_standard_errors"].is_string(), !has_errors);
    }
    let [_, measured] = told(&folder, "s.ply", "--surface superquadric");
    assert_eq!(
        measured["no_standard_errors"],
        "the model is fitted to the points themselves"
    );
}

/// A program that reads a model and writes it as it is changes nothing; one that makes the grain larger leaves errors of another one.
#[test]
fn errors_of_a_model_that_was_edited_are_not_told() {
    let folder = folder();
    let noisy = "synth bean --points 800 --noise 0.005 -o s.ply";
    succeed(&folder, &noisy.split(' ').collect::<Vec<_>>());
    for options in ["", "--segments 1", "--surface position --segments 1"] {
        let [fit, _] = told(&folder, "s.ply", options);
        let path = folder.path().join("m.json");
        let text = fs::read_to_string(&path).unwrap();
        let mut model: Value = serde_json::from_str(&text).unwrap();
        let measured = |model: &Value| {
            fs::write(&path, model.to_string()).unwrap();
            json(&folder, &["measure", "m.json"])
        };
        let unchanged = measured(&model);
        assert_eq!(unchanged["standard_errors"], fit["standard_errors"]);
        assert!(unchanged["curvature"]["standard_errors"].is_object());
        model["centre"][0] = (model["centre"][0].as_f64().unwrap() + 1.0).into();
        let edited = measured(&model);
        assert!(edited["standard_errors"].is_null(), "{options}");
        assert!(edited["curvature"]["standard_errors"].is_null());
        let reason = edited["no_standard_errors"].as_str().unwrap();
        assert!(reason.starts_with("the model was changed after its fit"));
        model.as_object_mut().unwrap().remove("checksum").unwrap();
        assert!(measured(&model)["standard_errors"].is_null());
        // Files before version 8 had none.
        model["version"] = 7.into();
        assert!(measured(&model)["standard_errors"].is_object());
    }
}

#[test]
fn errors_of_a_guess_are_told_with_it() {
    let folder = folder();
    let synth = "synth ellipsoid --points 800 --noise 0.002 --missing-cap 50 -o s.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    let [fit, withheld] = told(&folder, "s.ply", "--extrapolate");
    assert!(withheld["standard_errors"].is_null());
    let guess = json(&folder, &["measure", "m.json", "--extrapolate"]);
    assert!(guess["standard_errors"].is_object());
    assert_eq!(fit["standard_errors"], guess["standard_errors"]);
}

#[test]
fn errors_stand_beside_their_figures_with_the_unit() {
    let folder = folder();
    let scan = grain("maize.ply");
    let fit = succeed(&folder, &["fit", &scan, "-o", "m.json", "--unit", "mm"]);
    let measured = succeed(&folder, &["measure", "m.json", "--unit", "mm"]);
    for name in ["area  ", "volume  "] {
        let line = |text: &str| -> String {
            let line = text.lines().find(|line| line.starts_with(name));
            line.expect("a line").to_owned()
        };
        assert!(line(&fit).contains(" ± "), "{fit}");
        assert_eq!(line(&fit), line(&measured));
    }
    let length = measured.split("length ").nth(1).unwrap();
    let length = length.split(',').next().unwrap();
    assert!(fit.contains(&length.replace(" mm", " x ")), "{length}");
    assert!(measured.contains("Figures after ± are standard errors."));
    let other = succeed(
        &folder,
        &["measure", "m.json", "--scheme", "four-triangles"],
    );
    assert!(other.contains("No standard errors: the figures have the errors of their scheme"));
}

#[test]
fn an_old_model_and_a_scan_say_why_there_are_none() {
    let folder = folder();
    succeed(&folder, &["fit", &grain("bean.ply"), "-o", "m.json"]);
    let path = folder.path().join("m.json");
    let mut model: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    model.as_object_mut().unwrap().remove("standard_errors");
    model["version"] = 5.into();
    fs::write(&path, model.to_string()).unwrap();
    let text = succeed(&folder, &["measure", "m.json", "--only", "area"]);
    assert!(
        text.contains("No standard errors: the model tells none.\n"),
        "{text}"
    );
    let text = succeed(&folder, &["measure", &grain("bean.ply"), "--only", "area"]);
    assert!(text.contains("No standard errors: the figures are those of the polyhedron"));
    let text = succeed(&folder, &["measure", "m.json", "--only", "roundness"]);
    assert!(
        text.contains("No standard errors: the model tells none."),
        "{text}"
    );
}

#[test]
fn a_page_of_a_model_tells_the_errors_that_a_page_of_its_scan_tells() {
    let folder = folder();
    let scan = grain("bean.ply");
    succeed(&folder, &["fit", &scan, "-o", "m.json"]);
    let rows = |input: &str| {
        succeed(&folder, &["report", input, "-o", "r.html"]);
        let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
        let rows = page.split("\"measures\":").nth(1).unwrap();
        rows.split("}]").next().unwrap().to_owned()
    };
    let of_model = rows("m.json");
    assert_eq!(of_model, rows(&scan));
    for name in ["area", "volume", "dimensions.length", "principal.moments"] {
        assert!(
            !of_model.contains(&format!("\"error\":null,\"name\":\"{name}\"")),
            "{name}"
        );
    }
}
