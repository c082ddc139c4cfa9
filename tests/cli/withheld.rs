//! What a model's file says is not to be relied on is not told of it, or told of with what is made of it.

use super::report::record;
use super::{errors, folder, grainform, json, succeed};
use grainform::Mesh;
use grainform::nalgebra::Point3;
use serde_json::{Value, json};
use std::f64::consts::PI;
use tempfile::TempDir;

/// Saves a ball of radius 2 of which something is known.
fn save(folder: &TempDir, key: &str, known: &Value) {
    let mut model = json!({
        "format": "grainform model",
        "version": 5,
        "centre": [0.0, 0.0, 0.0],
        "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "harmonics": [2.0 * (4.0 * PI).sqrt()],
    });
    model[key] = known.clone();
    std::fs::write(folder.path().join("m.json"), model.to_string()).unwrap();
}

#[test]
fn nothing_is_measured_of_a_model_beside_a_hole_unless_as_a_guess() {
    let folder = folder();
    save(&folder, "unseen", &json!({"hole": {"half_angle": 0.7}}));
    let report = json(&folder, &["measure", "m.json", "--only", "volume,form"]);
    assert!(report["volume"].is_null() && report["form"].is_null());
    let reason = report["not_measured"][1]["reason"].as_str().unwrap();
    assert!(reason.contains("40 degrees"), "{reason}");
    let report = json(&folder, &["measure", "m.json", "--extrapolate"]);
    assert!((report["area"].as_f64().unwrap() / (16.0 * PI) - 1.0).abs() < 1e-12);
}

/// A model m.json and a scan s.ply of bodies that were seen but for a large hole.
fn half_seen() -> TempDir {
    let folder = folder();
    save(&folder, "unseen", &json!({"hole": {"half_angle": 0.7}}));
    let synth = "synth ellipsoid --points 800 --missing-cap 50 -o s.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    folder
}

#[test]
fn a_page_tells_guesses_where_they_are_asked_for_and_says_so() {
    let folder = half_seen();
    for (input, doubt) in [
        ("m.json", "no point lies in holes as large as a cap of 40"),
        ("s.ply", "No point lies within 51 degrees"),
    ] {
        for (words, names) in [
            (&[][..], &[][..]),
            (&["--extrapolate"], &["area", "volume"]),
        ] {
            let report = ["report", input, "-o", "page.html"];
            succeed(&folder, &[&report, words].concat());
            let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
            let shown = &record(&page)["page"]["grains"][0];
            let rows = shown["measures"].as_array().unwrap();
            let told = rows.iter().map(|row| row["name"].as_str().unwrap());
            let told: Vec<&str> = told
                .filter(|name| ["area", "volume"].contains(name))
                .collect();
            assert_eq!(told, names, "{input}");
            let warnings = shown["warnings"].to_string();
            assert!(warnings.contains(doubt), "{warnings}");
            assert_eq!(warnings.contains("Not measured: area"), names.is_empty());
        }
    }
}

#[test]
fn what_faces_contradict_is_not_measured_of_a_model() {
    let folder = folder();
    save(&folder, "contradicted", &json!({"area": 0.09382}));
    let words = ["measure", "m.json", "--only", "area,volume,sphericity"];
    let report = json(&folder, &words);
    assert!(report["area"].is_null() && report["sphericity"].is_null());
    assert!(report["volume"].is_number());
    let text = succeed(&folder, &words);
    let told = "area, sphericity not measured: the area is +9.382 % off";
    assert!(text.contains(told), "{text}");
}

#[test]
fn whatever_is_made_of_such_a_model_is_told_so() {
    let folder = folder();
    for (key, known, told) in [
        (
            "unseen",
            json!({"hole": {"half_angle": 0.7}}),
            "a cap of 40 degrees",
        ),
        (
            "contradicted",
            json!({"volume": -0.2}),
            "the volume is -20.000 % off",
        ),
    ] {
        save(&folder, key, &known);
        succeed(&folder, &["report", "m.json", "-o", "m.html"]);
        let page = std::fs::read_to_string(folder.path().join("m.html")).unwrap();
        let missing = page.split("Not measured: ").nth(1).unwrap();
        assert!(
            missing.contains("volume") && missing.contains(told),
            "{missing}"
        );
        for words in [
            "mesh m.json -o m.ply --resolution 4",
            "clump m.json --spheres 2",
            "export-dem m.json --engine lammps --unit mm --spheres 2 -o dem",
            "contact m.json --unit mm --indentation-um 1 --youngs-modulus-mpa 1",
            "contact m.json m.json --pose-b 0,0,3.9,1,0,0,0",
        ] {
            let words: Vec<&str> = words.split(' ').collect();
            let output = grainform(&folder, &words);
            assert!(output.status.success(), "{words:?}: {}", errors(&output));
            let warned = errors(&output);
            assert!(
                warned.contains("warning: Of m.json, ") && warned.contains(told),
                "{warned}"
            );
        }
    }
}

#[test]
fn bodies_that_are_made_of_a_guess_are_told_to_be_guesses() {
    let folder = half_seen();
    for input in ["m.json", "s.ply"] {
        let told = format!("A part of the surface of {input} is a guess, and so are volume, mass");
        let clump = ["clump", input, "--spheres", "2"];
        let warned = errors(&grainform(&folder, &clump));
        assert!(warned.contains(&told), "{warned}");
        let warned = json(&folder, &clump)["warnings"].to_string();
        assert!(warned.contains(&told), "{warned}");
        let dem = format!("export-dem {input} --engine lammps --unit mm --spheres 2 -o dem");
        succeed(&folder, &dem.split(' ').collect::<Vec<_>>());
        let readme = std::fs::read_to_string(folder.path().join("dem/README")).unwrap();
        assert!(readme.contains(&told), "{readme}");
        let bed = format!(
            "bed {input} --spheres 2 --grains 2 --box 20,20 --unit mm --seconds 1e-4 -o {input}.bed"
        );
        let warned = json(&folder, &bed.split(' ').collect::<Vec<_>>())["warnings"].to_string();
        assert!(warned.contains(&told), "{warned}");
    }
    save(&folder, "contradicted", &json!({"volume": -0.2}));
    let warned = errors(&grainform(&folder, &["clump", "m.json", "--spheres", "2"]));
    assert!(!warned.contains("is a guess"), "{warned}");
}

#[test]
fn superquadrics_that_were_half_seen_are_told_as_such() {
    let folder = folder();
    save(&folder, "unseen", &json!({"hole": {"half_angle": 0.7}}));
    let path = folder.path().join("m.json");
    let mut model: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    model.as_object_mut().unwrap().remove("harmonics");
    model["superquadrics"] = json!([{
        "centre": [0, 0, 0],
        "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "n1": [2, 2],
        "n2": [[2, 2], [2, 2]],
        "semi_axes": [[2, 2], [2, 2], [2, 2]],
    }]);
    std::fs::write(path, model.to_string()).unwrap();
    let words = ["contact", "m.json", "m.json", "--pose-b", "0,0,3.9,1,0,0,0"];
    let output = grainform(&folder, &words);
    let warned = errors(&output);
    assert!(output.status.success(), "{warned}");
    assert!(warned.contains("Of m.json, ") && warned.contains("a cap of 40 degrees"));
    let bed = "bed m.json --grains 2 --box 20,20 --unit mm --seconds 1e-4 -o bed";
    let warned = json(&folder, &bed.split(' ').collect::<Vec<_>>())["warnings"].to_string();
    assert!(warned.contains("A part of the surface of m.json is a guess"));
}

#[test]
fn what_is_not_to_be_relied_on_must_be_sound_itself() {
    let folder = folder();
    for (key, known, told) in [
        ("unseen", json!({"hole": {"half_angle": 4.0}}), "half-angle"),
        ("contradicted", json!({"area": -1.5}), "above -1"),
        (
            "no_standard_errors",
            json!({"hole": {"half_angle": -1.0}}),
            "the reason why there are none",
        ),
    ] {
        save(&folder, key, &known);
        let output = grainform(&folder, &["measure", "m.json"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(errors(&output).contains(told), "{}", errors(&output));
    }
}

/// Writes a tube bent round the z axis by an angle, as a mesh: above a whole turn its ends go through one another.
fn save_tube(folder: &TempDir, turn: f64) {
    let mut mesh = Mesh::radial(24, |_| 1.0);
    for vertex in &mut mesh.vertices {
        let (sin, cos) = (0.5 * turn * vertex.x).sin_cos();
        let out = 1.0 - 0.2 * vertex.y;
        *vertex = Point3::new(out * cos, out * sin, 0.2 * vertex.z);
    }
    grainform::export::save_mesh(&folder.path().join("tube.ply"), &mesh).unwrap();
}

#[test]
fn what_a_body_that_goes_through_itself_encloses_is_not_measured() {
    let folder = folder();
    let words = ["measure", "tube.ply", "--only", "area,volume,minimum_box"];
    save_tube(&folder, 6.0);
    assert!(json(&folder, &words)["volume"].is_number());
    save_tube(&folder, 7.5);
    let report = json(&folder, &words);
    assert!(report["volume"].is_null() && report["area"].is_null());
    assert!(report["minimum_box"].is_object());
    let reason = report["not_measured"][0]["reason"].as_str().unwrap();
    let told = "the surface goes through itself near (-0.9";
    assert!(reason.contains(told), "{reason}");
    for words in [
        vec!["fit", "tube.ply"],
        vec!["clump", "tube.ply", "--spheres", "5", "-o", "c.json"],
    ] {
        let told = errors(&grainform(&folder, &words));
        assert!(
            told.contains("the surface goes through itself near"),
            "{told}"
        );
    }
}

#[test]
fn a_band_without_points_is_as_large_a_hole_as_a_cap() {
    let folder = folder();
    let synth = ["synth", "ellipsoid", "--axes", "6,4,3", "--points", "2000"];
    succeed(&folder, &[&synth[..], &["-o", "s.xyz"]].concat());
    let path = folder.path().join("s.xyz");
    let text = std::fs::read_to_string(&path).unwrap();
    let is_seen = |line: &&str| {
        let numbers: Vec<f64> = line.split(' ').map(|x| x.parse().unwrap()).collect();
        (numbers[0] / 6.0).abs() > 0.35
    };
    let rest: Vec<&str> = text.lines().filter(is_seen).collect();
    std::fs::write(&path, rest.join("\n")).unwrap();
    for command in ["fit", "measure"] {
        let report = json(&folder, &[command, "s.xyz"]);
        assert!(report["volume"].is_null(), "{command}");
        let reason = report["not_measured"][0]["reason"].as_str().unwrap();
        assert!(reason.contains("holes as large as a cap"), "{reason}");
    }
}

#[test]
fn steps_of_voxels_have_no_area_and_spikes_are_told() {
    let folder = folder();
    let path = |name| folder.path().join(name);
    let mut mesh = Mesh::radial(16, |n| 2.0 + 0.5 * n.z);
    mesh.vertices[700] = Point3::from(mesh.vertices[700].coords * 1.8);
    grainform::export::save_mesh(&path("spiky.ply"), &mesh).unwrap();
    let report = json(&folder, &["measure", "spiky.ply"]);
    assert_eq!(report["faces"]["spikes"], 1);
    let warning = report["warnings"][0].as_str().unwrap();
    assert!(warning.starts_with("1 point stands far out"), "{warning}");
    grainform::export::save_mesh(&path("steps.stl"), &voxels(7)).unwrap();
    let report = json(
        &folder,
        &["measure", "steps.stl", "--only", "area,volume,sphericity"],
    );
    assert!(report["area"].is_null() && report["sphericity"].is_null());
    assert!(report["volume"].is_number());
}

/// The sides of the voxels of a ball, each with corners of its own.
fn voxels(radius: i32) -> Mesh {
    let is_inside = |p: [i32; 3]| p.iter().map(|x| x * x).sum::<i32>() <= radius * radius;
    let line = || -radius..=radius;
    let places = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
    let mut mesh = Mesh::default();
    for place in places.filter(|place| is_inside(*place)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let mut beside = place;
            beside[axis] += side;
            if is_inside(beside) {
                continue;
            }
            let first = mesh.vertices.len() as u32;
            mesh.vertices
                .extend([(-1, -1), (1, -1), (1, 1), (-1, 1)].map(|(u, v)| {
                    let mut corner = place.map(|x| f64::from(2 * x));
                    corner[axis] += f64::from(side);
                    corner[(axis + 1) % 3] += f64::from(u * side);
                    corner[(axis + 2) % 3] += f64::from(v);
                    Point3::from(corner)
                }));
            mesh.triangles
                .extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| i + first)));
        }
    }
    mesh
}
