use super::{deviation, errors, folder, grain, grainform, json, succeed};
use grainform::scan::read_scan;
use grainform::{Mesh, model};

#[test]
fn meshes_of_all_formats_are_closed_and_of_the_size_asked_for() {
    let folder = folder();
    for name in ["m.stl", "m.ply", "m.obj"] {
        let words = [
            "fit",
            &grain("bean.ply"),
            "--mesh",
            name,
            "--resolution",
            "12",
        ];
        let report = json(&folder, &words);
        let scan = read_scan(&folder.path().join(name)).unwrap();
        assert_eq!(scan.warnings(), [""; 0], "{name}");
        assert_eq!(scan.points().len(), 6 * 12 * 12 + 2, "{name}");
        let mesh = Mesh {
            vertices: scan.points().to_vec(),
            triangles: scan.triangles().to_vec(),
        };
        mesh.check_closed().unwrap();
        let measured = json(&folder, &["measure", name]);
        assert_eq!(measured["of"], "faces");
        assert!(deviation(&measured, &report, "volume") < 0.02, "{name}");
    }
}

#[test]
fn the_mesh_of_a_model_is_that_of_its_fit() {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(
        &folder,
        &["fit", &bean, "-o", "m.json", "--mesh", "fit.ply"],
    );
    let text = succeed(&folder, &["mesh", "m.json", "-o", "model.ply"]);
    assert_eq!(text, "wrote model.ply: 24578 vertices, 49152 triangles\n");
    let scan = |name: &str| read_scan(&folder.path().join(name)).unwrap();
    assert!(scan("fit.ply") == scan("model.ply"));
}

#[test]
fn a_model_file_holds_what_was_fitted() {
    let folder = folder();
    let report = json(&folder, &["fit", &grain("bean.ply"), "-o", "m.json"]);
    let text = std::fs::read_to_string(folder.path().join("m.json")).unwrap();
    let grain = model::grain_from_json(&text).unwrap();
    assert_eq!(report["coefficients"], grain.coefficient_count());
    assert_eq!(report["segments"], grain.star().unwrap().segments());
    assert_eq!(report["degree"], grain.degree());
    assert_eq!(model::grain_to_json(&grain) + "\n", text);
}

#[test]
fn a_mesh_holds_what_is_known_at_its_vertices() {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(&folder, &["fit", &bean, "-o", "m.json"]);
    let text = |name: &str, words: &[&str]| {
        let words = [&["mesh", "m.json", "--resolution", "8", "-o", name], words].concat();
        succeed(&folder, &words);
        let bytes = std::fs::read(folder.path().join(name)).unwrap();
        String::from_utf8_lossy(&bytes).into_owned()
    };
    for (name, known, asked) in [
        (
            "m.ply",
            "property double mean_curvature\n",
            "property double deviation\n",
        ),
        ("m.vtp", "Name=\"gaussian_curvature\"", "Name=\"deviation\""),
        ("m.glb", "\"_SEGMENT\"", "\"_DEVIATION\""),
    ] {
        let without = text(name, &[]);
        assert!(
            without.contains(known) && !without.contains(asked),
            "{name}"
        );
        let with = text(name, &["--scan", &bean]);
        assert!(with.contains(known) && with.contains(asked), "{name}");
    }
    let scan = read_scan(&folder.path().join("m.ply")).unwrap();
    assert_eq!(scan.points().len(), 6 * 8 * 8 + 2);
}

#[test]
fn a_scan_that_lies_elsewhere_is_told() {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(&folder, &["fit", &bean, "-o", "m.json"]);
    let other = ["synth", "bean", "--offset", "100,0,0", "-o", "other.ply"];
    succeed(&folder, &other);
    let words = ["mesh", "m.json", "-o", "m.ply", "--scan"];
    let refused = errors(&grainform(&folder, &[&words[..], &["other.ply"]].concat()));
    assert!(
        refused.contains("no point of other.ply is near the surface of m.json"),
        "{refused}"
    );
    assert!(!folder.path().join("m.ply").exists());
    let half = ["synth", "bean", "--missing-cap", "85", "-o", "half.ply"];
    succeed(&folder, &half);
    let told = errors(&grainform(&folder, &[&words[..], &["half.ply"]].concat()));
    assert!(
        told.contains("no points near") && told.contains("% of the surface"),
        "{told}"
    );
}

#[test]
fn a_file_that_rounds_a_mesh_far_from_its_origin_is_told() {
    let folder = folder();
    let far = ["synth", "bean", "--offset", "1e6,0,0", "-o", "far.ply"];
    succeed(&folder, &far);
    let fit = |scan: &str| {
        let words = ["fit", scan, "-o", "m.json", "--mesh", "m.stl"];
        errors(&grainform(&folder, &words))
    };
    assert!(fit("far.ply").contains("STL holds seven digits"));
    let mesh = |name: &str| errors(&grainform(&folder, &["mesh", "m.json", "-o", name]));
    assert!(mesh("m.stl").contains("STL holds seven digits"));
    assert_eq!(mesh("m.ply"), "");
    assert_eq!(fit(&grain("bean.ply")), "");
}

#[test]
fn the_scan_of_another_grain_is_told() {
    let folder = folder();
    succeed(&folder, &["fit", &grain("maize.ply"), "-o", "m.json"]);
    let told = |scan: &str| {
        let words = [
            "mesh",
            "m.json",
            "--scan",
            scan,
            "-o",
            "m.ply",
            "--resolution",
            "12",
        ];
        errors(&grainform(&folder, &words))
    };
    assert_eq!(told(&grain("maize.ply")), "");
    let other = told(&grain("bean.ply"));
    assert!(
        other.contains("look whether it is that of this grain"),
        "{other}"
    );
}
