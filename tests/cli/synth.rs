use super::{deviation, errors, folder, grain, grainform, json, names, number, succeed};

#[test]
fn the_grains_of_the_repository_are_regenerated_byte_for_byte() {
    let folder = folder();
    for body in ["bean", "chickpea", "maize"] {
        let name = format!("{body}.ply");
        succeed(&folder, &["synth", body, "-o", &name]);
        let made = std::fs::read(folder.path().join(&name)).unwrap();
        assert!(made == std::fs::read(grain(&name)).unwrap(), "{name}");
    }
}

#[test]
fn prints_the_truth_and_writes_nothing_unless_asked_to() {
    let folder = folder();
    let report = json(&folder, &["synth", "sphere"]);
    let sphere = 4.0 * std::f64::consts::PI * 25.0;
    assert!((number(&report, "area") / sphere - 1.0).abs() < 1e-10);
    assert!((number(&report, "volume") / (sphere * 5.0 / 3.0) - 1.0).abs() < 1e-10);
    assert_eq!(report["points"], 1538);
    assert!(report["output"].is_null());
    let text = succeed(&folder, &["synth", "sphere"]);
    assert!(
        text.contains("1538 points") && text.contains("314.159"),
        "{text}"
    );
    assert!(names(folder.path()).is_empty());
}

#[test]
fn the_same_seed_gives_the_same_scan_in_both_formats() {
    let folder = folder();
    let make = |seed: &str, name: &str| {
        let words = ["--sampling", "random", "--noise", "0.01", "--points", "500"];
        let words = [&["synth", "bean", "--seed", seed, "-o", name], &words[..]].concat();
        let report = json(&folder, &words);
        assert_eq!(report["points"], 500);
        let path = folder.path().join(name);
        grainform::scan::read_scan(&path).unwrap().points().to_vec()
    };
    let first = make("1", "a.ply");
    assert_eq!(first, make("1", "b.xyz"));
    assert_ne!(first, make("2", "c.ply"));
}

#[test]
fn the_offset_moves_the_centroid_and_nothing_else() {
    let folder = folder();
    let here = json(&folder, &["synth", "bean"]);
    let there = json(&folder, &["synth", "bean", "--offset=-10,0,2.5"]);
    let moved =
        |i: usize| there["centroid"][i].as_f64().unwrap() - here["centroid"][i].as_f64().unwrap();
    assert_eq!(
        [0, 1, 2].map(|i| (moved(i) * 1e9).round() / 1e9),
        [-10.0, 0.0, 2.5]
    );
    assert_eq!(deviation(&here, &there, "volume"), 0.0);
}

#[test]
fn a_shape_has_the_axes_asked_for_and_its_exact_figures() {
    let folder = folder();
    let words = ["synth", "cylinder", "--axes", "3,3,0.5", "-o", "c.ply"];
    let report = json(&folder, &words);
    let area = std::f64::consts::TAU * 3.0 * (3.0 + 1.0);
    assert!((number(&report, "area") / area - 1.0).abs() < 1e-14);
    assert_eq!(number(&report, "relative_error"), 1e-14);
    assert_eq!(report["axes"], serde_json::json!([3.0, 3.0, 0.5]));
    let path = folder.path().join("c.ply");
    for p in grainform::scan::read_scan(&path).unwrap().points() {
        let place = (p.x.hypot(p.y) / 3.0).max(p.z.abs() / 0.5);
        assert!((place - 1.0).abs() < 1e-12, "{p}");
    }
}

#[test]
fn shapes_have_axes_of_their_own_and_grains_have_none() {
    let folder = folder();
    let report = json(&folder, &["synth", "bicone"]);
    assert_eq!(report["axes"], serde_json::json!([2.0, 2.0, 1.0]));
    assert!(json(&folder, &["synth", "maize"])["axes"].is_null());
    let text = succeed(&folder, &["synth", "cube"]);
    assert!(
        text.contains("semi-axes    1.00000  1.00000  1.00000"),
        "{text}"
    );
    assert!(text.contains("to 1e-14"), "{text}");
}

#[test]
fn superquadrics_have_exponents_and_the_rest_have_none() {
    let folder = folder();
    let words = [
        "synth",
        "superquadric",
        "--axes",
        "1,2,3",
        "--exponents",
        "2,2",
    ];
    let report = json(&folder, &words);
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 6.0;
    assert!((number(&report, "volume") / volume - 1.0).abs() < 1e-12);
    let words = [
        "synth",
        "poly",
        "--axes",
        "1.4,.8,1.2,.8,.6,.9",
        "-o",
        "p.ply",
    ];
    let report = json(&folder, &words);
    assert_eq!(report["axes"].as_array().unwrap().len(), 6);
    assert_eq!(report["exponents"], serde_json::json!([4.0, 2.0]));
    let refused = errors(&grainform(
        &folder,
        &["synth", "bean", "--exponents", "2,2"],
    ));
    assert!(refused.contains("leave them out"), "{refused}");
}

#[test]
fn a_hook_is_a_mesh_or_as_many_points_as_asked_for() {
    let folder = folder();
    let report = json(&folder, &["synth", "hook", "-o", "hook.stl"]);
    assert_eq!(report["triangles"], 27648);
    let of_faces = json(&folder, &["measure", "hook.stl", "--only", "volume"]);
    let share = number(&of_faces, "volume") / number(&report, "volume");
    assert!(0.99 < share && share < 1.0, "{share}");
    let report = json(
        &folder,
        &["synth", "hook", "--points", "500", "-o", "hook.xyz"],
    );
    assert_eq!(report["triangles"], 0);
    let path = folder.path().join("hook.xyz");
    let scan = grainform::scan::read_scan(&path).unwrap();
    assert_eq!(scan.points().len(), 500);
}
