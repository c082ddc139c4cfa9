//! Bodies that no centre sees whole.

use super::{errors, folder, grainform, json, number, succeed};
use grainform::Mesh;
use grainform::export::save_mesh;
use nalgebra::Point3;
use std::path::Path;

/// A banana, 230 degrees round, as a mesh of 2402 vertices.
fn banana(folder: &Path) {
    let mut mesh = Mesh::radial(20, |_| 1.0);
    for vertex in &mut mesh.vertices {
        let (out, angle) = (1.5 + 0.5 * vertex.y, 2.0 * vertex.x);
        *vertex = Point3::new(out * angle.sin(), out * angle.cos(), 0.4 * vertex.z);
    }
    save_mesh(&folder.join("banana.ply"), &mesh).unwrap();
}

#[test]
fn a_banana_is_fitted_measured_and_touched() {
    let folder = folder();
    banana(folder.path());
    let star = ["fit", "banana.ply", "--surface", "star"];
    let refused = errors(&grainform(&folder, &star));
    assert!(refused.contains("faces away"), "{refused}");

    let report = json(
        &folder,
        &["fit", "banana.ply", "--tolerance", "0.5%", "-o", "b.json"],
    );
    assert_eq!(report["surface"], "position");
    let why = report["surface_rule"].as_str().unwrap();
    assert!(
        why.ends_with("% of the area faces away from the best centre"),
        "{why}"
    );
    let of_faces = json(&folder, &["measure", "banana.ply", "--only", "area,volume"]);
    for figure in ["area", "volume"] {
        let share = number(&report, figure) / number(&of_faces, figure);
        // The facets lie within the surface.
        assert!((share - 1.004).abs() < 0.006, "{figure}: {share}");
    }
    assert!(number(&report, "heldout_rms") < 5e-3 * number(&report, "mean_radius"));
    let ball = 4.0 / 3.0 * std::f64::consts::PI * number(&report, "mean_radius").powi(3);
    assert!((ball / number(&report, "volume") - 1.0).abs() < 1e-12);
    assert!(number(&report["standard_errors"], "volume") < 0.01 * number(&report, "volume"));

    let measured = json(&folder, &["measure", "b.json"]);
    assert_eq!(number(&measured, "volume"), number(&report, "volume"));
    let missing = measured["not_measured"].as_array().unwrap();
    let missing: Vec<_> = missing
        .iter()
        .map(|one| one["measure"].as_str().unwrap())
        .collect();
    // Rays from its centroid meet it twice, or not at all.
    assert_eq!(missing, ["angularity", "spectrum"]);
    let words =
        "contact b.json --towards 0,1,0 --unit mm --youngs-modulus-mpa 91 --indentation-um 1";
    let contact: Vec<&str> = words.split(' ').collect();
    // The back of the bend, of radius 2, on which cells pull the surface two ways.
    let refused = errors(&grainform(&folder, &contact));
    assert!(refused.contains("is curved by 0.5"), "{refused}");
    assert!(refused.contains("no force is vouched for"), "{refused}");
}

#[test]
fn points_of_a_banana_are_fitted_without_faces() {
    let folder = folder();
    let words = ["synth", "banana", "--points", "2500", "-o", "points.xyz"];
    let truth = json(&folder, &words);
    let words = [
        "fit",
        "points.xyz",
        "--surface",
        "position",
        "--tolerance",
        "1%",
        "-o",
        "b.json",
    ];
    let report = json(&folder, &words);
    assert_eq!(report["reference"]["kind"], "crust");
    for figure in ["area", "volume"] {
        let share = number(&report, figure) / number(&truth, figure);
        assert!((share - 1.0).abs() < 0.01, "{figure}: {share}");
        let error = number(&report["standard_errors"], figure) / number(&truth, figure);
        assert!(error > 0.0 && error < 0.01, "{figure}: {error}");
    }
    succeed(&folder, &["measure", "b.json", "--only", "dimensions"]);
}

#[test]
fn degrees_that_are_asked_for_are_kept_and_one_that_is_a_point_refused() {
    let folder = folder();
    let mut mesh = Mesh::radial(16, |_| 1.0);
    for vertex in &mut mesh.vertices {
        vertex.x *= 10.0;
        vertex.y += 0.05 * vertex.x * vertex.x;
    }
    save_mesh(&folder.path().join("bent.ply"), &mesh).unwrap();
    let fit = |more: &[&str]| {
        let words = [&["fit", "bent.ply", "--surface", "position"], more].concat();
        json(&folder, &words)
    };
    assert_eq!(number(&fit(&["--degree", "1"]), "degree"), 1.0);
    assert!(number(&fit(&["--max-degree", "2"]), "degree") <= 2.0);
    let words = ["--segments", "1", "--max-degree", "2"];
    assert_eq!(number(&fit(&words), "degree"), 2.0);
    let words = "fit bent.ply --surface position --segments 1 --degree 0";
    let words: Vec<&str> = words.split(' ').collect();
    let refused = errors(&grainform(&folder, &words));
    assert!(refused.contains("ask for degree 1 or more"), "{refused}");
}

#[test]
fn points_that_no_kind_fits_are_told_why_for_both() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "cup", "--points", "300", "-o", "cup.xyz"],
    );
    let refused = errors(&grainform(&folder, &["fit", "cup.xyz"]));
    for part in ["mesh the points", "Positions cannot be fitted either"] {
        assert!(refused.contains(part), "{refused}");
    }
}

/// What lies between few points is the roughness's, of which no error tells.
#[test]
fn positions_of_fewer_points_than_coefficients_have_no_errors() {
    let folder = folder();
    for (points, is_told) in [("100", false), ("800", true)] {
        succeed(
            &folder,
            &[
                "synth", "bean", "--points", points, "--noise", "0.005", "-o", "bean.xyz",
            ],
        );
        let report = json(&folder, &["fit", "bean.xyz", "--surface", "position"]);
        assert_eq!(report["standard_errors"].is_object(), is_told, "{points}");
        let why = report["no_standard_errors"].as_str();
        assert_eq!(
            why.is_some_and(|why| why.contains("fewer points")),
            !is_told
        );
    }
}

/// Products of lengths, and of curvatures, are beyond the range of numbers.
#[test]
fn positions_of_any_size_are_fitted() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "bean", "--points", "800", "-o", "bean.xyz"],
    );
    let text = std::fs::read_to_string(folder.path().join("bean.xyz")).unwrap();
    let volume = |scale: f64| {
        let scaled = |word: &str| word.parse::<f64>().unwrap() * scale;
        let line = |line: &str| {
            let words = line.split_whitespace().map(scaled);
            words.map(|x| format!("{x:e} ")).collect::<String>() + "\n"
        };
        let points: String = text.lines().map(line).collect();
        std::fs::write(folder.path().join("scaled.xyz"), points).unwrap();
        let words = [
            "fit",
            "scaled.xyz",
            "--surface",
            "position",
            "-o",
            "scaled.json",
        ];
        let report = json(&folder, &words);
        number(&report, "volume") / scale / scale / scale
    };
    let whole = volume(1.0);
    for scale in [1e-90, 1e90] {
        assert!((volume(scale) / whole - 1.0).abs() < 1e-3, "{scale}");
    }
}

#[test]
fn a_crust_of_few_points_that_is_not_their_body_is_refused() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "cylinder", "--points", "98", "-o", "c.ply"],
    );
    let refused = errors(&grainform(&folder, &["fit", "c.ply"]));
    assert!(
        refused
            .contains("Positions cannot be fitted either: the surface is off its points by 13 %"),
        "{refused}"
    );
}

/// Bounds of the search are those of a radius and of positions alike: what no centre sees is no radius because degrees are asked for.
#[test]
fn bounds_of_the_search_do_not_make_a_radius_of_what_no_centre_sees() {
    let folder = folder();
    banana(folder.path());
    for bounds in [
        "--degree 2 --segments 24",
        "--max-segments 24",
        "--max-degree 3",
    ] {
        let words: Vec<&str> = "fit banana.ply"
            .split(' ')
            .chain(bounds.split(' '))
            .collect();
        assert_eq!(json(&folder, &words)["surface"], "position", "{bounds}");
    }
    let grain = super::grain("bean.ply");
    let star = json(
        &folder,
        &["fit", &grain, "--degree", "2", "--segments", "24"],
    );
    assert_eq!(star["surface"], "star");
}
