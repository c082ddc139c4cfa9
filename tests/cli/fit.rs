use super::{deviation, errors, folder, grain, grainform, json, names, number, succeed};
use serde_json::{Value, json};

#[test]
fn prints_a_summary_and_writes_nothing_unless_asked_to() {
    let folder = folder();
    let output = grainform(&folder, &["fit", &grain("bean.ply")]);
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    for words in [
        "1538 points",
        "degree 3, 16 segments, 256 coefficients",
        "held-out RMS is within the limit",
        "% of the mean radius",
        "scan's unit",
    ] {
        assert!(text.contains(words), "{words:?} in {text}");
    }
    assert_eq!(errors(&output), "");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn json_is_complete_and_consistent() {
    let folder = folder();
    let report = json(&folder, &["fit", &grain("maize.ply")]);
    let names: Vec<&String> = report.as_object().unwrap().keys().collect();
    let mut expected = vec![
        "input",
        "points",
        "degree",
        "segments",
        "coefficients",
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
    assert_eq!(
        report["coefficients"],
        json!((degree + 1).pow(2) * segments)
    );
    assert_eq!(report["points"], 6146);
    assert_eq!(report["reference"]["kind"], "directions");
    assert_eq!(report["warnings"], json!([]));
    for what in ["area", "volume"] {
        let error = number(&report, what) / number(&report["reference"], what) - 1.0;
        assert_eq!(error, number(&report, &format!("{what}_error")));
    }
    assert!(number(&report, "heldout_rms") <= number(&report, "limit"));
    assert!(number(&report, "rms") < number(&report, "max"));
    assert!(number(&report, "rms") < number(&report, "heldout_rms"));
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
            assert!(error < 0.003, "{what} of {body}: {error}");
        }
    }
}

#[test]
fn the_search_can_be_narrowed_and_replaced() {
    let folder = folder();
    let bean = grain("bean.ply");
    let given = json(&folder, &["fit", &bean, "--degree", "2", "--segments", "9"]);
    assert_eq!(
        (&given["degree"], &given["segments"]),
        (&json!(2), &json!(9))
    );
    assert_eq!(given["rule"], "the only candidate asked for");
    let narrow = json(
        &folder,
        &["fit", &bean, "--max-degree", "2", "--max-segments", "30"],
    );
    assert!(narrow["degree"].as_u64() <= Some(2) && narrow["segments"].as_u64() <= Some(25));
    let words = ["fit", &bean, "--degree", "auto", "--segments", "auto"];
    assert_eq!(json(&folder, &words)["segments"], 16);
}

#[test]
fn tolerance_is_a_length_or_a_share_of_the_mean_radius() {
    let folder = folder();
    let bean = grain("bean.ply");
    let by_default = json(&folder, &["fit", &bean]);
    let radius = number(&by_default, "mean_radius");
    assert!((number(&by_default, "limit") / radius - 0.003).abs() < 1e-12);
    let share = json(&folder, &["fit", &bean, "--tolerance", "2%"]);
    assert!((number(&share, "limit") / radius - 0.02).abs() < 1e-12);
    assert!(share["coefficients"].as_u64() < by_default["coefficients"].as_u64());
    let length = json(&folder, &["fit", &bean, "--tolerance", "0.05"]);
    assert_eq!(number(&length, "limit"), 0.05);
}

#[test]
fn threads_and_skipping_do_not_change_the_result() {
    let folder = folder();
    let maize = grain("maize.ply");
    let plain = |words: &[&str]| {
        let mut report = json(&folder, &[&["fit", &maize], words].concat());
        let record = report.as_object_mut().unwrap();
        record.remove("seconds");
        let skipped = record.remove("skipped").unwrap();
        (report, skipped)
    };
    assert_eq!(plain(&["--threads", "1"]), plain(&["--threads", "2"]));
    let (searched, skipped) = plain(&[]);
    let (exhaustive, nothing) = plain(&["--exhaustive"]);
    assert_eq!(searched, exhaustive);
    assert!(skipped["candidates"].as_u64() > Some(0));
    assert_eq!(nothing, json!({"candidates": 0, "segments": 0}));
}

#[test]
fn published_harmonics_come_with_their_conventions_and_loss() {
    let folder = folder();
    let words = ["fit", &grain("bean.ply"), "--harmonics", "a.csv"];
    let report = json(&folder, &words);
    assert!(number(&report, "harmonics_loss") < 1e-6 * number(&report, "mean_radius"));
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert!(text.starts_with('#') && text.contains("without the Condon-Shortley phase"));
    let mut lines = text.lines().skip_while(|line| line.starts_with('#'));
    let head = lines.next().unwrap();
    assert_eq!(head, "segment,theta_min,theta_max,phi_min,phi_max,l,m,a");
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len() as u64, report["coefficients"].as_u64().unwrap());
    assert!(
        rows.iter()
            .all(|row| row.split(',').all(|cell| cell.parse::<f64>().is_ok()))
    );
    assert!(rows[4].starts_with("0,0,") && rows[4].contains(",2,-2,"));
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
