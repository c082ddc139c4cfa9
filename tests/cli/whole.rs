//! `--segments 1`: the estimate itself, from the scan to its measures.

use super::{deviation, folder, grain, json, number, succeed};
use grainform::shapes::Body;
use grainform::{StarSurface, Surface, model};
use nalgebra::Vector3;

#[test]
fn the_estimate_is_fitted_saved_meshed_and_measured() {
    let folder = folder();
    let offset = Vector3::new(100.0, -20.0, 3.0);
    for body in [Body::Chickpea, Body::Maize] {
        let words = ["synth", body.name(), "--offset", "100,-20,3", "-o", "s.ply"];
        let truth = json(&folder, &words);
        let words = [
            "fit",
            "s.ply",
            "--segments",
            "1",
            "-o",
            "m.json",
            "--mesh",
            "m.stl",
        ];
        let report = json(&folder, &words);
        assert_eq!(report["segments"], 1);
        assert_eq!(report["evaluation"]["coefficients"], report["coefficients"]);
        assert!(report["whole"].is_null());
        assert_eq!(report["warnings"], serde_json::json!([]));
        let degree = report["degree"].as_u64().unwrap();
        assert_eq!(report["coefficients"], (degree + 1).pow(2));
        assert!(report["degree"].as_u64() <= report["estimate"]["degree"].as_u64());

        // The radius, everywhere: measured 3e-6 to 7e-6 of the mean radius.
        let text = std::fs::read_to_string(folder.path().join("m.json")).unwrap();
        let model = model::grain_from_json(&text).unwrap();
        let model = model.star().unwrap();
        let centre = model.frame().centre.coords - offset;
        let surface = body.surface();
        let (directions, _) = grainform::sphere::cube_grid(20);
        let squares = directions.iter().map(|n| {
            let point = n * surface.radius(n) - centre;
            (point.norm() - model.radius(&point.normalize())).powi(2)
        });
        let rms = (squares.sum::<f64>() / directions.len() as f64).sqrt();
        let share = rms / number(&truth, "mean_radius");
        println!("{body}: {share:e}");
        assert!(share < 2e-5, "{body}: {share}");
        // The cells keep to .03 %.
        let cells = json(&folder, &["fit", "s.ply"]);
        assert!(number(&report, "heldout_rms") < 0.05 * number(&cells, "heldout_rms"));

        let measured = json(&folder, &["measure", "m.json"]);
        assert_eq!(measured["not_measured"], serde_json::json!([]));
        let meshed = json(&folder, &["measure", "m.stl", "--only", "area,volume"]);
        for what in ["area", "volume"] {
            assert_eq!(number(&measured, what), number(&report, what));
            assert!(
                deviation(&measured, &truth, what) < 2e-5,
                "{what} of {body}"
            );
            assert!(deviation(&meshed, &truth, what) < 1e-3, "{what} of {body}");
        }
        succeed(&folder, &["mesh", "m.json", "-o", "again.stl"]);
        let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
        assert!(bytes("m.stl") == bytes("again.stl"));
    }
}

#[test]
fn a_degree_or_a_tolerance_cuts_the_estimate() {
    let folder = folder();
    let maize = grain("maize.ply");
    let fit = |more: &[&str]| {
        let words = ["fit", &maize, "--segments", "1"];
        json(&folder, &[&words[..], more].concat())
    };
    let cut = fit(&["--degree", "7"]);
    assert_eq!(
        (&cut["degree"], &cut["coefficients"]),
        (&7.into(), &64.into())
    );
    assert_eq!(cut["rule"], "the only candidate asked for");
    let (coarse, fine) = (fit(&["--tolerance", "1%"]), fit(&["--tolerance", "0.01%"]));
    for report in [&coarse, &fine] {
        assert!(number(report, "estimate_rms") <= number(report, "limit"));
        assert!(
            report["rule"]
                .as_str()
                .unwrap()
                .starts_with("the lowest degree within ")
        );
    }
    assert!(coarse["degree"].as_u64() < fine["degree"].as_u64());
    assert_eq!(fit(&["--max-degree", "5"])["degree"], 5);
    let text = succeed(&folder, &["search", &maize, "--segments", "1"]);
    let row: Vec<&str> = text.lines().nth(2).unwrap().split_whitespace().collect();
    assert_eq!(row[..2], ["*", "1"]);
    assert_eq!(text.lines().count(), 4);
}
