use super::{deviation, folder, json, succeed};

#[test]
fn scan_mesh_and_model_agree_with_the_closed_form() {
    let folder = folder();
    for body in ["bean", "chickpea", "maize"] {
        let truth = json(
            &folder,
            &["synth", body, "--offset", "100,-20,3", "-o", "s.ply"],
        );
        succeed(
            &folder,
            &["fit", "s.ply", "-o", "m.json", "--mesh", "m.stl"],
        );
        for (input, of, bound) in [
            // A polyhedron inscribed in 1538 points of the bean has 0.66 % too little volume.
            ("s.ply", "directions", 0.008),
            ("m.stl", "faces", 0.002),
            ("m.json", "model", 0.001),
        ] {
            let report = json(&folder, &["measure", input]);
            assert_eq!(report["of"], of);
            for what in ["area", "volume"] {
                let error = deviation(&report, &truth, what);
                assert!(error < bound, "{what} of {body}, {input}: {error}");
            }
            for axis in 0..3 {
                let error = report["centroid"][axis].as_f64().unwrap()
                    - truth["centroid"][axis].as_f64().unwrap();
                assert!(error.abs() < 0.005, "centroid of {body}, {input}: {error}");
                let inertia =
                    |record: &serde_json::Value| record["inertia"][axis][axis].as_f64().unwrap();
                let error = inertia(&report) / inertia(&truth) - 1.0;
                assert!(
                    error.abs() < 2.0 * bound,
                    "inertia of {body}, {input}: {error}"
                );
            }
        }
    }
}

#[test]
fn dimensions_are_extents_along_the_principal_axes() {
    let folder = folder();
    succeed(&folder, &["synth", "maize", "-o", "s.ply"]);
    let report = json(&folder, &["measure", "s.ply"]);
    assert_eq!(report["warnings"], serde_json::json!([]));
    for (name, size) in [("length", 11.5), ("width", 8.5), ("thickness", 5.0)] {
        let found = report["dimensions"][name].as_f64().unwrap();
        assert!((found - size).abs() < 0.25, "{name}: {found}");
    }
    let moments = report["principal"]["moments"].as_array().unwrap();
    assert!(moments.is_sorted_by(|a, b| a.as_f64() <= b.as_f64()));
    let text = succeed(&folder, &["measure", "s.ply"]);
    assert!(text.contains("triangulated by direction") && text.contains("length 11."));
}
