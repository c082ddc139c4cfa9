//! Options that would change nothing are refused.

use super::errors::refuse;
use super::{errors, folder, grainform, succeed};

/// Runs these words, which must be refused for what they ask.
fn idle(words: &str, expected: &str) {
    let words: Vec<&str> = words.split(' ').collect();
    refuse(&words, &[expected, "leave it out"]);
}

#[test]
fn models_have_no_labels() {
    for words in [
        "measure other.json",
        "clump other.json",
        "export-dem other.json --engine yade --unit mm -o dem",
        "report other.json -o a.html",
        "bed other.json --grains 3 --box 9,9 --unit mm -o bed",
        "bed other.json --spheres 3 --grains 3 --box 9,9 --unit mm -o bed",
    ] {
        let words: Vec<&str> = words.split(' ').chain(["--label", "1"]).collect();
        let expected = "other.json is a model, and has no labels: leave --label out";
        refuse(&words, &[expected]);
        let format = [&words[..words.len() - 2], &["--format", "ply"]].concat();
        refuse(
            &format,
            &["other.json is a model, and --format is of scans: leave it out"],
        );
    }
}

#[test]
fn what_is_of_scans_alone_is_refused_of_models() {
    for option in ["--search", "--bench", "--largest"] {
        let words = format!("report other.json -o a.html {option}");
        idle(
            &words,
            &format!("{option} is for scans, and no scan is named"),
        );
    }
}

#[test]
fn what_an_engine_has_no_use_for_is_refused() {
    for (engine, options) in [
        ("liggghts", &["--seed"][..]),
        (
            "mercurydpm",
            &["--seed", "--grains", "--youngs-modulus-mpa", "--friction"],
        ),
    ] {
        for option in options {
            let words =
                format!("export-dem torus.obj --engine {engine} --unit mm -o dem {option} 1");
            idle(
                &words,
                &format!("{option} is for engines in which the folder "),
            );
        }
    }
}

#[test]
fn a_search_has_no_options_for_what_it_does_not_do() {
    idle(
        "fit torus.obj --exhaustive",
        "--exhaustive is for independent segments",
    );
    idle(
        "fit torus.obj --surface poly --stats",
        "--stats counts the candidates",
    );
    refuse(
        &["fit", "torus.obj", "--degree", "3", "--max-degree", "2"],
        &["--max-degree bounds a search, and --degree leaves none"],
    );
    for option in ["--exhaustive", "--extrapolate"] {
        refuse(
            &["search", "torus.obj", option],
            &["unexpected argument", option],
        );
    }
}

#[test]
fn options_of_what_is_not_written_are_refused() {
    refuse(
        &["fit", "torus.obj", "--resolution", "8"],
        &["not provided: --mesh"],
    );
    for words in [
        "mesh other.json -o a.stl --format ply",
        "synth bean --format xyz",
        "synth bean -o a.ply --format xyz",
        "synth hook -o - --format xyz",
    ] {
        idle(words, "--format is that of");
    }
}

#[test]
fn options_of_scans_and_of_forces_ask_for_these() {
    for (words, expected) in [
        ("bench --max-bytes 9", "<SCAN>"),
        ("bench --format ply", "<SCAN>"),
        ("bench --label 3", "<SCAN>"),
        ("bench torus.obj --unit mm", "not provided: --json"),
        (
            "contact a.json b.json --pose-b 0,0,0,1,0,0,0 --poissons-ratio .2",
            "not provided: --youngs-modulus-mpa",
        ),
        (
            "contact a.json b.json --pose-b 0,0,0,1,0,0,0 --other-poissons-ratio .2",
            "not provided: --youngs-modulus-mpa",
        ),
        (
            "contact a.json b.json --pose-b 0,0,0,1,0,0,0 --other-youngs-modulus-mpa 2",
            "not provided: --youngs-modulus-mpa",
        ),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        refuse(&words, &[expected]);
    }
}

#[test]
fn an_edge_is_rounded_only_where_there_is_one() {
    let folder = folder();
    succeed(&folder, &["synth", "sphere", "-o", "s.ply"]);
    succeed(&folder, &["fit", "s.ply", "-o", "m.json"]);
    let words =
        "contact m.json --unit mm --indentation-um 1 --youngs-modulus-mpa 9 --edge-radius 1";
    let words: Vec<&str> = words.split(' ').collect();
    let refused = grainform(&folder, &words);
    let told = errors(&refused);
    assert!(
        told.starts_with("error: --edge-radius rounds an edge, and there is none"),
        "{told}"
    );
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn shapes_for_nist_have_neither_spheres_nor_material() {
    for option in [
        "--spheres",
        "--grains",
        "--seed",
        "--density",
        "--youngs-modulus-mpa",
        "--poissons-ratio",
        "--friction",
        "--restitution",
    ] {
        let words = format!("export-dem torus.obj --engine anm --unit mm -o dem {option} 1");
        idle(&words, &format!("{option} is for engines in which"));
    }
    let words = "export-dem torus.obj --engine anm --unit mm -o dem --error 2%";
    idle(words, "--error is for engines in which");
}

#[test]
fn what_a_synthetic_body_has_not_is_refused() {
    idle(
        "synth bean --grains 3",
        "--grains counts the grains on a tray",
    );
    for body in ["hook", "tray"] {
        idle(
            &format!("synth {body} --sampling random"),
            "--sampling lays out the directions",
        );
    }
}

#[test]
fn results_are_reported_as_they_are() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("lot")).unwrap();
    for option in [
        "--search",
        "--bench",
        "--largest",
        "--extrapolate",
        "--unit mm",
        "--label 1",
        "--format ply",
    ] {
        let words = format!("report lot -o a.html {option}");
        let words: Vec<&str> = words.split(' ').collect();
        let refused = grainform(&folder, &words);
        let told = errors(&refused);
        let name = option.split(' ').next().unwrap();
        assert!(
            told.starts_with(&format!("error: {name} is for scans and models")),
            "{told}"
        );
        assert_eq!(refused.status.code(), Some(2));
    }
}

#[test]
fn a_plane_has_no_direction_of_largest_curvature() {
    let words =
        "contact other.json --unit mm --indentation-um 1 --youngs-modulus-mpa 9 --angle-deg 5";
    let words: Vec<&str> = words.split(' ').collect();
    refuse(&words, &["<OTHER.json>"]);
}
