//! Options that would change nothing are refused.

use super::errors::refuse;
use super::{errors, folder, grainform};

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
    }
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
