use super::{errors, folder, grain, grainform, names, succeed};
use grainform::Mesh;
use nalgebra::point;
use std::f64::consts::TAU;

/// Runs `grainform`, which must refuse with exit code 2 and say these words, on one line.
pub(super) fn refuse(words: &[&str], expected: &[&str]) {
    let folder = folder();
    std::fs::write(folder.path().join("garbage.ply"), [0, 159, 3, 255, 7]).unwrap();
    std::fs::write(folder.path().join("other.json"), "{\"a\": 1}").unwrap();
    grainform::export::save_mesh(&folder.path().join("torus.obj"), &torus()).unwrap();
    let before = names(folder.path());
    let output = grainform(&folder, words);
    let text = errors(&output);
    assert_eq!(output.status.code(), Some(2), "{words:?}: {text}");
    for part in expected {
        assert!(text.contains(part), "{part:?} in {text}");
    }
    assert!(text.starts_with("error: ") && output.stdout.is_empty());
    assert_eq!(text.lines().count(), 1, "{text}");
    assert_eq!(names(folder.path()), before, "{words:?}");
}

fn torus() -> Mesh {
    let n = 24_u32;
    let corner = |i: u32, j: u32| (i % n) * n + j % n;
    let angle = |i: u32| TAU * f64::from(i) / f64::from(n);
    let cells = || (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
    let vertex = |(i, j)| {
        let r = 3.0 + angle(j).cos();
        point![r * angle(i).cos(), r * angle(i).sin(), angle(j).sin()]
    };
    let triangles = cells().flat_map(|(i, j)| {
        let (a, b) = (corner(i, j), corner(i + 1, j));
        let (c, d) = (corner(i + 1, j + 1), corner(i, j + 1));
        [[a, b, c], [a, c, d]]
    });
    Mesh {
        vertices: cells().map(vertex).collect(),
        triangles: triangles.collect(),
    }
}

#[test]
fn unusable_inputs_are_named() {
    for command in ["fit", "search", "measure", "bench"] {
        refuse(&[command, "no.ply"], &["cannot read the file no.ply"]);
        refuse(&[command, "garbage.ply"], &["garbage.ply", "byte"]);
    }
    refuse(
        &["measure", "other.json"],
        &["cannot read a model from other.json"],
    );
    refuse(
        &["mesh", "other.json", "-o", "a.stl"],
        &["other.json", "grainform fit"],
    );
    refuse(
        &["mesh", "garbage.ply", "-o", "a.stl"],
        &["garbage.ply", "model"],
    );
}

#[test]
fn a_torus_is_refused_with_its_genus_or_the_share_that_faces_away() {
    let outputs = ["-o", "m.json", "--mesh", "m.stl", "--harmonics", "m.csv"];
    let words = [&["fit", "torus.obj"], &outputs[..]].concat();
    refuse(&words, &["torus.obj", "1 handle (its genus)"]);
    refuse(
        &[&words[..], &["--surface", "star"]].concat(),
        &["torus.obj", "not star-shaped", "% of its area faces away"],
    );
}

#[test]
fn outputs_are_checked_before_work() {
    let maize = &grain("maize.ply");
    let must = "its extension must be";
    refuse(
        &["fit", maize, "--mesh", "a.vtk"],
        &["a.vtk", must, "stl, ply, obj, vtp or glb"],
    );
    refuse(&["fit", maize, "-o", "a.stl"], &["a.stl", must, "json"]);
    refuse(&["fit", maize, "--harmonics", "a"], &[must, "csv"]);
    refuse(&["search", maize, "--csv", "a.txt"], &[must, "csv"]);
    refuse(&["synth", "bean", "-o", "a.stl"], &[must, "ply or xyz"]);
    refuse(&["mesh", "no.json", "-o", "a.txt"], &["a.txt", must]);
    refuse(
        &["fit", "no.ply", "-o", "none/a.json"],
        &["the folder none does not exist"],
    );
    refuse(
        &["fit", maize, "--mesh", maize],
        &["it is the input or another output"],
    );
    refuse(
        &[
            "mesh",
            "other.json",
            "--scan",
            "garbage.ply",
            "-o",
            "garbage.ply",
        ],
        &["it is the input or another output"],
    );
    refuse(
        &["synth", "bean", "--noise", "0.5", "-o", "a.ply"],
        &["the noise must lie"],
    );
}

#[test]
fn a_bench_is_refused_before_it_begins() {
    let maize = &grain("maize.ply");
    refuse(
        &["bench", maize, "torus.obj"],
        &["cannot fit torus.obj", "not star-shaped"],
    );
    refuse(&["bench", maize, maize], &["two scans are named maize"]);
    refuse(
        &["bench", maize, "-o", "torus.obj"],
        &["cannot make the folder torus.obj"],
    );
}

#[test]
fn settings_out_of_range_are_refused_before_work() {
    let fit = |setting: &str, value: &str, expected: &str| {
        refuse(&["fit", "no.ply", setting, value], &[expected]);
    };
    fit("--segments", "7", "7 segments cannot be blended");
    fit("--segments", "7", "6 n^2 cells on the faces of a cube");
    fit("--segments", "7", "such as 6 or 24");
    fit("--segments", "5", "such as 6 or 24");
    for expected in [
        "7 segments cannot be made: both angles are cut in k equal parts",
        "4 or 9",
    ] {
        refuse(
            &["fit", "no.ply", "--seams", "none", "--segments", "7"],
            &[expected],
        );
    }
    fit("--seams", "some", "blended");
    fit("--segments", "0", "from 1 to");
    fit(
        "--segments",
        "many",
        "a whole number of zero or more, or auto",
    );
    fit("--degree", "99", "the degree is 99");
    fit(
        "--tolerance",
        "0",
        "a positive length such as 0.02, a share such as 0.3%, or auto",
    );
    fit("--tolerance", "nan%", "a positive length");
    fit("--tolerance", "1e308", "expected at most 1e100");
    let contradiction = "beside a largest one (--max-segments) is 24; it must be from 1 to 6";
    for seams in ["blended", "none"] {
        let words = "fit no.ply --segments 24 --max-segments 6 --seams";
        let words: Vec<&str> = words.split(' ').chain([seams]).collect();
        refuse(&words, &[contradiction]);
    }
    fit(
        "--resolution",
        "0",
        "expected a whole number from 1 to 2886",
    );
    fit("--threads", "x", "see grainform fit --help");
    refuse(
        &["synth", "pea"],
        &["bean, chickpea, maize, sphere, ellipsoid"],
    );
    refuse(
        &["synth", "bean", "--offset", "1,2"],
        &["three finite numbers"],
    );
    let axes = |body: &str, axes: &str, expected: &str| {
        refuse(&["synth", body, "--axes", axes], &[expected]);
    };
    axes("maize", "2,2,1", "the maize has one size");
    axes("ellipsoid", "2,2", "three numbers");
    axes("ellipsoid", "-2,2,1", "a semi-axis must be 0.000001 to");
    axes("octahedron", "2,nan,1", "not NaN");
    axes("cylinder", "2,1,1", "a cylinder is round");
    axes("sphere", "2,2,1", "must all be equal, not 2, 2 and 1");
    refuse(
        &["synth", "bean", "--points", "3"],
        &["cannot sample 3 directions"],
    );
}

#[test]
fn negative_values_are_refused_as_what_they_are() {
    for (command, name, value, expected) in [
        ("fit no.ply", "--tolerance", "-1", "a positive length"),
        ("fit no.ply", "--tolerance", "-0.3%", "a positive length"),
        ("fit no.ply", "--degree", "-1", "of zero or more, or auto"),
        ("fit no.ply", "--max-degree", "-1", "of zero or more"),
        ("fit no.ply", "--threads", "-1", "of zero or more"),
        (
            "fit no.ply",
            "--resolution",
            "-1",
            "expected a whole number from 1 to 2886",
        ),
        ("fit no.ply", "--max-bytes", "-1G", "of bytes above zero"),
        ("batch no.ply -o out", "--jobs", "-2", "of zero or more"),
        ("synth bean", "--points", "-5", "of zero or more"),
        ("synth bean", "--seed", "-5", "of zero or more"),
        ("synth bean", "--noise", "-0.5%", "the noise must lie"),
        ("synth bean", "--missing-cap", "-5", "by 0 to 180 degrees"),
        ("synth superquadric", "--exponents", "-4,2", "exponent"),
        ("clump no.ply", "--spheres", "-1", "of zero or more"),
    ] {
        let words: Vec<&str> = command.split(' ').chain([name, value]).collect();
        refuse(&words, &[expected]);
    }
}

#[test]
fn an_option_is_not_the_value_of_the_one_before() {
    for name in ["--noise", "--offset", "--axes", "--points"] {
        refuse(
            &["synth", "bean", name, "--json"],
            &["a value is required for", name],
        );
    }
    refuse(
        &["fit", "no.ply", "--tolerance", "--json"],
        &["a value is required for '--tolerance"],
    );
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_error() {
    use std::process::{Command, Stdio};
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(["search", &grain("maize.ply"), "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        (output.status.code(), errors(&output)),
        (Some(0), String::new())
    );
}

#[test]
fn standard_output_is_no_folder() {
    let folder = ["-o", "-"];
    for words in [
        &["split", "torus.obj"][..],
        &["batch", "torus.obj"],
        &["bench", "torus.obj"],
        &[
            "export-dem",
            "torus.obj",
            "--engine",
            "yade",
            "--unit",
            "mm",
        ],
        &["bed", "torus.obj", "--box", "9,9", "--unit", "mm"],
    ] {
        let told = ["- is standard output", "the name of a folder"];
        refuse(&[words, &folder].concat(), &told);
    }
}

#[test]
fn a_file_is_no_folder_to_save_in() {
    for mesh in ["torus.obj/x.stl", "torus.obj/in/x.stl"] {
        let words = ["fit", "torus.obj", "--mesh", mesh];
        refuse(&words, &["torus.obj is a file, and no folder"]);
    }
}

#[test]
fn folders_and_files_that_look_like_options_are_told_from_scans() {
    for command in ["fit", "measure", "clump"] {
        refuse(
            &[command, "."],
            &["cannot read .: it is a folder", "grainform batch"],
        );
    }
    let folder = folder();
    succeed(&folder, &["synth", "bean", "-o", "./-dash.ply"]);
    let told = errors(&grainform(&folder, &["measure", "-dash.ply"]));
    let expected = "error: -dash.ply is taken for options: name the file ./-dash.ply\n";
    assert_eq!(told, expected);
    succeed(&folder, &["measure", "./-dash.ply", "--only", "area"]);
}
