use super::{
    INDEPENDENT, deviation, errors, folder, grain, grainform, json, names, number, succeed,
};
use serde_json::{Value, json};

#[test]
fn prints_a_summary_and_writes_nothing_unless_asked_to() {
    let folder = folder();
    let bean = grain("bean.ply");
    let report = json(&folder, &["fit", &bean]);
    let model = format!(
        "degree {}, {} segments, {} coefficients",
        report["degree"], report["segments"], report["coefficients"]
    );
    for (options, model) in [
        (&[][..], model.as_str()),
        (&INDEPENDENT[..], "degree 3, 16 segments, 256 coefficients"),
    ] {
        let output = grainform(&folder, &[&["fit", &bean], options].concat());
        let text = String::from_utf8(output.stdout.clone()).unwrap();
        for words in [
            "1538 points",
            model,
            "held-out RMS is within the limit",
            "% of the mean radius",
            "scan's unit",
        ] {
            assert!(text.contains(words), "{words:?} in {text}");
        }
        assert_eq!(errors(&output), "");
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn json_is_complete_and_consistent() {
    let folder = folder();
    let maize = grain("maize.ply");
    check_consistency(&json(&folder, &["fit", &maize]));
    let report = json(&folder, &[&["fit", &maize], &INDEPENDENT[..]].concat());
    check_consistency(&report);
    let degree = report["degree"].as_u64().unwrap();
    let segments = report["segments"].as_u64().unwrap();
    assert_eq!(
        report["coefficients"],
        json!((degree + 1).pow(2) * segments)
    );
    assert!(number(&report, "seam_jump") > 0.0);
}

/// What holds of every clean fit of the maize.
fn check_consistency(report: &Value) {
    let names: Vec<&String> = report.as_object().unwrap().keys().collect();
    let mut expected = vec![
        "input",
        "points",
        "degree",
        "segments",
        "coefficients",
        "coefficients_touched",
        "principal",
        "dimensions",
        "standard_errors",
        "area",
        "volume",
        "reference",
        "area_error",
        "volume_error",
        "rms",
        "max",
        "heldout_rms",
        "mean_radius",
        "noise",
        "limit",
        "rule",
        "seam_jump",
        "reduced_segments",
        "seconds",
        "skipped",
        "warnings",
    ];
    expected.sort_unstable();
    assert_eq!(names, expected);

    let degree = report["degree"].as_u64().unwrap();
    let segments = report["segments"].as_u64().unwrap();
    assert!(report["coefficients"].as_u64().unwrap() <= (degree + 1).pow(2) * segments);
    assert_eq!(report["points"], 6146);
    assert_eq!(report["reference"]["kind"], "directions");
    assert_eq!(report["warnings"], json!([]));
    for what in ["area", "volume"] {
        let error = number(report, what) / number(&report["reference"], what) - 1.0;
        assert_eq!(error, number(report, &format!("{what}_error")));
    }
    assert!(number(report, "heldout_rms") <= number(report, "limit"));
    assert!(number(report, "rms") < number(report, "max"));
    assert!(number(report, "rms") < number(report, "heldout_rms"));
    let seconds = &report["seconds"];
    let stages = ["read", "search", "mesh"].map(|stage| number(seconds, stage));
    assert!(stages.iter().sum::<f64>() <= number(seconds, "total"));
}

#[test]
fn area_and_volume_are_those_of_the_closed_form() {
    let folder = folder();
    for body in ["bean", "chickpea", "maize", "sphere"] {
        let truth = json(&folder, &["synth", body, "-o", "scan.ply"]);
        let report = json(&folder, &["fit", "scan.ply"]);
        for what in ["area", "volume"] {
            let error = deviation(&report, &truth, what);
            assert!(error < 0.001, "{what} of {body}: {error}");
        }
    }
}

#[test]
fn the_search_can_be_narrowed_and_replaced() {
    let folder = folder();
    let bean = grain("bean.ply");
    for (options, segments) in [(&[][..], "24"), (&INDEPENDENT[..], "9")] {
        let fit = |words: &[&str]| json(&folder, &[&["fit", &bean], options, words].concat());
        let given = fit(&["--degree", "2", "--segments", segments]);
        assert_eq!(given["degree"], json!(2));
        assert_eq!(given["segments"].to_string(), segments);
        assert_eq!(given["rule"], "the only candidate asked for");
        let narrow = fit(&["--max-degree", "2", "--max-segments", "30"]);
        assert!(narrow["degree"].as_u64() <= Some(2) && narrow["segments"].as_u64() <= Some(30));
        let plain = fit(&[])["segments"].clone();
        let words = ["--degree", "auto", "--segments", "auto"];
        assert_eq!(fit(&words)["segments"], plain);
        assert_eq!(fit(&["--segments", "adaptive"])["segments"], plain);
        if !options.is_empty() {
            assert_eq!(plain, 16);
        }
    }
}

#[test]
fn tolerance_is_a_length_or_a_share_of_the_mean_radius() {
    let folder = folder();
    let bean = grain("bean.ply");
    for seams in ["blended", "none"] {
        let fit = |tolerance: &str| {
            json(
                &folder,
                &["fit", &bean, "--seams", seams, "--tolerance", tolerance],
            )
        };
        // Of blended cells, the noise comes on top.
        let allowed = |report: &Value| match seams {
            "blended" => (number(report, "limit").powi(2) - number(report, "noise").powi(2)).sqrt(),
            _ => number(report, "limit"),
        };
        let auto = fit("auto");
        let radius = number(&auto, "mean_radius");
        if seams == "blended" {
            assert!((allowed(&auto) / radius - 0.001).abs() < 1e-12);
        }
        let tight = fit("0.3%");
        assert!((allowed(&tight) / radius - 0.003).abs() < 1e-12);
        let share = fit("2%");
        assert!((allowed(&share) / radius - 0.02).abs() < 1e-12);
        assert!(share["coefficients"].as_u64() < tight["coefficients"].as_u64());
        assert!(tight["coefficients"].as_u64() < auto["coefficients"].as_u64());
        let length = fit("0.05");
        assert!((allowed(&length) - 0.05).abs() < 1e-12);
    }
}

#[test]
fn threads_and_skipping_do_not_change_the_result() {
    let folder = folder();
    let maize = grain("maize.ply");
    for options in [&[][..], &INDEPENDENT[..]] {
        let plain = |words: &[&str]| {
            let mut report = json(&folder, &[&["fit", &maize], options, words].concat());
            let record = report.as_object_mut().unwrap();
            record.remove("seconds");
            let skipped = record.remove("skipped").unwrap();
            (report, skipped)
        };
        assert_eq!(plain(&["--threads", "1"]), plain(&["--threads", "2"]));
        let (searched, skipped) = plain(&[]);
        let (exhaustive, nothing) = plain(&["--exhaustive"]);
        assert_eq!(searched, exhaustive);
        if !options.is_empty() {
            assert!(skipped["candidates"].as_u64() > Some(0));
        }
        assert_eq!(nothing, json!({"candidates": 0, "segments": 0}));
    }
}

#[test]
fn published_harmonics_come_with_their_conventions_and_loss() {
    let folder = folder();
    for (options, columns) in [
        (&[][..], "segment,face,parts,row,column,l,m,a"),
        (
            &INDEPENDENT[..],
            "segment,theta_min,theta_max,phi_min,phi_max,l,m,a",
        ),
    ] {
        let words = ["fit", &grain("bean.ply"), "--harmonics", "a.csv"];
        let report = json(&folder, &[&words, options].concat());
        assert!(number(&report, "harmonics_loss") < 1e-6 * number(&report, "mean_radius"));
        let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
        assert!(text.starts_with('#') && text.contains("without the Condon-Shortley phase"));
        let mut lines = text.lines().skip_while(|line| line.starts_with('#'));
        assert_eq!(lines.next().unwrap(), columns);
        let rows: Vec<&str> = lines.collect();
        assert_eq!(rows.len() as u64, report["coefficients"].as_u64().unwrap());
        assert!(
            rows.iter()
                .all(|row| row.split(',').all(|cell| cell.parse::<f64>().is_ok()))
        );
        assert!(rows[4].starts_with("0,0,") && rows[4].contains(",2,-2,"));
    }
}

#[test]
fn stats_and_warnings_go_to_standard_error_and_quiet_silences() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "maize", "--missing-cap", "40", "-o", "gap.ply"],
    );
    let gap = grainform(&folder, &["fit", "gap.ply", "--stats"]);
    let text = errors(&gap);
    assert!(text.contains("warning: "), "{text}");
    for words in ["candidates", "segments", "skipped", "seconds"] {
        assert!(text.contains(words), "{words:?} in {text}");
    }
    let quiet = grainform(&folder, &["fit", "gap.ply", "--quiet", "-o", "gap.json"]);
    assert!(quiet.status.success() && quiet.stdout.is_empty() && quiet.stderr.is_empty());
    assert!(folder.path().join("gap.json").is_file());
    let object = grainform(&folder, &["fit", "gap.ply", "--json"]);
    assert!(object.stderr.is_empty());
    let report: Value = serde_json::from_slice(&object.stdout).unwrap();
    assert!(!report["warnings"].as_array().unwrap().is_empty());
}
