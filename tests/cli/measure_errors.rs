use super::{folder, json, succeed};

/// A ratio is as uncertain as both of its lengths, at most; a record, a text and a table tell all errors alike.
#[test]
fn sizes_and_ratios_have_standard_errors() {
    let folder = folder();
    let synth = "synth bean --points 1538 --noise 0.02 -o s.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    succeed(&folder, &["fit", "s.ply", "-o", "m.json"]);
    let only = "dimensions,minimum_box,ratios,form,sphericity,convexity,ellipsoid,projections";
    let words = ["measure", "m.json", "--only", only];
    let found = json(&folder, &words);
    let at = |path: &str| {
        found
            .pointer(path)
            .and_then(serde_json::Value::as_f64)
            .unwrap()
    };
    let off = |side: &str| {
        at(&format!("/standard_errors/dimensions/{side}")) / at(&format!("/dimensions/{side}"))
    };
    let told = at("/form/standard_errors/elongation") / at("/form/elongation");
    assert!(
        (told / (off("length") + off("width")) - 1.0).abs() < 1e-9,
        "{told}"
    );
    let wadell = at("/sphericity/standard_errors/wadell");
    assert!((1e-5..1e-2).contains(&wadell), "{wadell}");
    let text = succeed(&folder, &words);
    let told = text.lines().filter(|line| line.contains(" ± "));
    let counts: Vec<_> = told.map(|line| line.matches(" ± ").count()).collect();
    // Dimensions, box, ellipsoid, ratios, form, sphericity, convexity, two lines of each outline, and what ± is.
    assert_eq!(counts, [3, 4, 3, 3, 3, 6, 2, 4, 4, 4, 4, 4, 4, 1], "{text}");

    succeed(&folder, &["batch", "s.ply", "-o", "lot", "--only", only]);
    let row = &super::batch::rows(&folder.path().join("lot/results.csv"))[0];
    for (name, path) in [
        ("minimum_box.volume", "/minimum_box/standard_errors/volume"),
        (
            "ratios.short_to_long",
            "/ratios/standard_errors/short_to_long",
        ),
        ("form.flatness", "/form/standard_errors/flatness"),
        (
            "sphericity.krumbein",
            "/sphericity/standard_errors/krumbein",
        ),
        ("convexity.volume", "/convexity/standard_errors/volume"),
        ("ellipsoid.b", "/ellipsoid/semi_axes_standard_errors/1"),
        (
            "projections.width.solidity",
            "/projections/1/standard_errors/solidity",
        ),
    ] {
        let told = row[&format!("{name}_se")].parse::<f64>().unwrap();
        assert!((told / at(path) - 1.0).abs() < 1e-9, "{name}: {told}");
    }
}
