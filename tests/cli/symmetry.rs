//! Fits with mirror planes.

use super::{deviation, errors, folder, grain, grainform, json, names, number, succeed};
use grainform::sphere::{Symmetry, harmonics};
use grainform::{StarSurface, model, scan};
use nalgebra::Vector3;

#[test]
fn sixteen_coefficients_of_an_octant_follow_simple_shapes() {
    let folder = folder();
    // The largest errors of area and volume: the edges of the last two are rounded off.
    for (shape, area, volume) in [
        ("ellipsoid --axes 2,2,1", 5e-4, 6e-4),
        ("cylinder --axes 2,2,1", 0.06, 0.005),
        ("cube", 0.06, 0.006),
    ] {
        let words: Vec<&str> = shape.split(' ').collect();
        let truth = json(
            &folder,
            &[&["synth"], &words[..], &["-o", "body.ply"]].concat(),
        );
        let words = ["fit", "body.ply", "--symmetry", "xyz", "--degree", "3"];
        let report = json(&folder, &words);
        assert_eq!(report["symmetry"], "xyz");
        assert_eq!(report["degree"], 3);
        assert_eq!(report["coefficients"], 16);
        assert!(number(&report, "asymmetry") < 1e-12);
        assert!(deviation(&report, &truth, "area") < area, "{shape}");
        assert!(deviation(&report, &truth, "volume") < volume, "{shape}");
    }
}

/// Noise makes facets between dense points face away from the centre; another one, off the mirror planes, would see them.
#[test]
fn mirrors_stay_at_the_centroid_of_points_that_are_denser_on_one_side() {
    let folder = folder();
    let body = [
        "synth",
        "ellipsoid",
        "--axes",
        "1.5,1.2,1",
        "--sampling",
        "random",
        "--noise",
        "0.01",
    ];
    let mut points = String::new();
    for (count, keep) in [("6000", 1.0), ("12000", -1.0)] {
        succeed(
            &folder,
            &[&body[..], &["--points", count, "-o", "body.xyz"]].concat(),
        );
        let body = std::fs::read_to_string(folder.path().join("body.xyz")).unwrap();
        for line in body.lines() {
            let x: f64 = line.split_whitespace().next().unwrap().parse().unwrap();
            if keep * x > 0.0 {
                points += line;
                points += "\n";
            }
        }
    }
    std::fs::write(folder.path().join("uneven.xyz"), points).unwrap();
    let found = json(&folder, &["fit", "uneven.xyz", "--symmetry", "xyz"]);
    let truth = 4.0 / 3.0 * std::f64::consts::PI * 1.8;
    assert!((number(&found, "volume") / truth - 1.0).abs() < 0.005);
}

#[test]
fn a_mirrored_model_is_saved_measured_and_meshed() {
    let folder = folder();
    succeed(&folder, &["synth", "cube", "-o", "cube.ply"]);
    let words = ["fit", "cube.ply", "--symmetry", "xyz", "-o", "cube.json"];
    let fitted = json(
        &folder,
        &[&words[..], &["--mesh", "cube.stl", "--degree", "3"]].concat(),
    );
    let measured = json(&folder, &["measure", "cube.json"]);
    for name in ["area", "volume"] {
        assert_eq!(number(&measured, name), number(&fitted, name));
    }
    // The cube's axes are those of the scan, though all directions are principal.
    let size = &measured["dimensions"];
    assert!((number(size, "length") / number(size, "thickness") - 1.0).abs() < 1e-9);
    let words = ["mesh", "cube.json", "-o", "cube.ply", "--resolution", "100"];
    succeed(&folder, &words);
    for mesh in ["cube.stl", "cube.ply"] {
        let meshed = json(&folder, &["measure", mesh]);
        assert_eq!(meshed["of"], "faces");
        assert!(deviation(&meshed, &fitted, "volume") < 1e-3);
        assert!(deviation(&meshed, &fitted, "area") < 1e-3);
    }
}

#[test]
fn the_published_octant_and_its_header_rebuild_the_radius() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "cylinder", "--axes", "2,2,1", "-o", "a.ply"],
    );
    let words = ["fit", "a.ply", "--symmetry", "xyz", "--harmonics", "a.csv"];
    succeed(&folder, &[&words[..], &["-o", "a.json"]].concat());
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert!(text.contains("with |x|, |y|, |z| in the place of x, y, z"));
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let octant = "0,0,1.5707963267948966,0,1.5707963267948966,";
    let a: Vec<f64> = rows
        .map(|row| row.strip_prefix(octant).expect("the octant"))
        .map(|row| row.split(',').nth(2).unwrap().parse().unwrap())
        .collect();
    let json = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let fitted = model::grain_from_json(&json).unwrap();
    let fitted = fitted.star().unwrap();
    for n in [[0.48, -0.6, 0.64], [-0.6, 0.0, -0.8], [0.0, 0.0, -1.0]] {
        let n = Vector3::from(n);
        let y = harmonics(3, &n.abs());
        let sum: f64 = y.iter().zip(&a).map(|(y, a)| y * a).sum();
        assert!((sum - fitted.radius(&n)).abs() < 1e-11);
    }
}

#[test]
fn one_plane_of_the_bean_is_met_with_half_the_sphere() {
    let folder = folder();
    let bean = grain("bean.ply");
    let truth = json(&folder, &["synth", "bean"]);
    let words = "--symmetry z --max-degree 12 --tolerance 0.1%".split(' ');
    let words: Vec<&str> = ["fit", &bean].into_iter().chain(words).collect();
    let report = json(&folder, &words);
    assert_eq!(report["symmetry"], "z");
    assert!(number(&report, "heldout_rms") <= number(&report, "limit"));
    assert!(deviation(&report, &truth, "area") < 3e-4);
    assert!(deviation(&report, &truth, "volume") < 3e-4);
    assert_eq!(report["warnings"].as_array().map(Vec::len), Some(0));
    let text = succeed(&folder, &words);
    assert!(text.contains("on one half, mirrored along z\n"), "{text}");
    assert!(text.contains("\nasymmetry     RMS "), "{text}");
}

#[test]
fn a_scan_that_is_not_symmetric_is_told_of() {
    let folder = folder();
    let output = grainform(&folder, &["fit", &grain("maize.ply"), "--symmetry", "xy"]);
    assert!(output.status.success());
    let text = errors(&output);
    let says = "The scan is not symmetric about these planes: its mirror images differ by 15.";
    assert!(text.contains(says), "{text}");
}

#[test]
fn a_search_lists_the_degrees() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "ellipsoid", "--axes", "2,2,1", "-o", "a.ply"],
    );
    let words = ["search", "a.ply", "--symmetry", "xyz", "--max-degree", "5"];
    let report = json(&folder, &words);
    let candidates = report["candidates"].as_array().expect("a list");
    assert_eq!(candidates.len(), 6);
    let rms: Vec<f64> = candidates
        .iter()
        .enumerate()
        .map(|(degree, candidate)| {
            assert_eq!(candidate["degree"], degree);
            assert_eq!(candidate["segments"], 1);
            assert_eq!(candidate["coefficients"], (degree + 1) * (degree + 1));
            number(candidate, "heldout_rms")
        })
        .collect();
    assert!(rms.is_sorted_by(|a, b| a > b), "{rms:?}");
    let chosen = report["chosen"].as_u64().expect("an index") as usize;
    let limit = number(&report, "limit");
    assert_eq!(chosen, rms.iter().position(|&rms| rms <= limit).unwrap());
}

#[test]
fn the_order_of_the_points_does_not_matter() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "bean", "--noise", "0.01", "-o", "a.xyz"],
    );
    let text = std::fs::read_to_string(folder.path().join("a.xyz")).unwrap();
    let reversed: Vec<&str> = text.lines().rev().collect();
    std::fs::write(folder.path().join("b.xyz"), reversed.join("\n")).unwrap();
    let [a, b] = ["a.xyz", "b.xyz"].map(|scan| {
        json(
            &folder,
            &["fit", scan, "--symmetry", "z", "--max-degree", "8"],
        )
    });
    assert_eq!(a["degree"], b["degree"]);
    for name in ["area", "volume", "heldout_rms", "asymmetry"] {
        let [a, b] = [&a, &b].map(|report| number(report, name));
        assert!((a - b).abs() < 1e-9 * a.max(1.0), "{name}");
    }
    let read = scan::read_scan(&folder.path().join("b.xyz")).unwrap();
    assert_eq!(read.points().len(), text.lines().count());
}

#[test]
fn what_cannot_be_mirrored_is_refused() {
    let folder = folder();
    let bean = grain("bean.ply");
    let one_expansion = "a fit with mirror planes is one expansion";
    let axes = "expected the axes normal to the mirror planes";
    for (words, says) in [
        ("--symmetry z --seams none", one_expansion),
        ("--symmetry z --segments 24", one_expansion),
        ("--symmetry z --max-segments 24", one_expansion),
        ("--symmetry zz", axes),
        ("--symmetry north", axes),
        ("--symmetry z --degree 21", "the degree is 21"),
    ] {
        for command in ["fit", "search"] {
            let words: Vec<&str> = words.split(' ').collect();
            let output = grainform(&folder, &[&[command, &bean], &words[..]].concat());
            let text = errors(&output);
            assert_eq!(output.status.code(), Some(2), "{words:?}: {text}");
            assert!(text.contains(says), "{words:?}: {text}");
            assert!(output.stdout.is_empty());
        }
    }
    assert!(names(folder.path()).is_empty());
    assert_eq!("zyx".parse(), Ok(Symmetry::OCTANT));
}

#[test]
fn mirrors_of_what_is_not_alike_on_both_sides_are_the_reason() {
    let folder = folder();
    succeed(&folder, &["synth", "banana", "-o", "banana.ply"]);
    for mirror in ["x", "y"] {
        let output = grainform(&folder, &["fit", "banana.ply", "--symmetry", mirror]);
        if output.status.code() == Some(2) {
            let text = errors(&output);
            let says = format!("the surface, mirrored in {mirror}, is off its points by");
            assert!(
                text.contains(&says) && !text.contains("grainform split"),
                "{text}"
            );
            return;
        }
    }
    panic!("no mirror was refused");
}

#[test]
fn guesses_of_a_mirrored_fit_have_no_standard_errors_either() {
    let folder = folder();
    let scan = "synth maize --missing-cap 45 -o maize.ply";
    succeed(&folder, &scan.split(' ').collect::<Vec<_>>());
    for (how, are_told) in [("--symmetry=x", false), ("--segments=1", true)] {
        let report = json(&folder, &["fit", "maize.ply", how, "--extrapolate"]);
        assert!(report["area"].is_number(), "{how}");
        assert_eq!(report["standard_errors"].is_object(), are_told, "{how}");
    }
}
