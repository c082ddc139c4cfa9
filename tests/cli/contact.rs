use super::{errors, folder, grainform, json, succeed};

/// A model of an oblate ellipsoid of semi-axes 2, 2 and 1.
fn ellipsoid() -> tempfile::TempDir {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "ellipsoid", "--points", "6146", "-o", "s.ply"],
    );
    let fit = ["fit", "s.ply", "--tolerance", "0.01%", "-o", "m.json"];
    succeed(&folder, &fit);
    folder
}

#[test]
fn two_placed_surfaces_overlap_where_their_poles_meet_and_both_laws_agree_there() {
    let folder = ellipsoid();
    let placed = |pose: &str, more: &[&str]| {
        let words = ["contact", "m.json", "m.json", "--pose-b", pose];
        json(&folder, &[&words, more].concat())
    };
    let turned = |q: &str| placed(&format!("0,0,1.98,{q}"), &[])["regions"].clone();
    assert_eq!(turned("1e200,1e200,0,0"), turned("1,1,0,0"));
    assert_eq!(turned("-1e-200,0,0,0"), turned("1,0,0,0"));
    let apart = placed("0,0,2.3,1,0,0,0", &[]);
    assert_eq!(apart["regions"].as_array().unwrap().len(), 0);
    assert_eq!(apart["triangles_skipped"], apart["triangles"]);

    let load = ["--unit", "mm", "--youngs-modulus-mpa", "91"];
    let by = |law| placed("0,0,1.98,1,0,0,0", &[&load[..], &["--law", law]].concat());
    let [hertz, volume] = ["hertz", "volume"].map(by);
    let words = "contact m.json m.json --pose-b 0,0,1.98,1,0,0,0 --mesh both.vtp";
    let told = succeed(&folder, &words.split(' ').collect::<Vec<_>>());
    assert!(told.ends_with("wrote both.vtp\n"), "{told}");
    let both = std::fs::read(folder.path().join("both.vtp")).unwrap();
    let head = String::from_utf8_lossy(&both[..500]);
    // Two bodies of 24578 vertices, and three bars of eight.
    assert!(head.contains("NumberOfPoints=\"49180\""), "{head}");
    assert!(head.contains("Name=\"body\""), "{head}");
    let figure = |report: &serde_json::Value, name: &str| {
        let regions = report["regions"].as_array().unwrap();
        assert_eq!(regions.len(), 1);
        regions[0][name].as_f64().unwrap()
    };
    let depth = figure(&hertz, "depth");
    assert!((depth / 0.02 - 1.0).abs() < 0.05, "{depth}");
    // Two caps of radius of curvature 4: R* = 2, V = pi R* u².
    let shared = figure(&hertz, "volume");
    let expected = std::f64::consts::PI * 2.0 * depth * depth;
    assert!((shared / expected - 1.0).abs() < 0.02, "{shared}");
    // E* = 50 MPa.
    let force = 4.0 / 3.0 * 50e6 * (2e-3_f64).sqrt() * (1e-3 * depth).powf(1.5);
    let told = figure(&hertz, "normal_force_n");
    assert!((told / force - 1.0).abs() < 0.03, "{told} {force}");
    // Of the volume, with R* of the balls of equal volume, 4^(1/3) / 2: F ~ R*^(-3/4) V^(1/4) dV/du.
    let expected = force * (2.0 / (0.5 * 4_f64.cbrt())).powf(0.75);
    let told = figure(&volume, "normal_force_n");
    assert!((told / expected - 1.0).abs() < 0.03, "{told} {expected}");
}

#[test]
fn an_ellipsoid_on_a_plane_is_pressed_as_hertz_has_it() {
    let folder = ellipsoid();
    let load = [
        "--unit",
        "mm",
        "--indentation-um",
        "10",
        "--youngs-modulus-mpa",
        "91",
        "--other-youngs-modulus-mpa",
        "inf",
    ];
    for (towards, radii, force) in [
        // E* = 100 MPa; F = 4/3 E* c sqrt(rho) u^1.5, with the exact c of A/B = 1 and 4.
        ("0,0,-1", [4.0, 4.0], 4.0 / 3.0 * 100e6 * (4e-3_f64).sqrt()),
        (
            "1,0,0",
            [0.5, 2.0],
            4.0 / 3.0 * 100e6 * 1.039_804 * (1e-3_f64).sqrt(),
        ),
    ] {
        let report = json(
            &folder,
            &[&["contact", "m.json", "--towards", towards], &load[..]].concat(),
        );
        for (i, radius) in radii.into_iter().enumerate() {
            let curvature = report["first"]["principal_curvatures"][i].as_f64().unwrap();
            assert!(
                (curvature * radius - 1.0).abs() < 0.03,
                "{towards}: {curvature}"
            );
        }
        let found = report["normal_force_n"].as_f64().unwrap();
        let expected = force * 1e-5_f64.powf(1.5);
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        let stiffness = report["normal_stiffness_n_per_m"].as_f64().unwrap();
        assert!((stiffness / (1.5 * found / 1e-5) - 1.0).abs() < 1e-12);
    }
    let text = succeed(
        &folder,
        &[&["contact", "m.json", "m.json"], &load[..]].concat(),
    );
    assert_eq!(text.matches("touched at").count(), 2);
    assert!(text.contains("normal force"));
}

/// A contact that is pressed by a micrometre.
const LIGHT: [&str; 6] = [
    "--unit",
    "mm",
    "--indentation-um",
    "1",
    "--youngs-modulus-mpa",
    "91",
];

#[test]
fn a_direction_may_have_any_length() {
    let folder = ellipsoid();
    let told = |towards: &str| {
        let words = [&["contact", "m.json", "--towards", towards], &LIGHT[..]].concat();
        json(&folder, &words)["normal_force_n"].as_f64().unwrap()
    };
    let one = told("1,0,0");
    for other in ["1e300,0,0", "1e-300,0,0"] {
        assert!((told(other) / one - 1.0).abs() < 1e-9, "{other}");
    }
}

/// A ball of radius 1.
const BALL: &str = r#"{"format": "grainform model", "version": 5, "centre": [0, 0, 0],
    "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "harmonics": [3.544907701811032]}"#;

#[test]
fn bodies_that_lie_deep_in_each_other_have_no_contact_and_deep_ones_a_warning() {
    let folder = folder();
    std::fs::write(folder.path().join("m.json"), BALL).unwrap();
    let load = [
        "--unit",
        "mm",
        "--youngs-modulus-mpa",
        "9",
        "--law",
        "volume",
        "--pose-b",
    ];
    let words =
        |pose: &'static str| [&["contact", "m.json", "m.json"], &load[..], &[pose]].concat();
    let deep = json(&folder, &words("0,0,1.5,1,0,0,0"));
    let warnings = deep["warnings"].to_string();
    assert!(
        warnings.contains("effective radius of the bodies' volumes"),
        "{warnings}"
    );
    let shallow = json(&folder, &words("0,0,1.96,1,0,0,0"));
    assert_eq!(shallow["warnings"], serde_json::json!([]));
    for (pose, sentence) in [
        ("0.05,0,0,1,0,0,0", "so deep in each other"),
        ("0,0,0,1,0,0,0", "lie so near each other"),
    ] {
        let output = grainform(&folder, &words(pose));
        assert_eq!(output.status.code(), Some(2), "{pose}");
        let told = errors(&output);
        assert!(told.contains(sentence), "{told}");
    }
}

#[test]
fn what_cannot_be_pressed_is_refused_in_a_sentence() {
    let folder = ellipsoid();
    let refused = |more: &[&str]| {
        let load = ["--unit", "mm", "--indentation-um"];
        let words = [&["contact", "m.json"], &load[..], more].concat();
        let output = grainform(&folder, &words);
        assert_eq!(output.status.code(), Some(2));
        errors(&output)
    };
    for (more, sentence) in [
        (
            &["-1", "--youngs-modulus-mpa", "9"][..],
            "the indentation must be above zero, not -1 um",
        ),
        (
            &["1", "--youngs-modulus-mpa", "0"],
            "Young's modulus must be above zero, not 0 Pa",
        ),
        (
            &["1", "--youngs-modulus-mpa", "inf"],
            "both bodies are rigid, so that no force presses them together: give one of them a finite Young's modulus\n",
        ),
        (
            &["1", "--youngs-modulus-mpa", "9", "--poissons-ratio", "0.6"],
            "Poisson's ratio must lie between -1 and 0.5, not at 0.6",
        ),
        (
            &["1", "--youngs-modulus-mpa", "9", "--towards", "0,0,0"],
            "the direction of the contact must not be zero",
        ),
        (
            &["1", "--youngs-modulus-mpa", "9", "--towards", "nan,0,1"],
            "expected three finite numbers",
        ),
        (
            &["1", "--youngs-modulus-mpa", "9", "--edge-radius", "-1"],
            "the radius that rounds an edge must be above zero, not -1 mm",
        ),
        (
            &["1e300", "--youngs-modulus-mpa", "9", "--towards", "1,0,0"],
            "the indentation too large",
        ),
        (
            &["1", "--youngs-modulus-mpa", "9", "--other-towards", "0,1,0"],
            "OTHER.json",
        ),
    ] {
        let message = refused(more);
        assert!(message.contains(sentence), "{message}");
    }
}

#[test]
fn an_uncertain_curvature_asks_for_what_was_not_done() {
    let folder = folder();
    let scan = "synth ellipsoid --axes 3,2.5,2 --points 1500 --noise 4% --seed 7 -o s.ply";
    succeed(&folder, &scan.split(' ').collect::<Vec<_>>());
    let told = |segments: &str| {
        let fit = ["fit", "s.ply", "--tolerance", "1%", "--segments", segments];
        succeed(&folder, &[&fit[..], &["-o", "m.json"]].concat());
        let press = "contact m.json --unit mm --indentation-um 10 --youngs-modulus-mpa 100";
        let report = json(&folder, &press.split(' ').collect::<Vec<_>>());
        report["warnings"][0].as_str().unwrap().to_owned()
    };
    let cells = told("6");
    assert!(
        cells.ends_with("% only; fit with --segments 1, or a finer scan."),
        "{cells}"
    );
    let whole = told("1");
    assert!(whole.ends_with("% only; fit a finer scan."), "{whole}");
}

#[test]
fn the_edge_of_a_mirrored_model_is_rounded_when_its_radius_is_given() {
    let folder = folder();
    succeed(&folder, &["synth", "ellipsoid", "-o", "s.ply"]);
    let fit = ["fit", "s.ply", "--symmetry", "z", "--degree", "2"];
    succeed(&folder, &[&fit[..], &["-o", "m.json"]].concat());
    let press = [
        "contact",
        "m.json",
        "--towards",
        "1,0,0",
        "--unit",
        "mm",
        "--indentation-um",
        "10",
        "--youngs-modulus-mpa",
        "91",
    ];
    let output = grainform(&folder, &press);
    assert_eq!(output.status.code(), Some(2));
    let message = errors(&output);
    assert!(
        message.contains("has an edge") && message.contains("--edge-radius"),
        "{message}"
    );
    let report = json(&folder, &[&press[..], &["--edge-radius", "0.1"]].concat());
    let curvatures = &report["first"]["principal_curvatures"];
    assert!((curvatures[0].as_f64().unwrap() - 10.0).abs() < 1e-9);
    assert!((curvatures[1].as_f64().unwrap() - 0.5).abs() < 0.05);
}

/// A body of one superquadric that was fitted, in the file `m.json`.
fn superquadric(axes: &str, exponents: &str) -> tempfile::TempDir {
    let folder = folder();
    let words = [
        "synth",
        "superquadric",
        "--axes",
        axes,
        "--exponents",
        exponents,
        "-o",
        "s.ply",
    ];
    succeed(&folder, &words);
    succeed(
        &folder,
        &["fit", "s.ply", "--surface", "superquadric", "-o", "m.json"],
    );
    folder
}

#[test]
fn a_flat_side_has_no_force_by_hertz() {
    for exponents in ["3,5", "4,2"] {
        let folder = superquadric("3,2,1", exponents);
        let load = ["--unit", "mm", "--youngs-modulus-mpa", "200"];
        let pressed = [&["contact", "m.json", "--indentation-um", "10"], &load[..]].concat();
        let output = grainform(&folder, &pressed);
        assert_eq!(output.status.code(), Some(2), "{exponents}");
        let told = errors(&output);
        assert!(
            told.contains("too flat") || told.contains("do not part"),
            "{told}"
        );
        let pose = [
            "contact",
            "m.json",
            "m.json",
            "--pose-b",
            "0.01,0,1.98,1,0,0,0",
        ];
        let report = json(&folder, &[&pose, &load[..]].concat());
        assert!(report["regions"][0]["normal_force_n"].is_null(), "{report}");
    }
}

/// Across its planes, on the axes and between them, the curvature of a body with exponents below 2 has no bound.
#[test]
fn an_edge_without_an_angle_has_no_force_by_hertz_and_beside_it_a_warning() {
    let folder = folder();
    let edged = r#"{"format": "grainform model", "version": 8, "centre": [0, 0, 0],
        "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "no_standard_errors": "not_estimated",
        "superquadrics": [{"centre": [0, 0, 0], "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "semi_axes": [[3, 3], [2, 2], [1, 1]], "n1": [1.7, 1.7], "n2": [[1.9, 1.9], [1.9, 1.9]]}]}"#;
    std::fs::write(folder.path().join("m.json"), edged).unwrap();
    std::fs::write(folder.path().join("ball.json"), BALL).unwrap();
    let words = |towards| [&["contact", "m.json", "--towards", towards], &LIGHT[..]].concat();
    for edge in ["0,0,1", "1,0,1", "1,1e-9,1"] {
        let output = grainform(&folder, &words(edge));
        assert_eq!(output.status.code(), Some(2), "{edge}");
        let told = errors(&output);
        assert!(told.contains("curvature has no bound"), "{told}");
    }
    let warned = |towards| {
        let report = json(&folder, &words(towards));
        report["warnings"].to_string().contains("as in its middle")
    };
    assert!(warned("1,1e-4,1") && !warned("1,0.1,1"));
    let placed = |pose| {
        let load = ["--unit", "mm", "--youngs-modulus-mpa", "91"];
        let words = ["contact", "m.json", "ball.json", "--pose-b", pose];
        json(&folder, &[&words, &load[..]].concat())
    };
    let edge = placed("0,0,1.999,1,0,0,0");
    assert!(edge["regions"][0]["normal_force_n"].is_null());
    let told = edge["warnings"].to_string();
    assert!(told.contains("as beside an edge"), "{told}");
    let aside = placed("2,1.5,0.9,1,0,0,0");
    assert!(aside["regions"][0]["normal_force_n"].is_number(), "{aside}");
}

/// Of superquadrics as of other models, one wholly in the other has no contact.
#[test]
fn superquadrics_that_lie_in_each_other_are_not_said_to_touch() {
    let folder = superquadric("3,2,1", "2,2");
    let words = |pose| ["contact", "m.json", "m.json", "--pose-b", pose];
    let same = grainform(&folder, &words("0,0,0,1,0,0,0"));
    assert_eq!(same.status.code(), Some(2));
    let deep = succeed(&folder, &words("1.2,0,0,1,0,0,0"));
    assert!(deep.contains("depth"), "{deep}");
    let shallow = succeed(&folder, &words("5.9,0,0,1,0,0,0"));
    assert!(shallow.contains("overlap"), "{shallow}");
}

/// On its axis a fitted ellipsoid, whose exponents are 2 but for rounding, is as curved as beside it.
#[test]
fn ellipsoids_that_were_fitted_are_curved_on_their_axes() {
    let folder = superquadric("3,2,1", "2,2");
    let words = [
        "contact",
        "m.json",
        "m.json",
        "--pose-b",
        "0,0,1.95,1,0,0,0",
        "--unit",
        "mm",
        "--youngs-modulus-mpa",
        "200",
    ];
    let report = json(&folder, &words);
    let force = report["regions"][0]["normal_force_n"].as_f64().unwrap();
    assert!((force / 2.876 - 1.0).abs() < 1e-3, "{force}");
}

#[test]
fn placed_grains_have_errors_that_cover_and_too_little_overlap_has_no_force() {
    let folder = folder();
    for seed in ["1", "2"] {
        let scan = format!("{seed}.ply");
        let model = format!("{seed}.json");
        let body = ["synth", "ellipsoid", "--axes", "1,1,4", "--points", "1538"];
        let noise = ["--noise", "0.5%", "--seed", seed, "-o", &scan];
        succeed(&folder, &[&body[..], &noise].concat());
        succeed(&folder, &["fit", &scan, "-o", &model]);
    }
    let placed = |pose: &str, more: &[&str]| {
        let load = ["--unit", "mm", "--youngs-modulus-mpa", "91", "--pose-b"];
        json(
            &folder,
            &[&["contact", "1.json", "2.json"], more, &load, &[pose]].concat(),
        )
    };
    // Crossed, .05 in each other.
    let report = placed("1.95,0,0,0.70710678,0.70710678,0,0", &[]);
    let region = &report["regions"][0];
    let number = |name: &str| region[name].as_f64().unwrap();
    let (depth, error) = (number("depth"), number("depth_error"));
    assert!((depth - 0.05).abs() < 2.5 * error, "{depth} {error}");
    assert!(number("normal_force_error_n") > 1.5 * error / depth * number("normal_force_n"));
    assert!(report["no_standard_errors"].is_null());

    // By less than is known of their tips.
    for law in ["hertz", "volume"] {
        let report = placed("0,0,7.995,1,0,0,0", &["--law", law]);
        let warnings = report["warnings"].to_string();
        match report["regions"].as_array().unwrap().first() {
            Some(region) => {
                assert!(region["normal_force_n"].is_null(), "{report}");
                assert!(warnings.contains("may as well be apart"), "{warnings}");
            }
            None => {
                let gap = &report["gaps"][0];
                let (gap, error) = (gap["gap"].as_f64(), gap["gap_error"].as_f64());
                assert!(gap < error.map(|error| 2.0 * error), "{report}");
            }
        }
    }
    let far = placed("0,0,25,1,0,0,0", &[]);
    assert_eq!(far["gaps"].as_array().unwrap().len(), 0);
}

#[test]
fn ripples_on_the_side_of_a_cube_are_no_curvature() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "cube", "--points", "1538", "-o", "s.ply"],
    );
    succeed(&folder, &["fit", "s.ply", "-o", "m.json"]);
    for towards in ["0,0,-1", "1,0,0", "0,1,0", "1,1,0.02"] {
        let words = [&["contact", "m.json", "--towards", towards], &LIGHT[..]].concat();
        let output = grainform(&folder, &words);
        assert_eq!(output.status.code(), Some(2), "{towards}");
        let told = errors(&output);
        assert!(
            told.contains("no force is vouched for") || told.contains("do not part"),
            "{told}"
        );
    }
}
